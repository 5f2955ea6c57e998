#ifndef tribodraw_tests_fuzz_mutator_h
#define tribodraw_tests_fuzz_mutator_h

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>

/// Damages files in the ways that files get damaged, and in worse ones; the same for the same seed.
class Mutator
{
public:
  explicit Mutator(std::uint64_t seed) : engine(seed) {}

  std::size_t
  below(std::size_t n)
  {
    return n == 0 ? 0 : engine() % n;
  }

  std::string
  mutant(std::string text, bool is_text)
  {
    const std::size_t n_changes = 1 + below(3);
    for (std::size_t i = 0; i < n_changes; ++i)
      change(text, is_text && below(2) == 0 ? 8 + below(2) : below(8));
    return text;
  }

private:
  void
  change(std::string &text, std::size_t kind)
  {
    const std::size_t at = below(text.size()), length = 1 + below(16);
    switch (kind)
      {
      case 0: // one bit
        if (!text.empty())
          text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
        break;
      case 1: // one byte
        if (!text.empty())
          text[at] = static_cast<char>(below(256));
        break;
      case 2:
        text.erase(at, length);
        break;
      case 3:
        text.insert(at, text.substr(below(text.size()), length));
        break;
      case 4:
        text.resize(at);
        break;
      case 5:
        overwrite(text, at, extreme_number());
        break;
      case 6:
        swap_bytes(text, at);
        break;
      case 7: // a run of one byte: erased flash memory, holes of sparse files
        std::fill_n(text.begin() + at, std::min(text.size() - at, 4 * length), below(2) == 0 ? '\0' : '\xFF');
        break;
      case 8:
        replace_token(text, at);
        break;
      case 9: // a line is lost or doubled
        {
          const std::size_t begin = text.rfind('\n', at) + 1;
          const std::size_t end   = std::min(text.find('\n', begin), text.size());
          if (below(2) == 0)
            text.erase(begin, end - begin);
          else
            text.insert(begin, text.substr(begin, end - begin));
          break;
        }
      }
  }

  /// A number that headers do not expect, as bytes in little-endian order.
  std::string
  extreme_number()
  {
    switch (below(10))
      {
      case 0:
        return bytes_of<std::uint16_t>(0xFFFF);
      case 1:
        return bytes_of<std::uint32_t>(0x7FFFFFFF);
      case 2:
        return bytes_of<std::int32_t>(-1);
      case 3:
        return bytes_of<std::uint32_t>(0);
      case 4:
        return bytes_of(std::nan(""));
      case 5:
        return bytes_of(std::numeric_limits<double>::infinity());
      case 6:
        return bytes_of(-1e-6);
      case 7:
        return bytes_of(std::numeric_limits<float>::quiet_NaN());
      case 8:
        return bytes_of(-std::numeric_limits<float>::infinity());
      default:
        return bytes_of(1e-310);
      }
  }

  template <class Number>
  static std::string
  bytes_of(const Number value)
  {
    return std::string(reinterpret_cast<const char *>(&value), sizeof value);
  }

  static void
  overwrite(std::string &text, std::size_t at, const std::string &bytes)
  {
    for (std::size_t i = 0; i < bytes.size() && at + i < text.size(); ++i)
      text[at + i] = bytes[i];
  }

  /// Other byte order: of one number or of everything from here on.
  void
  swap_bytes(std::string &text, std::size_t at)
  {
    const std::size_t width = std::size_t(2) << below(3), n = below(2) == 0 ? 1 : text.size();
    for (std::size_t i = 0; i < n && at + (i + 1) * width <= text.size(); ++i)
      std::reverse(text.begin() + static_cast<std::ptrdiff_t>(at + i * width),
                   text.begin() + static_cast<std::ptrdiff_t>(at + (i + 1) * width));
  }

  void
  replace_token(std::string &text, std::size_t at)
  {
    static const char *const tokens[]
        = { "0",          "-1",     "nan",        "inf", "-inf", "1e999", "1e308", "1e-300", "99999999999999999999",
            "4294967296", "BAD",    "2147483647", "",    "1,5",  "V",     "x",     "m",      "=",
            "*",          "<Datum>" };
    const char *const blanks = " \t\r\n;,=<>";
    const std::size_t begin  = text.find_first_not_of(blanks, at);
    if (begin == std::string::npos)
      return;
    const std::size_t end = std::min(text.find_first_of(blanks, begin), text.size());
    text.replace(begin, end - begin, tokens[below(sizeof(tokens) / sizeof(tokens[0]))]);
  }

  std::mt19937_64 engine;
};

#endif
