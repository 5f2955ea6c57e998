#ifndef tribodraw_surface_material_ratio_h
#define tribodraw_surface_material_ratio_h

#include <tribodraw/surface/height_map.h>

#include <vector>

namespace tribodraw
{
  /// Parameters of the material ratio (Abbott) curve, ISO 25178-2. Heights in mm, ratios from 0 to 1, volumes per area
  /// in mm.
  struct FunctionalParameters
  {
    double sk = 0, spk = 0, svk = 0; ///< core, reduced peak and reduced valley height
    double smr1 = 0, smr2 = 0;       ///< material ratios of the borders of the core
    double vmp = 0, vmc = 0;         ///< material volume of peaks (to 10 %) and core (10 % to 80 %)
    double vvc = 0, vvv = 0;         ///< void volume of core (10 % to 80 %) and valleys (from 80 %)
  };

  /// Areal material ratio curve of a map: all heights, sorted from the highest; each point stands for the same share of
  /// the area, at whose centre the curve passes through its height.
  class MaterialRatioCurve
  {
  public:
    /// Throws InputError if the map is empty. Heights count from the mean.
    explicit MaterialRatioCurve(const HeightMap &map);

    /// Height that the share @p ratio of the area exceeds (linear between points).
    double height(double ratio) const;
    /// Smr(c): share of the area above the height @p c.
    double ratio(double c) const;
    /// Vm(p): material above the height of @p ratio, per area.
    double material_volume(double ratio) const;
    /// Vv(p): void below the height of @p ratio, per area.
    double void_volume(double ratio) const;

    /// The equivalent straight line runs through the 40 % of the area over which the secant has the smallest slope (the
    /// first of several), as the least-squares line of this part; its ends at 0 and 100 % bound the core. Spk and Svk
    /// are the heights of triangles with the areas of the peaks above and the valleys below the core.
    FunctionalParameters functional_parameters() const;

  private:
    /// Integral of the curve from 0 to @p ratio.
    double integral(double ratio) const;

    std::vector<double> sorted; ///< from the highest
    std::vector<double> up_to;  ///< sums of the first 0, step, 2 step, ... heights
    std::size_t         step = 1;
  };
} // namespace tribodraw

#endif
