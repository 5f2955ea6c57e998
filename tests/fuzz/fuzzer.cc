// libFuzzer entry of one parser: -DPARSER="name with _ for blanks" -DPARSERS=function that has it.
#include "fuzz/parsers.h"

#include <tribodraw/base/errors.h>
#include <tribodraw/base/log.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>

namespace
{
  const FuzzedParser &
  parser()
  {
    for (const auto &candidate : PARSERS())
      {
        std::string name = candidate.name;
        std::replace(name.begin(), name.end(), ' ', '_');
        if (name == PARSER)
          return candidate;
      }
    std::abort();
  }
} // namespace

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t *data, std::size_t size, std::size_t max_size);

/// Begins with the valid contents of the parser instead of with nothing.
extern "C" std::size_t
LLVMFuzzerCustomMutator(std::uint8_t *data, const std::size_t size, const std::size_t max_size, const unsigned seed)
{
  const auto &seeds = parser().seeds;
  if (size > 1)
    return LLVMFuzzerMutate(data, size, max_size);
  const std::string &content = seeds[seed % seeds.size()];
  const std::size_t  length  = std::min(content.size(), max_size);
  std::copy_n(content.begin(), length, data);
  return length;
}

extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  static const FuzzedParser &fuzzed = []() -> const FuzzedParser & {
    tribodraw::log::set_level(tribodraw::log::Level::quiet);
    return parser();
  }();
  try
    {
      fuzzed.read(std::string(reinterpret_cast<const char *>(data), size));
    }
  catch (const tribodraw::InputError &)
    {
    }
  return 0;
}
