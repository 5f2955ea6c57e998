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
} // namespace tribodraw::shell_element
