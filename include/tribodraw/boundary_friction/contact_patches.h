#ifndef tribodraw_boundary_friction_contact_patches_h
#define tribodraw_boundary_friction_contact_patches_h

#include <tribodraw/boundary_friction/tool_surface.h>
#include <tribodraw/surface/height_map.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tribodraw
{
  /// A contact patch between a tool summit and a sheet plateau as an elliptical paraboloid with the same area and
  /// second moments.
  struct ContactPatch
  {
    std::size_t pixels   = 0;
    double      area     = 0;               ///< [mm^2]
    double      volume   = 0;               ///< of the tool summit below the plateau's plane [mm^3]
    double      slope    = 0;               ///< root mean square slope of the tool in the patch
    double      centre_x = 0, centre_y = 0; ///< [mm]
    double      a = 0, b = 0;               ///< semi-axes, a >= b, pi a b = area [mm]
    double      psi = 0;                    ///< angle of the long axis to x [rad]

    /// Depth of the paraboloid with the patch's volume: 2 volume / area [mm].
    double depth_of_volume() const;
    /// Depth of the paraboloid with the patch's mean square slope, w^2 (1/a^2 + 1/b^2) = slope^2 [mm].
    double depth_of_slope() const;
  };

  /// The plateaus of a flattened sheet facing a rough tool: which pixels touch when the tool comes down, and the
  /// patches they form. If both maps are periodic, patches continue across the borders, otherwise borders cut them.
  class PlateauContact
  {
  public:
    /// Plateaus: sheet heights >= @p cut_height. The tool has the same grid, heights towards the sheet.
    PlateauContact(const HeightMap &sheet, const ToolSurface &tool, double cut_height);

    const ToolSurface &
    tool() const
    {
      return surface;
    }
    std::size_t
    n_plateau_pixels() const
    {
      return pixel.size();
    }
    /// Plateau pixels in the order in which they touch.
    const std::vector<std::uint32_t> &
    pixels() const
    {
      return pixel;
    }
    double
    pixel_area() const
    {
      return surface.map.dx * surface.map.dy;
    }
    double
    nominal_area() const
    {
      return pixel_area() * static_cast<double>(surface.map.size());
    }
    /// Patches when the @p n_pixels highest tool pixels above plateaus touch (8 neighbours belong together). The level
    /// of the plateau is that of the next pixel to touch. Where a patch ends at the edge of its plateau and not on the
    /// flank of the tool, its volume counts from a base raised in proportion.
    std::vector<ContactPatch> patches(std::size_t n_pixels) const;

  private:
    const ToolSurface         &surface;
    bool                       periodic;
    std::vector<std::uint32_t> pixel;
    std::vector<std::int32_t>  rank; // of each map pixel in that order, -1 outside the plateaus

    std::vector<std::int32_t> label(std::int32_t n_pixels) const;
  };
} // namespace tribodraw

#endif
