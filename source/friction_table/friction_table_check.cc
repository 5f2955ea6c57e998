#include <tribodraw/base/errors.h>
#include <tribodraw/base/units.h>
#include <tribodraw/friction_table/friction_table.h>

#include <cmath>
#include <functional>

namespace tribodraw
{
  namespace
  {
    using Test = std::function<bool(double)>;

    /// Checks that name the first culprit.
    class Inspector
    {
    public:
      explicit Inspector(std::string table_name) : table(std::move(table_name)) {}

      [[noreturn]] void
      fail(const std::string &part, const std::string &value, const std::string &allowed) const
      {
        throw InputError(describe_error("The friction table is inconsistent", table + ", " + part, value, allowed,
                                        "Build it again from the surfaces; do not edit numbers by hand."));
      }

      void
      values(const std::string &part, const std::vector<double> &v, const std::string &allowed, const Test &test) const
      {
        for (std::size_t i = 0; i < v.size(); ++i)
          if (!std::isfinite(v[i]) || !test(v[i]))
            fail(part + ", value " + std::to_string(i + 1), units::number(v[i]), allowed);
      }

      void
      size(const std::string &part, const std::vector<double> &v, const std::size_t n) const
      {
        if (v.size() != n)
          fail(part, std::to_string(v.size()) + " values", std::to_string(n) + " values");
      }

      /// sign +1: never decreasing, -1: never increasing
      void
      monotone(const std::string &part, const std::vector<double> &v, const double sign) const
      {
        for (std::size_t i = 1; i < v.size(); ++i)
          if (sign * (v[i] - v[i - 1]) < 0)
            fail(part + ", value " + std::to_string(i + 1), units::number(v[i]) + " after " + units::number(v[i - 1]),
                 sign > 0 ? "values that do not decrease" : "values that do not increase");
      }

      template <int N>
      void
      table_of(const std::string &part, const Table<N> &t, const std::string &allowed, const Test &test) const
      {
        if (t.empty())
          fail(part, "no values", "a table");
        for (int d = 0; d < N; ++d)
          t.axes()[d].check(table + ", " + part + ", axis " + std::to_string(d + 1));
        values(part, t.values(), allowed, test);
      }

      /// Cut heights fall with pressure (first axis) and, if wanted, with strain (second axis).
      void
      falls(const std::string &part, const Table<2> &t, const bool with_strain) const
      {
        const std::size_t n_p = t.axes()[0].points.size(), n_e = t.axes()[1].points.size();
        for (std::size_t j = 0; j < n_e; ++j)
          {
            std::vector<double> column;
            for (std::size_t i = 0; i < n_p; ++i)
              column.push_back(t.values()[i * n_e + j]);
            monotone(part + ", strain " + std::to_string(j + 1), column, -1);
          }
        for (std::size_t i = 0; with_strain && i < n_p; ++i)
          monotone(part + ", pressure " + std::to_string(i + 1),
                   { t.values().begin() + i * n_e, t.values().begin() + (i + 1) * n_e }, -1);
      }

    private:
      std::string table;
    };

    bool
    any(double)
    {
      return true;
    }
    bool
    positive(const double x)
    {
      return x > 0;
    }
    bool
    non_negative(const double x)
    {
      return x >= 0;
    }

    void
    check_curves(const FrictionTable::StateCurves &c, const Inspector &inspect)
    {
      const std::size_t n = c.cut_height.size();
      if (n < 2)
        inspect.fail("state curves, cut height", std::to_string(n) + " values", "at least 2 values");
      Axis{ c.cut_height, AxisScale::linear }.check("friction table, state curves, cut height");
      for (const auto &[name, values] : { std::pair{ "contact fraction", &c.contact_fraction },
                                          { "h_avg", &c.h_avg },
                                          { "phi_p_xx", &c.phi_p_xx },
                                          { "phi_p_xy", &c.phi_p_xy },
                                          { "phi_p_yx", &c.phi_p_yx },
                                          { "phi_p_yy", &c.phi_p_yy },
                                          { "phi_s_xx", &c.phi_s_xx },
                                          { "phi_s_xy", &c.phi_s_xy },
                                          { "phi_s_yx", &c.phi_s_yx },
                                          { "phi_s_yy", &c.phi_s_yy } })
        {
          inspect.size(std::string("state curves, ") + name, *values, n);
          inspect.values(std::string("state curves, ") + name, *values, "finite", any);
        }
      inspect.values("state curves, contact fraction", c.contact_fraction, "0 to 1",
                     [](double x) { return x >= 0 && x <= 1; });
      inspect.monotone("state curves, contact fraction", c.contact_fraction, -1);
      inspect.values("state curves, h_avg", c.h_avg, "greater than 0", positive);
      inspect.monotone("state curves, h_avg", c.h_avg, 1);
      inspect.values("state curves, phi_p_xx", c.phi_p_xx, "not negative", non_negative);
      inspect.values("state curves, phi_p_yy", c.phi_p_yy, "not negative", non_negative);
    }
  } // namespace

  void
  FrictionTable::check(const std::string &name) const
  {
    const Inspector inspect(name);
    check_curves(curves, inspect);
    if (!std::isfinite(sq) || !(sq > 0))
      inspect.fail("Sq", units::number(sq), "greater than 0");
    if (!std::isfinite(initial_cut_height) || initial_cut_height < curves.cut_height.back())
      inspect.fail("initial cut height", units::number(initial_cut_height),
                   "not below the largest cut height of the curves");

    inspect.table_of("cut height under load", cut_height_normal, "finite", any);
    inspect.falls("cut height under load", cut_height_normal, false);
    inspect.table_of("monotone cut height", cut_height_monotone, "finite", any);
    inspect.falls("monotone cut height", cut_height_monotone, true);
    inspect.table_of("strain load per descent", strain_load_per_descent, "finite", any);
    inspect.table_of("boundary layer shear", boundary_layer_shear, "not negative", non_negative);
    inspect.monotone("boundary layer shear", boundary_layer_shear.values(), 1);
    inspect.table_of("shear strength", shear_strength, "greater than 0", positive);
    inspect.table_of("ploughing coefficient", ploughing_coefficient, "0 to 10",
                     [](double x) { return x >= 0 && x <= 10; });

    if (boundary_layer_shear.values().size() < 2)
      inspect.fail("boundary layer shear", "1 value", "at least 2 values");
    if (boundary_layer_shear.axes()[0].scale != AxisScale::logarithmic)
      inspect.fail("boundary layer shear, axis", "linear", "logarithmic");
    for (const double p :
         { strain_load_per_descent.axes()[0].points.front(), cut_height_normal.axes()[0].points.front(),
           cut_height_monotone.axes()[0].points.front(), ploughing_coefficient.axes()[0].points.front() })
      if (!(p > 0))
        inspect.fail("pressure axis", units::number(p), "greater than 0");
    if (strain_load_per_descent.axes()[2].points != curves.cut_height)
      inspect.fail("strain load per descent, axis of the cut height", "other points", "those of the state curves");
  }
} // namespace tribodraw
