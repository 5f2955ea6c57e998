#include <tribodraw/base/errors.h>
#include <tribodraw/base/units.h>
#include <tribodraw/friction_table/scatter.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace tribodraw
{
  namespace
  {
    using Tables = std::vector<FrictionTable>;

    /// Points of one axis of all tables within their common range.
    std::vector<double>
    common_points(const Tables &tables, const int axis)
    {
      double low = 0, high = 1e300;
      for (const FrictionTable &t : tables)
        {
          const auto &points = t.cut_height_monotone.axes()[axis].points;
          low                = std::max(low, points.front());
          high               = std::min(high, points.back());
        }
      if (!(low < high))
        throw InputError(describe_error("The friction tables have no range in common",
                                        axis == 0 ? "solid pressure [MPa]" : "plastic strain",
                                        units::number(low) + " to " + units::number(high)));
      std::vector<double> all;
      for (const FrictionTable &t : tables)
        for (const double x : t.cut_height_monotone.axes()[axis].points)
          if (x >= low && x <= high)
            all.push_back(x);
      std::sort(all.begin(), all.end());
      all.erase(std::unique(all.begin(), all.end(),
                            [](const double a, const double b) { return b - a <= 1e-9 * (std::abs(b) + 1e-9); }),
                all.end());
      return all;
    }

    double
    mean(const Tables &tables, const std::function<double(const FrictionTable &)> &value)
    {
      double sum = 0;
      for (const FrictionTable &t : tables)
        sum += value(t);
      return sum / static_cast<double>(tables.size());
    }

    /// Cut height at which a table has this contact fraction.
    double
    cut_height_of(const FrictionTable &t, const double contact_fraction)
    {
      const auto &alpha = t.curves.contact_fraction, &s = t.curves.cut_height; // alpha falls while s rises
      if (contact_fraction <= alpha.back())
        return s.back();
      // The last point that has at least this fraction.
      std::size_t i = 0;
      while (i + 1 < alpha.size() && alpha[i + 1] >= contact_fraction)
        ++i;
      if (i + 1 == alpha.size() || alpha[i] == alpha[i + 1])
        return s[i];
      return s[i] + (alpha[i] - contact_fraction) / (alpha[i] - alpha[i + 1]) * (s[i + 1] - s[i]);
    }

    /// Contact fractions of the mean table, descending.
    std::vector<double>
    common_contact_fractions(const Tables &tables)
    {
      double greatest = 1;
      for (const FrictionTable &t : tables)
        greatest = std::min(greatest, t.max_contact_fraction());
      std::vector<double> result{ greatest };
      for (const double a : tables.front().curves.contact_fraction)
        if (a < result.back())
          result.push_back(a);
      if (result.back() > 0)
        result.push_back(0.);
      return result;
    }

    void
    average_curves(const Tables &tables, const std::vector<double> &alpha, FrictionTable &result)
    {
      using Curves = FrictionTable::StateCurves;
      const std::array<std::vector<double> Curves::*, 4> phi_p{ &Curves::phi_p_xx, &Curves::phi_p_xy, &Curves::phi_p_yx,
                                                                &Curves::phi_p_yy };
      const std::array<std::vector<double> Curves::*, 4> phi_s{ &Curves::phi_s_xx, &Curves::phi_s_xy, &Curves::phi_s_yx,
                                                                &Curves::phi_s_yy };
      auto                                              &c = result.curves;
      for (const double a : alpha)
        {
          const double s = mean(tables, [&](const FrictionTable &t) { return cut_height_of(t, a); });
          // Equal heights in a map: contact fractions that are passed in one step.
          if (!c.cut_height.empty() && !(s > c.cut_height.back()))
            continue;
          c.cut_height.push_back(s);
          c.contact_fraction.push_back(a);
          c.h_avg.push_back(mean(tables, [&](const FrictionTable &t) { return t.film(cut_height_of(t, a)).h_avg; }));
          for (int i = 0; i < 4; ++i)
            {
              (c.*phi_p[i]).push_back(mean(tables, [&](const FrictionTable &t) {
                return t.film(cut_height_of(t, a)).phi_p(i / 2, i % 2);
              }));
              (c.*phi_s[i])
                  .push_back(mean(tables,
                                  [&](const FrictionTable &t) {
                                    return t.sq * t.film(cut_height_of(t, a)).phi_s(i / 2, i % 2);
                                  })
                             / result.sq);
            }
        }
    }

    struct Quantity
    {
      const char                                                  *name;
      std::function<double(const FrictionTable &, double, double)> value; // of (table, p, eps)
    };

    const std::vector<Quantity> &
    quantities()
    {
      const auto film = [](const FrictionTable &t, const double p, const double e) {
        return t.film(t.cut_height_monotone.value({ p, e }));
      };
      const auto shear = [film](const FrictionTable &t, const double p, const double e) {
        const double alpha = film(t, p, e).contact_fraction;
        return alpha > 0 ? t.solid_shear(t.cut_height_monotone.value({ p, e }), p, p / alpha, e) : 0.;
      };
      static const std::vector<Quantity> list{
        { "contact_fraction",
          [film](const FrictionTable &t, double p, double e) { return film(t, p, e).contact_fraction; } },
        { "h_avg_um",
          [film](const FrictionTable &t, double p, double e) { return film(t, p, e).h_avg / units::factor("um"); } },
        { "tau_solid_mpa", shear },
        { "mu_boundary", [shear](const FrictionTable &t, double p, double e) { return shear(t, p, e) / p; } },
        { "phi_p_xx", [film](const FrictionTable &t, double p, double e) { return film(t, p, e).phi_p(0, 0); } },
        { "phi_p_yy", [film](const FrictionTable &t, double p, double e) { return film(t, p, e).phi_p(1, 1); } },
        { "phi_s_xx", [film](const FrictionTable &t, double p, double e) { return film(t, p, e).phi_s(0, 0); } },
        { "phi_s_yy", [film](const FrictionTable &t, double p, double e) { return film(t, p, e).phi_s(1, 1); } }
      };
      return list;
    }
  } // namespace

  FrictionTable
  mean_friction_table(const Tables &tables)
  {
    if (tables.empty())
      throw InputError(describe_error("There is no friction table to average", "scatter of friction tables"));
    FrictionTable result;
    result.sq                 = mean(tables, [](const FrictionTable &t) { return t.sq; });
    result.initial_cut_height = mean(tables, [](const FrictionTable &t) { return t.initial_cut_height; });
    average_curves(tables, common_contact_fractions(tables), result);
    result.curves.cut_height.back() = result.initial_cut_height;

    const Axis logarithmic{ common_points(tables, 0), AxisScale::logarithmic };
    const Axis linear{ logarithmic.points, AxisScale::linear }, strain{ common_points(tables, 1), AxisScale::linear };
    std::vector<double> normal, monotone, ploughing, descent;
    for (const double p : logarithmic.points)
      for (const double e : strain.points)
        {
          const auto average = [&](const auto member) {
            return mean(tables, [&](const FrictionTable &t) { return (t.*member).value({ p, e }); });
          };
          normal.push_back(average(&FrictionTable::cut_height_normal));
          monotone.push_back(average(&FrictionTable::cut_height_monotone));
          ploughing.push_back(average(&FrictionTable::ploughing_coefficient));
          for (const double alpha : result.curves.contact_fraction)
            descent.push_back(std::min(FrictionTable::rigid_strain_load, mean(tables, [&](const FrictionTable &t) {
                                         return t.strain_load_per_descent.value({ p, e, cut_height_of(t, alpha) });
                                       })));
        }
    result.cut_height_normal     = Table<2>({ logarithmic, strain }, normal);
    result.cut_height_monotone   = Table<2>({ logarithmic, strain }, monotone);
    result.ploughing_coefficient = Table<2>({ logarithmic, strain }, ploughing);
    result.strain_load_per_descent
        = Table<3>({ linear, strain, Axis{ result.curves.cut_height, AxisScale::linear } }, descent);
    result.boundary_layer_shear  = tables.front().boundary_layer_shear;
    result.shear_strength        = tables.front().shear_strength;
    result.provenance["mean_of"] = nlohmann::json::array();
    for (const FrictionTable &t : tables)
      result.provenance["mean_of"].push_back(t.provenance);
    result.check("mean friction table");
    return result;
  }

  CsvTable
  friction_table_scatter(const Tables &tables)
  {
    std::vector<std::string> columns{ "p_solid_mpa", "eps_p" };
    for (const Quantity &q : quantities())
      for (const char *end : { "_mean", "_sd", "_min", "_max" })
        columns.push_back(std::string(q.name) + end);
    CsvTable csv(columns);
    for (const double p : common_points(tables, 0))
      for (const double e : common_points(tables, 1))
        {
          std::vector<CsvTable::Cell> row{ p, e };
          for (const Quantity &q : quantities())
            {
              const auto   value  = [&](const FrictionTable &t) { return q.value(t, p, e); };
              const double centre = mean(tables, value);
              const double square
                  = mean(tables, [&](const FrictionTable &t) { return std::pow(value(t) - centre, 2); });
              const double n   = static_cast<double>(tables.size());
              double       low = 1e300, high = -1e300;
              for (const FrictionTable &t : tables)
                {
                  low  = std::min(low, value(t));
                  high = std::max(high, value(t));
                }
              row.insert(row.end(), { centre, n > 1 ? std::sqrt(square * n / (n - 1)) : 0., low, high });
            }
          csv.add_row(row);
        }
    return csv;
  }
} // namespace tribodraw
