#include <tribodraw/base/parameters.h>
#include <tribodraw/flattening/asperity_model.h>
#include <tribodraw/flattening/height_distribution.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tribodraw
{
  namespace
  {
    /// Energy balance of bars under a flat tool with volume conservation (Westeneng 2001; Hol and others).
    ///
    /// The tool at distance d = s + u from the mean plane has crushed every bar z > d by z - d; every other bar was
    /// raised by min(d - z, u). Work of the sheet per nominal area, with the work w(x) of displacing a bar by x per its
    /// area:
    ///   W = < w_crush(z - d) >_(z>d) + eta < w_raise(min(d - z, u)) >_(z<d),
    /// eta the persistence parameter. The tool does P omega with the mean indentation omega = < z - d >_(z>d) / f of
    /// the bars that carry, their fraction f. W = P omega gives P. Ideally plastic: w = H x and P = (1 + eta) H f.
    ///
    /// Work hardening: a bar of height lambda displaced by x has the strain |ln(1 -+ x/lambda)| on top of the sheet's,
    /// and w = integral of B sigma_y over x.
    class EnergyBars : public AsperityModel
    {
    public:
      explicit EnergyBars(Parameters &parameters)
          : ratio(parameters.quantity("Hardness over flow stress", "", Range::positive().usual(1, 6),
                                      "Indentation hardness divided by the flow stress (Tabor: 2.8).")),
            persistence(parameters.quantity("Persistence parameter", "", Range::between(0, 1),
                                            "Work of raising material relative to that of crushing it: 0 if raising "
                                            "costs nothing (or is part of the hardness already), 1 if it costs as "
                                            "much as crushing.")),
            all_carry(parameters.choice("Load carried by", { "touching bars", "crushed bars" },
                                        "The bars that share the load: all that touch the tool, or only those that "
                                        "it has pushed down.",
                                        Default{ "touching bars", "the plateau is level: raised and crushed bars "
                                                                  "press on the tool alike" })
                      == "touching bars"),
            hardens(parameters.flag("Work hardening",
                                    "Whether bars harden by their own displacement, in addition to the sheet.")),
            bar_height(hardens || parameters.documentation_mode()
                           ? parameters.quantity("Bar height", "um", Range::positive().usual(0.1, 1000),
                                                 "Initial height of the bars, the length that turns displacement into "
                                                 "strain: the depth to which asperities deform. Needed with `Work "
                                                 "hardening`.")
                           : 0.)
      {
        if (!hardens)
          parameters.mark_unselected("Bar height");
      }

      double
      hardness(const SheetStrength &strength) const override
      {
        return (1. + persistence) * ratio * strength.flow_stress();
      }

      bool
      needs_heights() const override
      {
        return hardens || !all_carry;
      }

      double
      normal_load(const PlateauState &state, const SheetStrength &strength) const override
      {
        const double alpha = state.contact_fraction;
        if (!needs_heights() || !(alpha > 0))
          return hardness(strength) * alpha;
        if (!state.heights)
          throw std::logic_error("This asperity model needs the heights of the sheet.");
        const HeightDistribution &heights = *state.heights;
        const double              u       = heights.uniform_rise(state.cut_height);
        const double              d       = state.cut_height + u;
        const double              carries = all_carry ? alpha : heights.contact_fraction(d);
        const double              crushed = heights.uniform_rise(d); // < z - d > over z > d
        if (!hardens || !strength.hardening || !(crushed > 1e-12 * heights.sq()))
          return hardness(strength) * carries;
        const double work = crushing_work(heights, d, strength) + persistence * raising_work(heights, d, u, strength);
        return work * carries / crushed;
      }

    private:
      const double ratio, persistence;
      const bool   all_carry, hardens;
      const double bar_height;

      /// Pieces of a straight-line approximation of w(x). Spread quadratically, as steel hardens fastest at the start;
      /// the work is then exact to 1e-4 for linear hardening,
      /// 3e-4 for a law as steep at the start as 500 (eps + 0.005)^0.22.
      static constexpr unsigned int n_pieces = 48;
      /// Bars are never strained more than this (95 % of their height crushed).
      static constexpr double largest_strain = 3.;

      static double
      knot(const unsigned int i, const double largest)
      {
        return largest * i * i / (static_cast<double>(n_pieces) * n_pieces);
      }

      double
      pressure(const double x, const bool crushing, const SheetStrength &strength) const
      {
        const double part   = x / bar_height;
        const double strain = crushing ? (part < 1. ? -std::log1p(-part) : largest_strain) : std::log1p(part);
        return ratio * strength.flow_stress(std::min(strain, largest_strain));
      }

      // w(x) of straight lines with slopes p_i from knot x_i on is the sum of (p_i - p_(i-1)) max(0, x - x_i), and the
      // mean of max(0, z - d - x_i) over the map is known exactly: the rise for the cut height d + x_i.
      double
      crushing_work(const HeightDistribution &heights, const double d, const SheetStrength &strength) const
      {
        const double deepest = heights.highest() - d;
        double       work = 0, previous = 0;
        for (unsigned int i = 0; i < n_pieces; ++i)
          {
            const double x = knot(i, deepest), p = pressure(0.5 * (x + knot(i + 1, deepest)), true, strength);
            work += (p - previous) * heights.uniform_rise(d + x);
            previous = p;
          }
        return work;
      }

      double
      raising_work(const HeightDistribution &heights, const double d, const double u,
                   const SheetStrength &strength) const
      {
        // The mean of min(d - z, x) over z < d is x - rise(d - x) + rise(d) (the heights have zero mean): from the
        // rise, which is small itself, no digits are lost at small contact. Nobody rises by more than u.
        double work = 0, rise = heights.uniform_rise(d);
        for (unsigned int i = 0; i < n_pieces; ++i)
          {
            const double x = knot(i, u), next = knot(i + 1, u), next_rise = heights.uniform_rise(d - next);
            work += pressure(0.5 * (x + next), false, strength) * ((next - x) + rise - next_rise);
            rise = next_rise;
          }
        return work;
      }
    };
  } // namespace

  TRIBODRAW_REGISTER(AsperityModel, EnergyBars, "energy of bars",
                     "Work of crushing and raising material equals the work of the tool; persistence parameter and "
                     "work hardening of the asperities.",
                     "Reconstruction after J.D. Westeneng: Modelling of contact and friction in deep drawing "
                     "processes. PhD thesis, University of Twente 2001; J. Hol: Multi-scale friction modeling for "
                     "sheet metal forming. PhD thesis, University of Twente 2013")
} // namespace tribodraw
