#ifndef tribodraw_source_surface_number_bytes_h
#define tribodraw_source_surface_number_bytes_h

#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>

namespace tribodraw
{
  /// Append a number as it stands in files: little endian, whatever the byte order of this machine.
  template <class T>
  void
  append_number(std::string &content, T value)
  {
    using Bits
        = std::conditional_t<sizeof(T) == 8, std::uint64_t,
                             std::conditional_t<sizeof(T) == 4, std::uint32_t,
                                                std::conditional_t<sizeof(T) == 2, std::uint16_t, std::uint8_t>>>;
    static_assert(sizeof(Bits) == sizeof(T));
    Bits bits;
    std::memcpy(&bits, &value, sizeof(T));
    for (std::size_t i = 0; i < sizeof(T); ++i)
      content += static_cast<char>((static_cast<std::uint64_t>(bits) >> (8 * i)) & 0xFF);
  }

  /// Append the shortest decimal text that reads back to the same number.
  void append_text(std::string &content, double value);

  /// A description may quote anything; in headers it is one line.
  std::string one_line(std::string text);
} // namespace tribodraw

#endif
