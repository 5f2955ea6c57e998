#ifndef tribodraw_flattening_asperity_model_h
#define tribodraw_flattening_asperity_model_h

namespace tribodraw
{
  class Parameters;

  /// How much load an asperity array carries and how fast bulk straining flattens it.
  class AsperityModel
  {
  public:
    virtual ~AsperityModel() = default;
    static const char *
    kind()
    {
      return "asperity model";
    }
    /// Solid pressure per nominal area [MPa] that holds contact fraction @p contact_fraction without bulk strain;
    /// increasing, 0 at 0. @param shear_strength k = flow stress / sqrt(3) of the sheet [MPa].
    virtual double normal_load(double contact_fraction, double shear_strength) const = 0;
    /// Dimensionless strain rate E = (bulk strain rate) * (asperity half spacing) / (closing velocity) at which the
    /// plateaus of fraction @p contact_fraction carry @p solid_pressure (> 0); increasing with the contact fraction.
    /// Negative where the load alone still flattens: the sign is kept so that tables interpolate a smooth function
    /// through zero; users take max(E, 0). Infinite if bulk strain does not flatten in this model.
    virtual double strain_rate_number(double contact_fraction, double solid_pressure, double shear_strength) const = 0;
  };
} // namespace tribodraw

#endif
