#include "text_tools.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>

namespace tribodraw
{
  std::string_view
  trimmed(std::string_view text)
  {
    const char *blanks = " \t\r";
    const auto  first  = text.find_first_not_of(blanks);
    return first == std::string_view::npos ? std::string_view()
                                           : text.substr(first, text.find_last_not_of(blanks) - first + 1);
  }

  std::string
  lower(std::string_view text)
  {
    std::string result(text);
    std::transform(result.begin(), result.end(), result.begin(), [](unsigned char c) { return std::tolower(c); });
    return result;
  }

  std::string_view
  without_byte_order_mark(std::string_view content)
  {
    return content.substr(0, 3) == "\xEF\xBB\xBF" ? content.substr(3) : content;
  }

  std::string
  excerpt(std::string_view text, std::size_t length)
  {
    std::string result(text.substr(0, length));
    for (char &c : result)
      if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F)
        c = ' ';
    return text.size() > length ? result + "..." : result;
  }

  bool
  is_missing_mark(std::string_view field)
  {
    if (field.empty())
      return true;
    if (field.size() != 3)
      return false;
    const std::string text = lower(field);
    return text == "bad" || text == "nan" || text == "***" || text == "---";
  }

  std::optional<double>
  parse_finite(std::string_view field, bool decimal_comma)
  {
    if (!field.empty() && field.front() == '+')
      field.remove_prefix(1);
    std::array<char, 64> copy;
    if (decimal_comma)
      if (const auto comma = field.find(','); comma != std::string_view::npos)
        {
          if (field.size() > copy.size() || field.find('.') != std::string_view::npos)
            return {};
          std::copy(field.begin(), field.end(), copy.begin());
          copy[comma] = '.';
          field       = std::string_view(copy.data(), field.size());
        }
    double value            = 0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc() || end != field.data() + field.size() || !std::isfinite(value))
      return {};
    return value;
  }

  std::optional<double>
  parse_height(std::string_view field, bool decimal_comma)
  {
    if (is_missing_mark(field))
      return std::numeric_limits<double>::quiet_NaN();
    return parse_finite(field, decimal_comma);
  }

  std::optional<std::size_t>
  parse_count(std::string_view field)
  {
    std::size_t value       = 0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc() || end != field.data() + field.size())
      return {};
    return value;
  }

  bool
  Lines::next(std::string_view &line)
  {
    if (rest.empty())
      return false;
    const auto end = rest.find('\n');
    ended          = end != std::string_view::npos;
    line           = rest.substr(0, end);
    rest           = ended ? rest.substr(end + 1) : std::string_view();
    if (!line.empty() && line.back() == '\r')
      line.remove_suffix(1);
    ++count;
    return true;
  }

  Separation
  separation_of(std::string_view line)
  {
    line             = trimmed(line);
    const bool comma = line.find(',') != std::string_view::npos;
    for (const char candidate : { ';', '\t' })
      if (line.find(candidate) != std::string_view::npos)
        return { candidate, comma };
    return { comma ? ',' : '\0', false };
  }

  Fields::Fields(std::string_view line, const Separation &separation)
      : rest(trimmed(line)), separator(separation.separator), more(!rest.empty())
  {
    // One separator may end the line.
    if (separator && more && rest.back() == separator)
      rest.remove_suffix(1);
  }

  bool
  Fields::next(std::string_view &field)
  {
    if (!more)
      return false;
    const auto end = separator ? rest.find(separator) : rest.find_first_of(" \t");
    field          = trimmed(rest.substr(0, end));
    more           = end != std::string_view::npos;
    if (more)
      rest = separator ? rest.substr(end + 1) : trimmed(rest.substr(end + 1));
    return true;
  }
} // namespace tribodraw
