#include <tribodraw/base/files.h>
#include <tribodraw/surface/height_map.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace tribodraw
{
  std::string
  HeightMap::hash() const
  {
    std::array<char, 2 * sizeof(std::uint64_t) + 2 * sizeof(double)> sizes;
    const std::array<std::uint64_t, 2>                               counts{ nx, ny };
    const std::array<double, 2>                                      steps{ dx, dy };
    std::memcpy(sizes.data(), counts.data(), sizeof(counts));
    std::memcpy(sizes.data() + sizeof(counts), steps.data(), sizeof(steps));
    return hash_text(hash_bytes(sizes.data(), sizes.size()) + hash_bytes(z.data(), z.size() * sizeof(double)));
  }

  std::size_t
  n_missing(const HeightMap &map)
  {
    return static_cast<std::size_t>(
        std::count_if(map.z.begin(), map.z.end(), [](const double z) { return std::isnan(z); }));
  }
} // namespace tribodraw
