#ifndef tribodraw_source_surface_byte_view_h
#define tribodraw_source_surface_byte_view_h

#include <tribodraw/base/errors.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

namespace tribodraw
{
  /// A number as it stands in a file, whatever the byte order of this machine.
  template <class T, bool big_endian = false>
  T
  decode_number(const char *bytes)
  {
    using Bits
        = std::conditional_t<sizeof(T) == 8, std::uint64_t,
                             std::conditional_t<sizeof(T) == 4, std::uint32_t,
                                                std::conditional_t<sizeof(T) == 2, std::uint16_t, std::uint8_t>>>;
    static_assert(sizeof(Bits) == sizeof(T));
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i)
      bits |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[big_endian ? sizeof(T) - 1 - i : i]))
              << (8 * i);
    const Bits narrow = static_cast<Bits>(bits);
    T          value;
    std::memcpy(&value, &narrow, sizeof(T));
    return value;
  }

  /// One stored number as double.
  using NumberDecoder = double (*)(const char *);

  template <class T, bool big_endian = false>
  double
  decode_to_double(const char *bytes)
  {
    return static_cast<double>(decode_number<T, big_endian>(bytes));
  }

  /// The content of a binary file. Every access is checked, every message names format, file and byte.
  class ByteView
  {
  public:
    ByteView(std::string_view bytes, std::string format_name, std::string file_name)
        : content(bytes), format(std::move(format_name)), file(std::move(file_name))
    {
    }

    std::size_t
    size() const
    {
      return content.size();
    }

    /// Little-endian number at @p offset.
    template <class T>
    T
    number(std::size_t offset) const
    {
      return decode_number<T>(at(offset, sizeof(T)));
    }

    /// @p n bytes from @p offset on; they are there.
    const char *
    at(std::size_t offset, std::size_t n) const
    {
      if (offset > content.size() || n > content.size() - offset)
        fail("the file ends in the middle of its header (truncated?)", content.size(),
             std::to_string(content.size()) + " bytes", "more");
      return content.data() + offset;
    }

    /// Text of a fixed length: ends at the first zero byte (what follows may be left from before), without blanks at
    /// its ends.
    std::string
    text(std::size_t offset, std::size_t n) const
    {
      std::string_view all(at(offset, n), n);
      all              = all.substr(0, all.find('\0'));
      const auto first = all.find_first_not_of(" \t\r\n");
      return first == std::string_view::npos
                 ? std::string()
                 : std::string(all.substr(first, all.find_last_not_of(" \t\r\n") - first + 1));
    }

    /// The file must hold nx times ny numbers of @p bytes bytes from @p offset on. @p stride: bytes from row to row.
    /// Divisions only, because the products of hostile counts overflow.
    void
    check_counts(std::size_t nx, std::size_t ny, std::size_t stride, std::size_t offset) const
    {
      const std::size_t left = offset < size() ? size() - offset : 0;
      if (nx == 0 || ny == 0 || nx > left || stride > left || ny > left / stride)
        fail("the file is shorter than its header says (truncated, or counts in the wrong byte order?)", offset,
             std::to_string(left) + " bytes of data", std::to_string(nx) + " x " + std::to_string(ny) + " points");
    }

    [[noreturn]] void
    fail(const std::string &what, std::size_t offset, const std::string &value = "", const std::string &allowed = "",
         const std::string &hint = "") const
    {
      throw InputError(
          describe_error(format + ": " + what + ".", file + ", byte " + std::to_string(offset), value, allowed, hint));
    }

    std::string_view
    bytes() const
    {
      return content;
    }

  private:
    std::string_view content;
    std::string      format, file;
  };
} // namespace tribodraw

#endif
