#include <tribodraw/base/errors.h>
#include <tribodraw/base/table.h>
#include <tribodraw/base/units.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tribodraw
{
  Axis::Location
  Axis::locate(const double x) const
  {
    const std::size_t n = points.size();
    if (n == 1)
      return {0, 0., 0., x != points[0]};
    if (!(x > points.front()))
      return {0, 0., 0., x < points.front() || std::isnan(x)};
    if (x >= points.back())
      return {n - 2, 1., 0., x > points.back()};
    const std::size_t i = static_cast<std::size_t>(std::upper_bound(points.begin(), points.end(), x) - points.begin()) - 1;
    const double      a = points[i], b = points[i + 1];
    if (scale == AxisScale::linear)
      return {i, (x - a) / (b - a), 1. / (b - a), false};
    const double span = std::log(b / a);
    return {i, std::log(x / a) / span, 1. / (x * span), false};
  }

  void
  Axis::check(const std::string &name) const
  {
    if (points.empty())
      throw InputError(describe_error("the axis is empty.", name));
    for (std::size_t i = 0; i < points.size(); ++i)
      {
        const std::string where = name + ", point " + std::to_string(i + 1);
        if (!std::isfinite(points[i]))
          throw InputError(describe_error("the axis has a value that is not finite.", where));
        if (scale == AxisScale::logarithmic && !(points[i] > 0))
          throw InputError(describe_error("a logarithmic axis needs positive values.", where, units::number(points[i])));
        if (i > 0 && !(points[i] > points[i - 1]))
          throw InputError(describe_error("the axis is not strictly increasing.", where,
                                          units::number(points[i]) + " after " + units::number(points[i - 1])));
      }
  }

  template <int N>
  Table<N>::Table(std::array<Axis, N> axes, std::vector<double> values)
    : axis(std::move(axes))
    , data(std::move(values))
  {
    std::size_t expected = 1;
    for (const auto &a : axis)
      expected *= a.points.size();
    if (expected != data.size() || data.empty())
      throw InputError("A table has " + std::to_string(data.size()) + " values, its axes ask for " + std::to_string(expected) + ".");
  }

  template <int N>
  double
  Table<N>::value(const std::array<double, N> &x, std::array<double, N> &gradient) const
  {
    std::array<Axis::Location, N> at;
    for (int d = 0; d < N; ++d)
      at[d] = axis[d].locate(x[d]);
    gradient.fill(0.);
    double result = 0;
    for (unsigned corner = 0; corner < (1u << N); ++corner)
      {
        std::size_t           index  = 0;
        double                weight = 1;
        std::array<double, N> slope;
        slope.fill(1.);
        bool exists = true;
        for (int d = 0; d < N; ++d)
          {
            const bool upper = corner & (1u << d);
            if (upper && axis[d].points.size() == 1)
              exists = false;
            const double w  = upper ? at[d].weight : 1. - at[d].weight;
            const double dw = upper ? at[d].weight_derivative : -at[d].weight_derivative;
            index           = index * axis[d].points.size() + at[d].cell + (upper ? 1 : 0);
            weight *= w;
            for (int e = 0; e < N; ++e)
              slope[e] *= (e == d) ? dw : w;
          }
        if (!exists)
          continue;
        result += weight * data[index];
        for (int d = 0; d < N; ++d)
          gradient[d] += slope[d] * data[index];
      }
    return result;
  }

  template <int N>
  double
  Table<N>::value(const std::array<double, N> &x) const
  {
    std::array<double, N> unused;
    return value(x, unused);
  }

  template <int N>
  bool
  Table<N>::outside(const std::array<double, N> &x) const
  {
    for (int d = 0; d < N; ++d)
      if (axis[d].locate(x[d]).outside)
        return true;
    return false;
  }

  template class Table<1>;
  template class Table<2>;
  template class Table<3>;
} // namespace tribodraw
