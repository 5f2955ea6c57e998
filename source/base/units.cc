#include <tribodraw/base/errors.h>
#include <tribodraw/base/units.h>

#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <map>
#include <vector>

namespace tribodraw::units
{
  namespace
  {
    constexpr double pi = 3.14159265358979323846;
    /// Elementary charge [C]: 1 eV in joule (SI 2019, exact).
    constexpr double electron_volt = 1.602176634e-19;

    struct Symbol
    {
      Unit unit;
      bool takes_prefix;
    };

    // Internal base: mm, N, s, K. Mass is N s^2 / mm (tonne).
    const std::map<std::string, Symbol> &symbols()
    {
      static const std::map<std::string, Symbol> table = {
        {"m", {{1e3, {1, 0, 0, 0}}, true}},
        {"g", {{1e-6, {-1, 1, 2, 0}}, true}},
        {"t", {{1., {-1, 1, 2, 0}}, false}},
        {"N", {{1., {0, 1, 0, 0}}, true}},
        {"Pa", {{1e-6, {-2, 1, 0, 0}}, true}},
        {"bar", {{0.1, {-2, 1, 0, 0}}, true}},
        {"J", {{1e3, {1, 1, 0, 0}}, true}},
        {"W", {{1e3, {1, 1, -1, 0}}, true}},
        {"eV", {{electron_volt * 1e3, {1, 1, 0, 0}}, true}},
        {"s", {{1., {0, 0, 1, 0}}, true}},
        {"min", {{60., {0, 0, 1, 0}}, false}},
        {"h", {{3600., {0, 0, 1, 0}}, false}},
        {"K", {{1., {0, 0, 0, 1}}, false}},
        {"in", {{25.4, {1, 0, 0, 0}}, false}},
        {"rad", {{1., {}}, false}},
        {"deg", {{pi / 180., {}}, false}},
        {"%", {{0.01, {}}, false}},
        {"1", {{1., {}}, false}},
      };
      return table;
    }

    const std::map<std::string, double> &prefixes()
    {
      static const std::map<std::string, double> table = {
        {"G", 1e9}, {"M", 1e6}, {"k", 1e3}, {"c", 1e-2}, {"d", 1e-1}, {"m", 1e-3}, {"u", 1e-6}, {"µ", 1e-6}, {"n", 1e-9}, {"p", 1e-12}};
      return table;
    }

    std::optional<Unit> symbol(const std::string &name)
    {
      const auto exact = symbols().find(name);
      if (exact != symbols().end())
        return exact->second.unit;
      for (const auto &[prefix, value] : prefixes())
        if (name.size() > prefix.size() && name.compare(0, prefix.size(), prefix) == 0)
          {
            const auto base = symbols().find(name.substr(prefix.size()));
            if (base != symbols().end() && base->second.takes_prefix)
              return Unit{value * base->second.unit.factor, base->second.unit.dimension};
          }
      return {};
    }

    Unit power(const Unit &unit, const double exponent)
    {
      const auto &d = unit.dimension;
      return {exponent == 1. ? unit.factor : std::pow(unit.factor, exponent),
              {d.length * exponent, d.force * exponent, d.time * exponent, d.temperature * exponent}};
    }

    Unit product(const Unit &a, const Unit &b)
    {
      return {a.factor * b.factor,
              {a.dimension.length + b.dimension.length,
               a.dimension.force + b.dimension.force,
               a.dimension.time + b.dimension.time,
               a.dimension.temperature + b.dimension.temperature}};
    }

    std::string trim(const std::string &text)
    {
      const auto first = text.find_first_not_of(" \t\r\n");
      if (first == std::string::npos)
        return {};
      return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
    }
  } // namespace

  bool
  Dimension::operator==(const Dimension &other) const
  {
    // Exponents such as 0.25 come from decimal text and are compared with a tolerance.
    const auto same = [](const double a, const double b) { return std::abs(a - b) < 1e-9; };
    return same(length, other.length) && same(force, other.force) && same(time, other.time) &&
           same(temperature, other.temperature);
  }

  std::optional<Unit>
  parse_unit(const std::string &text)
  {
    // factors separated by blank, `*` or `.`-free; after `/` the factor is divided by
    Unit        result;
    std::size_t i      = 0;
    bool        divide = false;
    while (i < text.size())
      {
        const char c = text[i];
        if (std::isspace(static_cast<unsigned char>(c)) || c == '*')
          ++i;
        else if (c == '/')
          {
            if (divide)
              return {};
            divide = true;
            ++i;
          }
        else
          {
            std::size_t end = i;
            while (end < text.size() && !std::isspace(static_cast<unsigned char>(text[end])) && text[end] != '/' &&
                   text[end] != '*' && text[end] != '^')
              ++end;
            const auto unit = symbol(text.substr(i, end - i));
            if (!unit)
              return {};
            double exponent = 1;
            if (end < text.size() && text[end] == '^')
              {
                char *after = nullptr;
                exponent    = std::strtod(text.c_str() + end + 1, &after);
                if (after == text.c_str() + end + 1 || !std::isfinite(exponent) || std::abs(exponent) > 20)
                  return {};
                end = static_cast<std::size_t>(after - text.c_str());
              }
            result = product(result, power(*unit, divide ? -exponent : exponent));
            divide = false;
            i      = end;
          }
      }
    if (divide)
      return {};
    return result;
  }

  double
  factor(const std::string &unit)
  {
    const auto parsed = parse_unit(unit);
    if (!parsed)
      throw InputError("Unknown unit '" + unit + "'.");
    return parsed->factor;
  }

  double
  parse_quantity(const std::string &raw, const std::string &expected_unit)
  {
    const std::string text     = trim(raw);
    const auto        expected = parse_unit(expected_unit);
    if (!expected)
      throw std::logic_error("A parameter is declared with the unknown unit '" + expected_unit + "'.");
    const bool        dimensionless = expected->dimension == Dimension{};
    const std::string example       = dimensionless ? "a plain number such as `0.5`" : "a number with a unit such as `1 " + expected_unit + "`";
    if (text.empty())
      throw InputError("the value is empty; expected " + example + ".");
    char        *after = nullptr;
    const double value = std::strtod(text.c_str(), &after);
    if (after == text.c_str())
      throw InputError("'" + text + "' does not start with a number; expected " + example + ".");
    if (!std::isfinite(value))
      throw InputError("'" + text + "' is not a finite number.");
    const std::string unit_text = trim(after);
    if (unit_text.empty())
      {
        if (!dimensionless)
          throw InputError("'" + text + "' has no unit; expected " + example + ".");
        return value;
      }
    const auto unit = parse_unit(unit_text);
    if (!unit)
      throw InputError("unknown unit '" + unit_text + "' in '" + text + "'; expected " + example + ".");
    if (unit->dimension != expected->dimension)
      throw InputError("'" + text + "' has a unit of the wrong kind; expected " + example + ".");
    return value * unit->factor;
  }

  std::string
  number(const double value)
  {
    char       buffer[64];
    const auto end = std::to_chars(buffer, buffer + sizeof(buffer), value);
    return std::string(buffer, end.ptr);
  }

  std::string
  format(const double internal_value, const std::string &unit)
  {
    // 15 digits hide the rounding of the conversion (0.82 mm stays 0.82 mm)
    const double converted = internal_value / factor(unit);
    char         buffer[64];
    std::snprintf(buffer, sizeof(buffer), "%.12g", converted);
    return unit.empty() ? std::string(buffer) : std::string(buffer) + " " + unit;
  }
} // namespace tribodraw::units
