#ifndef tribodraw_flattening_flattening_h
#define tribodraw_flattening_flattening_h

#include <tribodraw/flattening/asperity_model.h>
#include <tribodraw/flattening/bulk_strain_law.h>
#include <tribodraw/flattening/height_distribution.h>

#include <memory>
#include <vector>

namespace tribodraw
{
  class HardeningLaw;

  /// Flattening of a sheet's asperities by normal load and by bulk plastic strain. The state is the cut height s; it
  /// never rises.
  ///
  /// Load alone: s is the height at which the asperity model carries the solid pressure, P = normal_load(s, k). Bulk
  /// strain at constant load lowers s further,
  ///   d eps / d(-s) = E(alpha(s), P, k(eps)) / l                (Wilson and Sheu 1988, in terms of s),
  /// with half the asperity spacing l and the shear strength k = flow stress / sqrt(3) of the hardening sheet.
  /// The strain is integrated as a function of s, because ds/d eps is infinite where straining starts (E = 0).
  /// P is the solid pressure per nominal area, P_nom - P_lub (see doc/theory/flattening.md, Which pressure).
  class Flattening
  {
  public:
    /// Reads the current subsection (`Flattening`): `Model`, `Bulk strain`, `Asperity half spacing`, `Strain rate`.
    static Flattening read(Parameters &parameters);
    /// @param half_spacing l [mm], 0: not known before with_spacing_of(); @param strain_rate at which the flow stress
    /// is taken [1/s]; @param bulk_strain nullptr: strain does not flatten; @param pruning see count_asperities().
    Flattening(std::shared_ptr<const AsperityModel> model, double half_spacing, double strain_rate,
               std::shared_ptr<const BulkStrainLaw> bulk_strain = nullptr, double pruning = 0.05);

    /// True if the asperity spacing is still to be taken from the sheet (`from map`).
    bool needs_spacing() const;
    /// The same with the asperity spacing counted on @p sheet, if it was to be taken from there.
    Flattening with_spacing_of(const HeightMap &sheet) const;

    /// The sheet's strength at equivalent plastic strain @p eps.
    SheetStrength strength(const HardeningLaw &hardening, double eps) const;
    /// k = flow stress / sqrt(3) [MPa] at equivalent plastic strain @p eps.
    double shear_strength(const HardeningLaw &hardening, double eps) const;
    /// Mean pressure on isolated plateaus (contact fraction -> 0) [MPa]: the hardness.
    double hardness(const SheetStrength &strength) const;
    /// Solid pressure [MPa] that holds @p state without bulk strain.
    double normal_load(const PlateauState &state, const SheetStrength &strength) const;
    /// Contact fraction that carries @p p_solid without bulk strain, for models that need no heights.
    double contact_fraction_under_load(double p_solid, const SheetStrength &strength) const;
    /// Cut height [mm] under load alone; the top of the map for zero load.
    double cut_height_under_load(const HeightDistribution &heights, double p_solid,
                                 const SheetStrength &strength) const;
    /// d eps / d(-s) = E/l [1/mm]; negative where the load alone still flattens, infinite if strain does not flatten.
    double strain_per_descent(const PlateauState &state, double p_solid, const SheetStrength &strength) const;

    /// Cut height [mm] after the solid pressure @p p_solid has acted on the state @p s_old at strain @p eps_old and
    /// the sheet was then strained to @p eps_new under it. Never above @p s_old.
    double advance(const HeightDistribution &heights, const HardeningLaw &hardening, double s_old, double p_solid,
                   double eps_old, double eps_new) const;
    /// Cut heights [mm] after loading the undeformed sheet with @p p_solid (constant) and straining it from 0 to each
    /// of @p strains (ascending).
    std::vector<double> monotone_cut_heights(const HeightDistribution &heights, const HardeningLaw &hardening,
                                             double p_solid, const std::vector<double> &strains) const;

    double half_spacing() const; ///< [mm]
    double
    strain_rate() const
    {
      return rate;
    } ///< [1/s]

  private:
    std::shared_ptr<const AsperityModel> model;
    std::shared_ptr<const BulkStrainLaw> bulk_strain;
    double                               l, rate, pruning;

    std::vector<double> strain_under_load(const HeightDistribution &heights, const HardeningLaw &hardening, double s,
                                          double p_solid, double eps, const std::vector<double> &strains) const;
  };

  /// Distance x <= length over which a rate that runs linearly from @p rate_a (at 0) to @p rate_b (at @p length)
  /// collects @p amount: root of rate_a x + (rate_b - rate_a) x^2 / (2 length) = amount. Rates are not negative, not
  /// both zero.
  double distance_for_amount(double amount, double rate_a, double rate_b, double length);
} // namespace tribodraw

#endif
