#include <tribodraw/base/errors.h>
#include <tribodraw/base/log.h>
#include <tribodraw/base/parallel.h>
#include <tribodraw/base/timing.h>
#include <tribodraw/base/units.h>
#include <tribodraw/boundary_friction/ploughing.h>
#include <tribodraw/flattening/deformed_surface.h>
#include <tribodraw/friction_table/builder.h>
#include <tribodraw/friction_table/monotone_curve.h>

#include <algorithm>
#include <cmath>

namespace tribodraw
{
  namespace
  {
    /// Contact fractions above this leave no film to speak of, and the flattening law no validity.
    constexpr double largest_contact_fraction = 0.98;

    void
    check_pair(const PairDescription &pair)
    {
      const HeightMap &a = pair.sheet, &b = pair.tool;
      if (a.size() == 0)
        throw InputError(describe_error("A friction table needs a rough sheet", "`Sheet surface`", "a smooth surface",
                                        "a measured or generated surface"));
      const auto differs = [](const double x, const double y) { return std::abs(x - y) > 1e-9 * x; };
      if (b.size() > 0 && (a.nx != b.nx || a.ny != b.ny || differs(a.dx, b.dx) || differs(a.dy, b.dy)))
        {
          const auto grid = [](const HeightMap &m) {
            return std::to_string(m.nx) + " x " + std::to_string(m.ny) + " pixels of " + units::format(m.dx, "um")
                   + " x " + units::format(m.dy, "um");
          };
          throw InputError(
              describe_error("Sheet and tool maps have different grids", "`Sheet surface` and `Tool surface`",
                             grid(a) + " and " + grid(b), "the same pixels",
                             "Generate the tool surface on the grid of the sheet, or resample one of them with "
                             "`Processing/Resample to`."));
        }
    }

    /// Cut heights, ascending from @p bottom to @p top, spread evenly in the mean of relative height and relative
    /// contact fraction: a plateau that is touched within little descent gets its points, and so does the way to it.
    std::vector<double>
    spread_cut_heights(const HeightDistribution &heights, const double bottom, const double top, const unsigned int n)
    {
      const double alpha_max = heights.contact_fraction(bottom);
      const auto   measure   = [&](const double s) {
        return 0.5 * ((top - s) / (top - bottom) + heights.contact_fraction(s) / alpha_max);
      };
      std::vector<double> result{ bottom };
      for (unsigned int i = n - 2; i > 0; --i)
        {
          const double target = measure(top) + (measure(bottom) - measure(top)) * i / (n - 1);
          double       low = bottom, high = top;
          for (unsigned int step = 0; step < 60; ++step)
            {
              const double mid                     = 0.5 * (low + high);
              (measure(mid) > target ? low : high) = mid;
            }
          // Maps with equal heights have jumps in the contact fraction: no two points on one jump.
          if (high - result.back() > 1e-6 * (top - bottom) && top - high > 1e-6 * (top - bottom))
            result.push_back(high);
        }
      result.push_back(top);
      return result;
    }

    /// Combined Sq of both surfaces, undeformed.
    double
    combined_sq(const HeightDistribution &sheet, const HeightMap &tool)
    {
      double sum = sheet.sq() * sheet.sq();
      if (tool.size() > 0)
        sum += std::pow(HeightDistribution(tool).sq(), 2);
      return std::sqrt(sum);
    }

    class Build
    {
    public:
      Build(const PairDescription &p, const std::function<void(double)> &report_progress)
          : pair(p), axes(p.axes), heights(p.sheet), film_heights(sum_of_heights(p.sheet, p.tool)),
            reference_sq(combined_sq(heights, p.tool)),
            flattest(heights.cut_height_for_contact_fraction(largest_contact_fraction)), law(p.flattening->with_spacing_of(p.sheet)),
            progress(report_progress)
      {
        if (p.flattening->needs_spacing())
          log::info("Asperity half spacing counted on the sheet: " + units::format(law.half_spacing(), "um") + ".");
      }

      FrictionTable
      run()
      {
        add_points();
        make_shear_strength();
        make_cut_heights();
        make_curves();
        make_flattening();
        make_boundary_layer();
        report(0.05);
        make_ploughing();
        report(0.15);
        make_flow_factors();
        report(1.);
        return table;
      }

    private:
      const PairDescription            &pair;
      FrictionTableAxes                 axes;         // with the points that were added
      const HeightDistribution          heights;      // of the sheet
      const HeightDistribution          film_heights; // of sheet + tool: the gap
      const double                      reference_sq;
      const double                      flattest; // cut height at which the sheet counts as flat
      const Flattening                  law;
      const std::function<void(double)> progress;
      FrictionTable                     table;

      void
      report(const double done) const
      {
        if (progress)
          progress(done);
      }

      const Flattening &
      flattening() const
      {
        return law;
      }
      SheetStrength
      strength(const double eps) const
      {
        return flattening().strength(*pair.hardening, eps);
      }
      Axis
      pressure_axis(const AxisScale scale) const
      {
        return { axes.pressures, scale };
      }
      Axis
      strain_axis() const
      {
        return { axes.strains, AxisScale::linear };
      }

      /// Difference of two states as the interpolation error counts it.
      double
      difference(const double s, const double other) const
      {
        return std::max(std::abs(heights.contact_fraction(s) - heights.contact_fraction(other)),
                        std::abs(film_heights.mean_gap(s) - film_heights.mean_gap(other)) / reference_sq);
      }

      /// Cut heights at all strains for each pressure, down to a flat sheet.
      std::vector<std::vector<double>>
      cut_heights(const std::vector<double> &pressures, const std::vector<double> &strains) const
      {
        std::vector<std::vector<double>> result(pressures.size());
        parallel::for_range(pressures.size(), 1, [&](const std::size_t begin, const std::size_t end) {
          for (std::size_t i = begin; i < end; ++i)
            {
              result[i] = flattening().monotone_cut_heights(heights, *pair.hardening, pressures[i], strains);
              for (double &s : result[i])
                s = std::max(s, flattest);
            }
        });
        return result;
      }

      /// Between two points of an axis the table interpolates linearly (pressures: in their logarithm), so the error is
      /// greatest about halfway. Points are added there until it is small enough.
      void
      add_points()
      {
        constexpr unsigned int max_rounds = 16; // the film falls steeply where straining begins
        double                 error      = 0;
        for (unsigned int round = 0; round <= max_rounds; ++round)
          {
            const auto         &p = axes.pressures, &e = axes.strains;
            std::vector<double> p_mid, e_mid;
            for (std::size_t i = 0; i + 1 < p.size(); ++i)
              p_mid.push_back(std::sqrt(p[i] * p[i + 1]));
            for (std::size_t j = 0; j + 1 < e.size(); ++j)
              e_mid.push_back(0.5 * (e[j] + e[j + 1]));
            std::vector<double> e_all = e;
            e_all.insert(e_all.end(), e_mid.begin(), e_mid.end());
            std::sort(e_all.begin(), e_all.end()); // the points themselves at even places
            const auto          s = cut_heights(p, e_all), between = cut_heights(p_mid, e_all);
            std::vector<double> p_error(p_mid.size(), 0.), e_error(e_mid.size(), 0.);
            for (std::size_t i = 0; i < p_mid.size(); ++i)
              for (std::size_t j = 0; j < e_all.size(); j += 2)
                p_error[i] = std::max(p_error[i], difference(between[i][j], 0.5 * (s[i][j] + s[i + 1][j])));
            for (std::size_t i = 0; i < p.size(); ++i)
              for (std::size_t j = 0; j < e_mid.size(); ++j)
                e_error[j] = std::max(e_error[j], difference(s[i][2 * j + 1], 0.5 * (s[i][2 * j] + s[i][2 * j + 2])));
            error = std::max(*std::max_element(p_error.begin(), p_error.end()),
                             *std::max_element(e_error.begin(), e_error.end()));
            if (error <= axes.interpolation_error || round == max_rounds)
              break;
            const std::size_t before = p.size() + e.size();
            insert(axes.pressures, p_mid, p_error);
            insert(axes.strains, e_mid, e_error);
            if (axes.pressures.size() + axes.strains.size() == before)
              break; // as many as allowed
          }
        table.provenance["interpolation_error"] = error;
        table.provenance["pressures_mpa"]       = axes.pressures;
        table.provenance["strains"]             = axes.strains;
        log::info("Friction table: " + std::to_string(axes.pressures.size()) + " pressures, "
                  + std::to_string(axes.strains.size())
                  + " strains; halfway between them contact fraction and film (over Sq) are off by at most "
                  + units::number(std::round(error * 1e5) / 1e5) + ".");
      }

      /// The middles with the greatest errors, as far as the axis may grow.
      void
      insert(std::vector<double> &points, const std::vector<double> &middles, const std::vector<double> &errors) const
      {
        std::vector<std::size_t> order;
        for (std::size_t i = 0; i < middles.size(); ++i)
          if (errors[i] > axes.interpolation_error)
            order.push_back(i);
        std::stable_sort(order.begin(), order.end(),
                         [&](const std::size_t a, const std::size_t b) { return errors[a] > errors[b]; });
        for (const std::size_t i : order)
          if (points.size() < axes.max_points)
            points.push_back(middles[i]);
        std::sort(points.begin(), points.end());
      }

      void
      make_shear_strength()
      {
        // Hardening is steepest at the start: points spread quadratically.
        const unsigned int  n    = 200;
        const double        last = axes.strains.back();
        std::vector<double> eps, k;
        for (unsigned int i = 0; i <= n; ++i)
          eps.push_back(last * i * i / (static_cast<double>(n) * n));
        eps.insert(eps.end(), axes.strains.begin(), axes.strains.end()); // exact there
        std::sort(eps.begin(), eps.end());
        eps.erase(std::unique(eps.begin(), eps.end(), [](double a, double b) { return b - a < 1e-12; }), eps.end());
        for (const double e : eps)
          k.push_back(strength(e).shear_strength);
        table.shear_strength = Table<1>({ Axis{ eps, AxisScale::linear } }, k);
      }

      void
      make_cut_heights()
      {
        const auto         &pressures = axes.pressures, &strains = axes.strains;
        std::vector<double> monotone(pressures.size() * strains.size()), normal(monotone.size());
        const auto          s = cut_heights(pressures, strains);
        for (std::size_t i = 0; i < pressures.size(); ++i)
          for (std::size_t j = 0; j < strains.size(); ++j)
            {
              monotone[i * strains.size() + j] = s[i][j];
              normal[i * strains.size() + j]
                  = std::max(flattest, flattening().cut_height_under_load(heights, pressures[i], strength(strains[j])));
            }
        // Neighbouring pressures may end on one pixel, in either order by round-off.
        for (std::size_t i = 1; i < pressures.size(); ++i)
          for (std::size_t j = 0; j < strains.size(); ++j)
            monotone[i * strains.size() + j]
                = std::min(monotone[i * strains.size() + j], monotone[(i - 1) * strains.size() + j]);
        table.cut_height_monotone = Table<2>({ pressure_axis(AxisScale::logarithmic), strain_axis() }, monotone);
        table.cut_height_normal   = Table<2>({ pressure_axis(AxisScale::logarithmic), strain_axis() }, normal);
      }

      void
      make_curves()
      {
        table.sq                 = reference_sq;
        table.initial_cut_height = heights.highest();
        const double lowest      = table.cut_height_monotone.values().back(); // largest pressure and strain
        if (table.cut_height_monotone.values().front() <= flattest)
          throw InputError(describe_error(
              "The sheet surface is pressed flat at every pressure and strain of the table",
              "`Friction table/Pressures`", "from " + units::format(axes.pressures.front(), "MPa") + " on",
              "a contact fraction of at most " + units::number(largest_contact_fraction) + " at the smallest",
              "Add smaller pressures."));
        if (lowest <= flattest)
          log::info("Friction table: at its largest pressures and strains the sheet is flat (contact fraction "
                    + units::number(largest_contact_fraction) + ").");
        // A little below the lowest state, so that interpolated states stay inside.
        const double margin = 0.05 * (heights.highest() - lowest);
        const double bottom
            = std::max(lowest - margin, heights.cut_height_for_contact_fraction(0.5 * (1. + largest_contact_fraction)));
        auto &c      = table.curves;
        c.cut_height = spread_cut_heights(heights, std::min(bottom, lowest), heights.highest(), axes.n_curve_points);
        for (const double s : c.cut_height)
          {
            c.contact_fraction.push_back(heights.contact_fraction(s));
            c.h_avg.push_back(film_heights.mean_gap(s));
          }
      }

      void
      make_flattening()
      {
        std::vector<double> values;
        for (const double p : axes.pressures)
          for (const double eps : axes.strains)
            for (const double s : table.curves.cut_height)
              values.push_back(
                  std::min(FrictionTable::rigid_strain_load,
                           p * flattening().strain_per_descent(PlateauState(heights, s), p, strength(eps))));
        table.strain_load_per_descent = Table<3>(
            { pressure_axis(AxisScale::linear), strain_axis(), Axis{ table.curves.cut_height, AxisScale::linear } },
            values);
      }

      void
      make_boundary_layer()
      {
        // Five points a decade: a power law needs two, others are smooth in logarithms.
        std::vector<double> p0, tau;
        for (int i = -10; i <= 25; ++i)
          {
            p0.push_back(std::pow(10., i / 5.));
            tau.push_back(pair.boundary_friction.shear_law->shear_stress(p0.back()));
          }
        table.boundary_layer_shear = Table<1>({ Axis{ p0, AxisScale::logarithmic } }, tau);
      }

      void
      make_ploughing()
      {
        const auto         &pressures = axes.pressures, &strains = axes.strains;
        std::vector<double> coefficient(pressures.size() * strains.size(), 0.);
        std::vector<double> full_contact(coefficient.size(), 0.);
        if (pair.tool.size() > 0)
          {
            const timing::Scope scope("friction_table/ploughing");
            const ToolSurface   tool(pair.tool, pair.boundary_friction.ploughing_directions);
            const std::size_t   n_ranks = parallel::size(), first = parallel::rank();
            const std::size_t   n_own = (coefficient.size() + n_ranks - 1 - first) / n_ranks;
            parallel::for_range(n_own, 1, [&](const std::size_t begin, const std::size_t end) {
              for (std::size_t own = begin; own < end; ++own)
                {
                  const std::size_t   point = first + own * n_ranks;
                  const double        p = pressures[point / strains.size()], eps = strains[point % strains.size()];
                  const double        s   = table.cut_height_monotone.values()[point];
                  const SheetStrength now = strength(eps);
                  const double        k   = now.shear_strength;
                  // The distribution is about the mean of the map, and the pixel at s belongs to the plateau.
                  const PlateauContact contact(pair.sheet, tool, s + heights.mean() - 1e-9 * heights.sq());
                  const double         p0      = plateau_pressure(p, heights.contact_fraction(s));
                  const double         tau     = pair.boundary_friction.layer_shear(p0, k);
                  const auto           balance = balance_ploughing(contact, *pair.boundary_friction.ploughing, p,
                                                                   { flattening().hardness(now), k, tau });
                  coefficient[point]           = std::max(0., balance.coefficient);
                  full_contact[point]          = balance.full_contact;
                }
            });
          }
        parallel::sum(coefficient);
        parallel::sum(full_contact);
        table.ploughing_coefficient = Table<2>({ pressure_axis(AxisScale::logarithmic), strain_axis() }, coefficient);
        table.provenance["ploughing_points_in_full_contact"] = std::count(full_contact.begin(), full_contact.end(), 1.);
        table.provenance["asperity_half_spacing_mm"]         = flattening().half_spacing();
      }

      std::vector<FlowFactors>
      compute(const std::vector<double> &cuts, const double from, const double to) const
      {
        auto factors = pair.flow_factors->compute(pair.sheet, pair.tool, table.sq, cuts,
                                                  [&](const double done) { report(from + (to - from) * done); });
        if (factors.size() != cuts.size())
          throw std::logic_error("The flow factor model returned a wrong number of results.");
        return factors;
      }

      /// Estimated interpolation error on both sides of each inner point: what a curve through the other points misses
      /// it by. That curve has gaps of twice the width; for a smooth function and a curve that is piecewise cubic the
      /// true error is several times smaller.
      static std::vector<double>
      factor_errors(const std::vector<double> &cuts, const std::vector<FlowFactors> &factors)
      {
        constexpr double    gain = 4; // of halving the width: second order, as where the curve is kept monotone
        std::vector<double> errors(cuts.size(), 0.);
        for (std::size_t leave = 1; leave + 1 < cuts.size(); ++leave)
          for (std::size_t component = 0; component < 8; ++component)
            {
              const auto value
                  = [&](const FlowFactors &f) { return component < 4 ? f.phi_p[component] : f.phi_s[component - 4]; };
              std::vector<double> x, y;
              for (std::size_t i = 0; i < cuts.size(); ++i)
                if (i != leave)
                  {
                    x.push_back(cuts[i]);
                    y.push_back(value(factors[i]));
                  }
              const double missed = std::abs(MonotoneCurve(x, y)(cuts[leave]) - value(factors[leave]));
              errors[leave]       = std::max(errors[leave], missed / gain);
            }
        return errors;
      }

      /// Middles of the intervals beside points that the others do not foretell well enough.
      std::vector<double>
      doubtful_middles(const std::vector<double> &cuts, const std::vector<FlowFactors> &factors) const
      {
        const auto          errors = factor_errors(cuts, factors);
        std::vector<double> middles;
        for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
          if (std::max(errors[i], errors[i + 1]) > axes.interpolation_error)
            middles.push_back(0.5 * (cuts[i] + cuts[i + 1]));
        return middles;
      }

      void
      make_flow_factors()
      {
        auto               &c = table.curves;
        std::vector<double> cuts
            = spread_cut_heights(heights, c.cut_height.front(), c.cut_height.back(), axes.n_cut_heights);
        std::vector<FlowFactors>  factors = compute(cuts, 0.15, 0.75);
        const std::vector<double> added   = doubtful_middles(cuts, factors);
        if (!added.empty())
          {
            const auto more = compute(added, 0.75, 1.);
            factors.insert(factors.end(), more.begin(), more.end());
            cuts.insert(cuts.end(), added.begin(), added.end());
            std::sort(cuts.begin(), cuts.end());
            std::sort(factors.begin(), factors.end(),
                      [](const FlowFactors &x, const FlowFactors &y) { return x.cut_height < y.cut_height; });
          }
        const auto errors                                   = factor_errors(cuts, factors);
        table.provenance["flow_factor_interpolation_error"] = *std::max_element(errors.begin(), errors.end());

        const auto interpolate = [&](std::vector<double> &curve, const auto &value) {
          std::vector<double> points;
          for (const FlowFactors &f : factors)
            points.push_back(value(f));
          const MonotoneCurve smooth(cuts, points);
          for (const double s : c.cut_height)
            curve.push_back(smooth(s));
        };
        std::vector<double> *phi_p[] = { &c.phi_p_xx, &c.phi_p_xy, &c.phi_p_yx, &c.phi_p_yy };
        std::vector<double> *phi_s[] = { &c.phi_s_xx, &c.phi_s_xy, &c.phi_s_yx, &c.phi_s_yy };
        for (std::size_t i = 0; i < 4; ++i)
          {
            const bool diagonal = i == 0 || i == 3; // round-off of a closed gap must not be a negative conductance
            interpolate(*phi_p[i],
                        [&](const FlowFactors &f) { return diagonal ? std::max(0., f.phi_p[i]) : f.phi_p[i]; });
            interpolate(*phi_s[i], [&](const FlowFactors &f) { return f.phi_s[i]; });
          }
        table.provenance["flow_factor_cut_heights_mm"] = cuts;
      }
    };
  } // namespace

  FrictionTable
  build_friction_table(const PairDescription &pair, const std::function<void(double)> &progress)
  {
    const timing::Scope scope("friction_table/build");
    check_pair(pair);
    FrictionTable table              = Build(pair, progress).run();
    table.provenance["sheet_map"]    = { { "hash", pair.sheet.hash() }, { "description", pair.sheet.description } };
    table.provenance["tool_map"]     = { { "hash", pair.tool.hash() }, { "description", pair.tool.description } };
    table.provenance["flow_factors"] = pair.flow_factors->fingerprint();
    table.check("friction table");
    return table;
  }
} // namespace tribodraw
