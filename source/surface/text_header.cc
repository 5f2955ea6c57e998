#include "text_header.h"

#include <tribodraw/base/errors.h>
#include <tribodraw/base/units.h>
#include <tribodraw/surface/surface_reader.h>

#include <cctype>
#include <map>

#include "text_tools.h"

namespace tribodraw
{
  namespace
  {
    enum class Key
    {
      width,
      height,
      x_length,
      y_length,
      x_unit,
      y_unit,
      xy_unit,
      value_unit,
      metres_per_value,
      columns,
      rows,
      pixel_size
    };

    const std::map<std::string, Key, std::less<>> &
    known_keys()
    {
      static const std::map<std::string, Key, std::less<>> keys{
        { "width", Key::width },
        { "breite", Key::width },
        { "height", Key::height },
        { "h\xC3\xB6he", Key::height }, // UTF-8
        { "h\xF6he", Key::height },     // Latin-1
        { "x-length", Key::x_length },
        { "y-length", Key::y_length },
        { "x-unit", Key::x_unit },
        { "y-unit", Key::y_unit },
        { "xy units", Key::xy_unit },
        { "value units", Key::value_unit },
        { "z-unit", Key::value_unit },
        { "height conversion factor (-> m)", Key::metres_per_value },
        { "x-pixels", Key::columns },
        { "columns", Key::columns },
        { "w", Key::columns },
        { "y-pixels", Key::rows },
        { "rows", Key::rows },
        { "h", Key::rows },
        { "pixel size", Key::pixel_size },
      };
      return keys;
    }

    struct Statement
    {
      std::string      key;
      std::string_view value;
    };

    std::optional<Statement>
    split(std::string_view text)
    {
      const auto sign = text.find_first_of("=:");
      if (sign == std::string_view::npos || sign > 64)
        return {};
      return Statement{ lower(trimmed(text.substr(0, sign))), trimmed(text.substr(sign + 1)) };
    }

    std::string_view
    without_comment_sign(std::string_view line)
    {
      line = trimmed(line);
      while (!line.empty() && line.front() == '#')
        line.remove_prefix(1);
      return trimmed(line);
    }

    /// `h=650 w=650` is several statements, `pixel size=3 um` is one.
    bool
    holds_several(std::string_view text)
    {
      Fields           fields(text, {});
      std::string_view field;
      std::size_t      n = 0;
      while (fields.next(field) && ++n < 8)
        if (field.find('=') == std::string_view::npos || field.front() == '=' || field.back() == '=')
          return false;
      return n > 1;
    }

    /// The first known key of a line, if it has one.
    std::optional<Key>
    first_key(std::string_view line)
    {
      auto text = without_comment_sign(line.substr(0, 256));
      if (holds_several(text))
        text = text.substr(0, text.find_first_of(" \t"));
      const auto statement = split(text);
      if (!statement)
        return {};
      const auto found = known_keys().find(statement->key);
      return found == known_keys().end() ? std::nullopt : std::optional<Key>(found->second);
    }

    double
    read_unit(std::string_view text, const std::string &where)
    {
      const auto unit = length_unit(std::string(text.substr(0, 40)));
      if (!unit)
        throw InputError(describe_error("the header of the text file states something that is not a unit of length.",
                                        where, "`" + excerpt(text) + "`", "m, mm, um, nm"));
      return *unit;
    }

    template <class Value>
    void
    set_once(std::optional<Value> &entry, const Value &value, const std::string &where)
    {
      if (entry)
        throw InputError(describe_error("the header of the text file states a scale for the second time.", where));
      entry = value;
    }
  } // namespace

  bool
  TextHeader::states_known_key(std::string_view line)
  {
    return first_key(line).has_value();
  }

  bool
  TextHeader::states_size_of_matrix(std::string_view line)
  {
    const auto key = first_key(line);
    return key && *key != Key::xy_unit && *key != Key::x_unit && *key != Key::y_unit && *key != Key::value_unit
           && *key != Key::metres_per_value;
  }

  void
  TextHeader::read(std::string_view line, const std::string &where)
  {
    const auto text = without_comment_sign(line);
    if (holds_several(text))
      {
        Fields           fields(text, {});
        std::string_view field;
        while (fields.next(field))
          if (const auto statement = split(field))
            set(statement->key, statement->value, where);
      }
    else if (const auto statement = split(text))
      set(statement->key, statement->value, where);
  }

  void
  TextHeader::set(std::string key, std::string_view value, const std::string &where)
  {
    const auto found = known_keys().find(key);
    if (found == known_keys().end())
      return;
    const auto count = [&](std::optional<std::size_t> &entry) {
      const auto n = parse_count(value);
      if (!n || *n == 0)
        throw InputError(describe_error("the header of the text file states a number of points that is none.", where,
                                        "`" + excerpt(value) + "`", "a positive integer"));
      set_once(entry, *n, where);
    };
    switch (found->second)
      {
      case Key::width:
        return set_length(lengths[0], value, where, true);
      case Key::height:
        return set_length(lengths[1], value, where, true);
      case Key::x_length:
        return set_length(lengths[0], value, where, false);
      case Key::y_length:
        return set_length(lengths[1], value, where, false);
      case Key::pixel_size:
        return set_length(pixel, value, where, true);
      case Key::x_unit:
        return set_once(axis_units[0], read_unit(value, where), where);
      case Key::y_unit:
        return set_once(axis_units[1], read_unit(value, where), where);
      case Key::xy_unit:
        set_once(axis_units[0], read_unit(value, where), where);
        return set_once(axis_units[1], read_unit(value, where), where);
      case Key::value_unit:
        return set_once(value_unit, read_unit(value, where), where);
      case Key::metres_per_value:
        {
          const auto factor = parse_finite(value);
          if (!factor || *factor <= 0.)
            throw InputError(describe_error("the height conversion factor is not a positive number.", where,
                                            "`" + excerpt(value) + "`"));
          return set_once(value_unit, *factor * units::factor("m"), where);
        }
      case Key::columns:
        return count(counts[0]);
      case Key::rows:
        return count(counts[1]);
      }
  }

  void
  TextHeader::set_length(std::optional<Length> &entry, std::string_view value, const std::string &where,
                         bool needs_unit)
  {
    const auto            blank  = value.find_first_of(" \t");
    const auto            number = parse_finite(value.substr(0, blank));
    std::optional<double> unit;
    if (blank != std::string_view::npos)
      unit = length_unit(std::string(value.substr(blank).substr(0, 40)));
    if (!number || *number <= 0. || (!unit && (needs_unit || blank != std::string_view::npos)))
      throw InputError(describe_error("the size of the map is not a positive length with unit.", where,
                                      "`" + excerpt(value) + "`", "such as `2 mm`"));
    set_once(entry, Length{ *number, unit }, where);
  }

  std::optional<std::array<double, 2>>
  TextHeader::pixel_size(std::size_t nx, std::size_t ny, const std::string &file) const
  {
    const std::array<std::size_t, 2> n{ nx, ny };
    std::array<double, 2>            size{};
    bool                             complete = true;
    for (int axis = 0; axis < 2; ++axis)
      {
        if (counts[axis] && *counts[axis] != n[axis])
          throw InputError(describe_error("the text file holds another number of "
                                              + std::string(axis == 0 ? "columns" : "rows")
                                              + " than its header says (truncated file?).",
                                          file, std::to_string(n[axis]), std::to_string(*counts[axis])));
        const auto unit = lengths[axis] && lengths[axis]->unit ? lengths[axis]->unit : axis_units[axis];
        if (lengths[axis] && unit)
          size[axis] = lengths[axis]->value * *unit / static_cast<double>(n[axis]);
        else
          complete = false;
      }
    if (pixel && (lengths[0] || lengths[1]))
      throw InputError(describe_error("the header of the text file states both pixel size and size of the map.", file));
    if (pixel)
      return std::array<double, 2>{ pixel->value * *pixel->unit, pixel->value * *pixel->unit };
    if (complete)
      return size;
    return {};
  }

  std::optional<double>
  TextHeader::height_unit() const
  {
    return value_unit;
  }

  std::optional<std::array<double, 2>>
  TextHeader::coordinate_units() const
  {
    if (!axis_units[0] || !axis_units[1])
      return {};
    return std::array<double, 2>{ *axis_units[0], *axis_units[1] };
  }

  bool
  TextHeader::read_point_titles(std::string_view line, const std::string &where)
  {
    Fields           fields(line, separation_of(line));
    std::string_view field;
    std::size_t      n = 0;
    for (; fields.next(field); ++n)
      {
        while (!field.empty() && field.front() == '"')
          field.remove_prefix(1);
        if (n >= 3 || field.empty() || std::tolower(static_cast<unsigned char>(field.front())) != "xyz"[n])
          return false;
        const auto open = field.find_first_of("[("), close = field.find_first_of("])");
        if (open == std::string_view::npos || close == std::string_view::npos || close < open)
          continue;
        const double unit = read_unit(field.substr(open + 1, close - open - 1), where);
        set_once(n < 2 ? axis_units[n] : value_unit, unit, where);
      }
    return n == 3;
  }
} // namespace tribodraw
