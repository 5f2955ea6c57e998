#ifndef tribodraw_flattening_asperity_model_h
#define tribodraw_flattening_asperity_model_h

namespace tribodraw
{
  class HardeningLaw;
  class HeightDistribution;
  class Parameters;

  /// The flattened sheet as asperity models see it.
  struct PlateauState
  {
    /// A state of which only the contact fraction is known: enough for models that do not ask for the heights.
    PlateauState(double contact_fraction) : contact_fraction(contact_fraction) {}
    PlateauState(const HeightDistribution &heights, double cut_height);

    double                    contact_fraction;
    double                    cut_height = 0;       ///< [mm]
    const HeightDistribution *heights    = nullptr; ///< undeformed heights
  };

  /// The strength of the sheet that carries the asperities.
  struct SheetStrength
  {
    /// A sheet that does not harden.
    SheetStrength(double shear_strength) : shear_strength(shear_strength) {}
    /// The sheet at equivalent plastic strain @p strain and strain rate @p rate [1/s].
    SheetStrength(const HardeningLaw &hardening, double strain, double rate);

    double              shear_strength;      ///< k = flow stress / sqrt(3) [MPa]
    const HardeningLaw *hardening = nullptr; ///< how it hardens further; nullptr: not at all
    double              strain = 0, rate = 0;

    /// Flow stress [MPa] of an asperity strained by @p extra beyond the sheet.
    double flow_stress(double extra = 0) const;
  };

  /// How much load an array of asperities carries without bulk straining of the sheet.
  class AsperityModel
  {
  public:
    virtual ~AsperityModel() = default;
    static const char *
    kind()
    {
      return "asperity model";
    }
    /// Solid pressure per nominal area [MPa] that holds the state; increasing with the contact fraction, 0 at 0.
    virtual double normal_load(const PlateauState &state, const SheetStrength &strength) const = 0;
    /// Mean pressure on isolated plateaus (contact fraction -> 0) [MPa].
    virtual double hardness(const SheetStrength &strength) const = 0;
    /// True if the load depends on the heights and not on the contact fraction alone.
    virtual bool
    needs_heights() const
    {
      return false;
    }
  };
} // namespace tribodraw

#endif
