#include <tribodraw/base/errors.h>
#include <tribodraw/base/units.h>
#include <tribodraw/surface/levelling.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace tribodraw
{
  namespace
  {
    using Heights = Eigen::Map<Eigen::ArrayXd>;

    void
    check_zero_mean(const HeightMap &map, double mean, double sq)
    {
      if (std::abs(mean) > 1e-6 * sq)
        throw InputError(describe_error("the mean height of the surface is not zero.", map.description,
                                        units::format(mean, "um"), "zero mean, since `Levelling = none`",
                                        "Use `Levelling = plane` or `mean`."));
    }

    /// The centred pixel coordinates are orthogonal to each other and to 1 on a full grid, so that each slope is a
    /// single quotient.
    void
    subtract_plane(HeightMap &map)
    {
      const double centre_x = 0.5 * (static_cast<double>(map.nx) - 1.),
                   centre_y = 0.5 * (static_cast<double>(map.ny) - 1.);
      double zx = 0, zy = 0, xx = 0, yy = 0;
      for (std::size_t iy = 0; iy < map.ny; ++iy)
        for (std::size_t ix = 0; ix < map.nx; ++ix)
          {
            const double x = static_cast<double>(ix) - centre_x, y = static_cast<double>(iy) - centre_y,
                         z = map(ix, iy);
            zx += z * x;
            zy += z * y;
            xx += x * x;
            yy += y * y;
          }
      const double slope_x = xx > 0. ? zx / xx : 0., slope_y = yy > 0. ? zy / yy : 0.;
      for (std::size_t iy = 0; iy < map.ny; ++iy)
        for (std::size_t ix = 0; ix < map.nx; ++ix)
          map(ix, iy)
              -= slope_x * (static_cast<double>(ix) - centre_x) + slope_y * (static_cast<double>(iy) - centre_y);
      map.periodic = false;
    }
  } // namespace

  const std::vector<std::string> &
  levelling_names()
  {
    static const std::vector<std::string> names{ "none", "mean", "plane" };
    return names;
  }

  void
  level(HeightMap &map, const std::string &levelling)
  {
    const auto &names = levelling_names();
    if (std::find(names.begin(), names.end(), levelling) == names.end())
      throw InputError(describe_error("unknown levelling.", map.description, levelling, "none, mean, plane"));
    if (map.size() == 0)
      return;
    Heights      z(map.z.data(), map.z.size());
    const double mean = z.mean();
    if (levelling == "none")
      check_zero_mean(map, mean, std::sqrt((z - mean).square().mean()));
    else
      z -= mean;
    if (levelling == "plane")
      subtract_plane(map);
    map.description += levelling == "none"   ? "; not levelled"
                       : levelling == "mean" ? "; mean subtracted"
                                             : "; least-squares plane subtracted";
  }
} // namespace tribodraw
