#include <tribodraw/base/parameters.h>
#include <tribodraw/base/registry.h>
#include <tribodraw/base/units.h>
#include <tribodraw/surface/texture.h>

#include <algorithm>
#include <cmath>

namespace tribodraw
{
  namespace
  {
    /// Flat plateaus with overlapping round craters at random places (a Boolean model), as electro-discharge textured
    /// rolls leave them on the sheet, and a fine Gaussian roughness on both. The depth of a crater falls from 1 at its
    /// centre to 0 at its rim as 1 - (r/R)^n; where craters overlap the deeper one counts. Craters are added until
    /// their share of the area is as near to the wanted one as one crater allows.
    class CraterTexture : public SurfaceTexture
    {
    public:
      explicit CraterTexture(Parameters &parameters)
          : diameter(parameters.quantity("Crater diameter", "um", Range::positive().usual(1., 1000.),
                                         "Diameter of a crater.")),
            plateau_fraction(parameters.quantity("Plateau area fraction", "", Range::between(0.02, 0.98),
                                                 "Share of the area outside all craters.")),
            exponent(parameters.quantity(
                "Profile exponent", "", Range::between(0.5, 50.),
                "n in the depth 1 - (r/R)^n of a crater: 2 is a paraboloid, larger values make a flat "
                "floor and a steep wall.")),
            fine_ratio(parameters.quantity(
                "Fine roughness ratio", "", Range::non_negative().usual(0., 2.),
                "Root mean square height of the fine roughness, divided by the depth of a crater.")),
            fine_lengths(read_correlation_lengths(parameters, "Fine correlation length",
                                                  "Correlation length of the fine roughness."))
      {
      }

      std::vector<double>
      heights(const Grid &grid, NormalDeviates &deviates) const override
      {
        std::vector<double> z    = craters(grid, deviates);
        const auto          fine = gaussian_field(grid, fine_lengths, deviates);
        for (std::size_t i = 0; i < z.size(); ++i)
          z[i] += fine_ratio * fine[i];
        return z;
      }

      std::string
      problem(const Grid &grid) const override
      {
        const double step   = std::max(grid.dx, grid.dy),
                     extent = std::min(static_cast<double>(grid.nx) * grid.dx, static_cast<double>(grid.ny) * grid.dy);
        const std::string name = "`Craters/Crater diameter` of " + units::format(diameter, "um");
        if (diameter < 4. * step * (1. - 1e-9))
          return name + " is below four pixels (" + units::format(4. * step, "um") + ")";
        if (4. * diameter > extent * (1. + 1e-9))
          return name + " is more than a quarter of the map (" + units::format(extent, "um") + ")";
        return correlation_problem("Craters/Fine correlation length", grid, fine_lengths);
      }

    private:
      std::vector<double>
      craters(const Grid &grid, NormalDeviates &deviates) const
      {
        const auto   nx = static_cast<std::ptrdiff_t>(grid.nx), ny = static_cast<std::ptrdiff_t>(grid.ny);
        const double radius = 0.5 * diameter, size = static_cast<double>(nx * ny),
                     wanted = (1. - plateau_fraction) * size;
        const auto reach_x  = static_cast<std::ptrdiff_t>(radius / grid.dx) + 1,
                   reach_y  = static_cast<std::ptrdiff_t>(radius / grid.dy) + 1;
        std::vector<double> z(grid.nx * grid.ny, 0.);
        // A crater covers at least one free pixel with a probability of the plateau's share, and so they end; the limit
        // is a hundred times the expected number, area / crater area * ln(1 / plateau fraction).
        const double expected = size * grid.dx * grid.dy / (M_PI * radius * radius) * std::log(1. / plateau_fraction);
        double       covered  = 0.;
        std::vector<std::pair<std::size_t, double>> pixels;
        for (double count = 0.; covered < wanted && count < 100. * expected + 1000.; ++count)
          {
            const double x = deviates.uniform() * static_cast<double>(nx),
                         y = deviates.uniform() * static_cast<double>(ny);
            const auto cx = static_cast<std::ptrdiff_t>(x), cy = static_cast<std::ptrdiff_t>(y);
            pixels.clear();
            double fresh = 0.;
            for (std::ptrdiff_t jy = cy - reach_y; jy <= cy + reach_y; ++jy)
              for (std::ptrdiff_t jx = cx - reach_x; jx <= cx + reach_x; ++jx)
                {
                  const double u      = (static_cast<double>(jx) + 0.5 - x) * grid.dx,
                               v      = (static_cast<double>(jy) + 0.5 - y) * grid.dy;
                  const double square = (u * u + v * v) / (radius * radius);
                  if (square >= 1.)
                    continue;
                  const auto at = static_cast<std::size_t>((jy + ny) % ny * nx + (jx + nx) % nx);
                  fresh += z[at] == 0.;
                  pixels.emplace_back(at, std::pow(square, 0.5 * exponent) - 1.);
                }
            // The last crater only if it brings the share nearer to the wanted one.
            if (covered + fresh > wanted && covered + fresh - wanted > wanted - covered)
              break;
            covered += fresh;
            for (const auto &[at, depth] : pixels)
              z[at] = std::min(z[at], depth);
          }
        return z;
      }

      double             diameter, plateau_fraction, exponent, fine_ratio;
      CorrelationLengths fine_lengths;
    };
  } // namespace

  TRIBODRAW_REGISTER(
      SurfaceTexture, CraterTexture, "craters",
      "Flat plateaus with overlapping round craters of a given diameter and a fine roughness, as on sheet rolled "
      "with electro-discharge textured rolls.",
      "Boolean model: Stoyan, Kendall, Mecke 1995, Stochastic geometry and its applications")
} // namespace tribodraw
