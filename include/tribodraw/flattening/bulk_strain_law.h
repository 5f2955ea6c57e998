#ifndef tribodraw_flattening_bulk_strain_law_h
#define tribodraw_flattening_bulk_strain_law_h

namespace tribodraw
{
  class Parameters;

  /// How bulk plastic strain softens loaded asperities.
  class BulkStrainLaw
  {
  public:
    virtual ~BulkStrainLaw() = default;
    static const char *
    kind()
    {
      return "bulk strain law";
    }
    /// Dimensionless strain rate E = (bulk strain rate) * (asperity half spacing) / (closing velocity) at which
    /// plateaus of fraction @p contact_fraction have the mean pressure @p hardness, if they have @p hardness_at_rest
    /// without strain; both in units of the shear strength k. Zero where both are equal, increasing as the hardness
    /// falls. Negative where the load alone still flattens: the sign is kept so that tables interpolate a smooth
    /// function through zero; users take max(E, 0). Infinite if bulk strain does not flatten in this law.
    virtual double strain_rate_number(double contact_fraction, double hardness, double hardness_at_rest) const = 0;
  };
} // namespace tribodraw

#endif
