#ifndef tribodraw_boundary_friction_contact_patches_h
#define tribodraw_boundary_friction_contact_patches_h

#include <tribodraw/surface/height_map.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tribodraw
{
  /// A contact patch between a tool summit and a sheet plateau as an elliptical paraboloid with the same area, second
  /// moments and volume.
  struct ContactPatch
  {
    std::size_t pixels   = 0;
    double      area     = 0;               ///< [mm^2]
    double      volume   = 0;               ///< of the tool summit below the plateau's plane [mm^3]
    double      centre_x = 0, centre_y = 0; ///< [mm]
    double      a = 0, b = 0;               ///< semi-axes, a >= b, pi a b = area [mm]
    double      psi = 0;                    ///< angle of the long axis to x [rad]
    double      w   = 0;                    ///< depth of the paraboloid, 2 volume / area [mm]
  };

  /// Indices of the pixels of a map from the highest to the lowest.
  std::vector<std::uint32_t> pixels_by_height(const HeightMap &map);

  /// The plateaus of a flattened sheet facing a rough tool: which pixels touch when the tool comes down, and the
  /// patches they form. The borders of the maps cut patches (no periodic continuation).
  class PlateauContact
  {
  public:
    /// Plateaus: sheet heights >= @p cut_height. @p tool has the same grid, heights towards the sheet.
    /// @param tool_order pixels_by_height(tool), made once for many cut heights.
    PlateauContact(const HeightMap &sheet, const HeightMap &tool, const std::vector<std::uint32_t> &tool_order,
                   double cut_height);

    std::size_t
    n_plateau_pixels() const
    {
      return pixel.size();
    }
    double
    pixel_area() const
    {
      return map.dx * map.dy;
    }
    double
    nominal_area() const
    {
      return pixel_area() * static_cast<double>(map.size());
    }
    /// Patches when the @p n_pixels highest tool pixels above plateaus touch (8 neighbours belong together). The level
    /// of the plateau is that of the next pixel to touch.
    std::vector<ContactPatch> patches(std::size_t n_pixels) const;

  private:
    const HeightMap           &map;   // of the tool
    std::vector<std::uint32_t> pixel; // plateau pixels in the order in which they touch
    std::vector<std::int32_t>  rank;  // of each map pixel in that order, -1 outside the plateaus
  };
} // namespace tribodraw

#endif
