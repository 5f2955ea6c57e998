#include <tribodraw/base/parameters.h>
#include <tribodraw/base/units.h>
#include <tribodraw/surface/map_operations.h>
#include <tribodraw/surface/surface.h>
#include <tribodraw/surface/texture.h>

namespace tribodraw
{
  namespace
  {
    /// A periodic map from a seed, scaled to exactly the prescribed Sq and zero mean.
    class GeneratedSurface : public SurfaceSource
    {
    public:
      explicit GeneratedSurface(Parameters &parameters)
          : texture(parameters.model<SurfaceTexture>("Texture", "Kind of the generated surface.")),
            pixels(parameters.integer("Pixels", Range::between(16, 16384),
                                      "Number of pixels along x and along y; the map is square.")),
            pixel_size(
                parameters.quantity("Pixel size", "um", Range::positive().usual(0.05, 20.), "Edge length of a pixel.")),
            sq(parameters.quantity("Sq", "um", Range::positive().usual(0.01, 20.),
                                   "Root mean square height. The map is scaled to exactly this value.")),
            seed(
                parameters.integer("Seed", Range::between(0, 9007199254740992.),
                                   "Start of the random numbers: the same seed gives the same map on every machine and "
                                   "number of processes."))
      {
        if (parameters.documentation_mode() || parameters.has_problems() || !texture)
          return;
        if (const std::string memory = memory_problem(static_cast<double>(pixels), static_cast<double>(pixels));
            !memory.empty())
          {
            parameters.problem("Pixels", memory + ".", "", "Use fewer pixels.");
            return;
          }
        const std::string problem = texture->problem(grid());
        if (!problem.empty())
          parameters.problem("", problem, "lengths between some pixels and a quarter of the map, possible moments",
                             "Change `Pixels`, `Pixel size` or the entry named.");
      }

      HeightMap
      make() const override
      {
        NormalDeviates deviates(static_cast<std::uint64_t>(seed));
        const Grid     g = grid();
        HeightMap      map;
        map.nx = g.nx;
        map.ny = g.ny;
        map.dx = g.dx;
        map.dy = g.dy;
        map.z  = texture->heights(g, deviates);
        normalise(map.z);
        for (double &height : map.z)
          height *= sq;
        map.periodic    = true;
        map.description = "generated, " + std::to_string(map.nx) + " x " + std::to_string(map.ny) + " pixels of "
                          + units::format(map.dx, "um") + ", Sq " + units::format(sq, "um") + ", seed "
                          + std::to_string(seed);
        return map;
      }

      bool
      needs_levelling() const override
      {
        return false;
      }

    private:
      Grid
      grid() const
      {
        const auto n = static_cast<std::size_t>(pixels);
        return { n, n, pixel_size, pixel_size };
      }

      std::unique_ptr<SurfaceTexture> texture;
      long                            pixels;
      double                          pixel_size, sq;
      long                            seed;
    };
  } // namespace

  TRIBODRAW_REGISTER(SurfaceSource, GeneratedSurface, "generated",
                     "A periodic random surface from a seed, with prescribed Sq and texture.", "")
} // namespace tribodraw
