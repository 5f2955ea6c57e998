#include <tribodraw/base/errors.h>
#include <tribodraw/shell/element.h>

#include <deal.II/base/quadrature_lib.h>

#include <string>

namespace tribodraw::shell_element
{
  ThicknessRule
  make_thickness_rule(const unsigned n, const bool lobatto)
  {
    if (n < 3 || n > 11)
      throw InputError(describe_error("The number of thickness points is out of range.", "shell", std::to_string(n),
                                      "3 to 11", "5 serves most forming simulations, 7 to 9 for springback"));
    dealii::Quadrature<1> rule;
    if (lobatto)
      rule = dealii::QGaussLobatto<1>(n);
    else
      rule = dealii::QGauss<1>(n);
    ThicknessRule result;
    for (unsigned l = 0; l < n; ++l)
      {
        result.point.push_back(2 * rule.point(l)[0] - 1);
        result.weight.push_back(rule.weight(l));
      }
    return result;
  }

  ThicknessRule
  make_halved_thickness_rule(const unsigned n)
  {
    if (n < 4 || n > 10 || n % 2 != 0)
      throw InputError(describe_error("The number of thickness points does not fit Gauss points in each half.", "shell",
                                      std::to_string(n), "4, 6, 8, 10", "6 serve springback"));
    const dealii::QGauss<1> rule(n / 2);
    ThicknessRule           result;
    for (const double half : { -0.5, 0.5 })
      for (unsigned l = 0; l < n / 2; ++l)
        {
          result.point.push_back(half + rule.point(l)[0] - 0.5);
          result.weight.push_back(0.5 * rule.weight(l));
        }
    return result;
  }
} // namespace tribodraw::shell_element
