#include <tribodraw/base/errors.h>
#include <tribodraw/flattening/deformed_surface.h>
#include <tribodraw/flattening/height_distribution.h>

#include <algorithm>

namespace tribodraw
{
  HeightMap
  sum_of_heights(const HeightMap &sheet, const HeightMap &tool)
  {
    HeightMap sum = sheet;
    if (tool.size() == 0)
      return sum;
    if (tool.nx != sheet.nx || tool.ny != sheet.ny || tool.z.size() != sheet.z.size())
      throw InputError(describe_error("Sheet and tool heights are on different grids", "flattening",
                                      std::to_string(sheet.nx) + " x " + std::to_string(sheet.ny) + " and "
                                          + std::to_string(tool.nx) + " x " + std::to_string(tool.ny) + " pixels"));
    for (std::size_t i = 0; i < sum.z.size(); ++i)
      sum.z[i] += tool.z[i];
    sum.periodic = sheet.periodic && tool.periodic;
    return sum;
  }

  HeightMap
  deformed_sheet(const HeightMap &sheet, const HeightMap &tool, const double s)
  {
    const HeightMap          sum = sum_of_heights(sheet, tool);
    const HeightDistribution heights(sum);
    const double             mean = heights.mean(), u = heights.uniform_rise(s);
    HeightMap                result = sheet;
    for (std::size_t i = 0; i < result.z.size(); ++i)
      {
        const double t = tool.size() > 0 ? tool.z[i] : 0.;
        result.z[i]    = sum.z[i] - mean >= s ? s + u - t : sheet.z[i] - mean + u;
      }
    return result;
  }

  HeightMap
  deformed_gap(const HeightMap &sheet, const HeightMap &tool, const double s)
  {
    HeightMap    gap  = sum_of_heights(sheet, tool);
    const double mean = HeightDistribution(gap).mean();
    for (double &z : gap.z)
      z = std::max(0., s - (z - mean));
    return gap;
  }
} // namespace tribodraw
