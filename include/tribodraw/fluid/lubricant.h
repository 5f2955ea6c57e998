#ifndef tribodraw_fluid_lubricant_h
#define tribodraw_fluid_lubricant_h

#include <tribodraw/fluid/amount_map.h>
#include <tribodraw/fluid/viscosity_law.h>

#include <array>
#include <limits>
#include <memory>

namespace tribodraw
{
  /// The oil on the sheet.
  struct Lubricant
  {
    std::shared_ptr<ViscosityLaw> viscosity_law;
    double                        density = std::numeric_limits<double>::signaling_NaN(); ///< [t/mm^3]
    /// Mass per area of one face, everywhere the same: punch side, die side [t/mm^2].
    std::array<double, 2>            amount{ { 0., 0. } };
    std::shared_ptr<const AmountMap> map; ///< instead of `amount`, if given

    /// Film on a face of the unstretched sheet, all valleys included: amount / density [mm].
    /// @param face 0: punch side, 1: die side; @param x, y on the undeformed blank, from its middle [mm]
    double
    supplied_film(const unsigned face, const double x, const double y) const
    {
      return (map ? map->at(face, x, y) : amount[face]) / density;
    }
    /// The same for a sheet of which one face counts, with one amount.
    double
    supplied_film() const
    {
      return amount[0] / density;
    }

    /// Reads the current subsection (`Lubricant`): `Viscosity`, `Viscosity law`, `Density`, `Amount` or
    /// `Amount file` (@p maps: both are allowed, and an amount for each face). The law is missing (null) if the file has a problem there, which Parameters::finish() reports.
    static Lubricant read(Parameters &parameters, bool maps = true);
  };
} // namespace tribodraw

#endif
