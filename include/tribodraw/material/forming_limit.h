#ifndef tribodraw_material_forming_limit_h
#define tribodraw_material_forming_limit_h

namespace tribodraw
{
  class Parameters;

  /// Limit of the major true strain in the sheet plane at which a neck forms, over the minor true strain
  /// (proportional straining).
  class FormingLimitCurve
  {
  public:
    virtual ~FormingLimitCurve() = default;
    static const char *
    kind()
    {
      return "forming limit curve";
    }
    /// Positive and continuous for every @p minor_strain.
    virtual double limit(double minor_strain) const = 0;
  };

  /// Major strain over its limit: below one safe, one necks. The output field `flc_margin`.
  double forming_limit_margin(const FormingLimitCurve &curve, double major_strain, double minor_strain);
} // namespace tribodraw

#endif
