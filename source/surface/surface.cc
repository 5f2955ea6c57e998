#include <tribodraw/base/errors.h>
#include <tribodraw/base/log.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/base/timing.h>
#include <tribodraw/base/units.h>
#include <tribodraw/surface/processing.h>
#include <tribodraw/surface/surface.h>

#include <cmath>

namespace tribodraw
{
  namespace
  {
    /// A wrong unit shows in Sq: real sheet and tool surfaces are between these values.
    void
    warn_if_unusual(const HeightMap &map)
    {
      double sum = 0;
      for (const double z : map.z)
        sum += z * z;
      const double sq = std::sqrt(sum / static_cast<double>(map.size())), um = 1e-3;
      if (sq < 0.01 * um || sq > 20. * um)
        log::warning(describe_error("Sq of the surface is unusual.", map.description, units::format(sq, "um"),
                                    "0.01 um to 20 um", "Check the unit of the heights."));
    }
  } // namespace

  std::function<HeightMap()>
  read_surface(Parameters &parameters)
  {
    const std::shared_ptr<const SurfaceSource> source
        = parameters.model<SurfaceSource>("Model", "Where the surface comes from.");
    const Processing  processing(parameters, !source || source->needs_levelling());
    const std::string section = parameters.path();
    return [source, processing, section]() {
      const timing::Scope scope("surface/make");
      if (!source)
        throw InputError(describe_error("the surface is not defined.", section));
      HeightMap map = source->make();
      processing.apply(map);
      if (map.size() > 0)
        warn_if_unusual(map);
      return map;
    };
  }
} // namespace tribodraw
