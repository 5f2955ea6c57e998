#ifndef tribodraw_fluid_lubricant_h
#define tribodraw_fluid_lubricant_h

#include <tribodraw/fluid/viscosity_law.h>

#include <memory>

namespace tribodraw
{
  /// The oil on the sheet.
  struct Lubricant
  {
    std::shared_ptr<ViscosityLaw> viscosity_law;
    double                        density = std::numeric_limits<double>::signaling_NaN(); ///< [t/mm^3]
    double amount = std::numeric_limits<double>::signaling_NaN(); ///< on each face of the sheet [t/mm^2]

    /// Film on each face of the unstretched sheet, all valleys included: amount / density [mm].
    double
    supplied_film() const
    {
      return amount / density;
    }

    /// Reads the current subsection (`Lubricant`): `Viscosity`, `Viscosity law`, `Density`, `Amount`. The law is
    /// missing (null) if the file has a problem there, which Parameters::finish() reports.
    static Lubricant read(Parameters &parameters);
  };
} // namespace tribodraw

#endif
