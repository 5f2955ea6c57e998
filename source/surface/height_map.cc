#include <tribodraw/base/files.h>
#include <tribodraw/surface/height_map.h>

#include <array>
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
} // namespace tribodraw
