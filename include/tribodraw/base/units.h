#ifndef tribodraw_base_units_h
#define tribodraw_base_units_h

#include <optional>
#include <string>

namespace tribodraw
{
  /// Quantities with units. Internally everything is in mm, N, MPa, s, K
  /// (mass in tonnes); a unit is a factor to these and four exponents.
  namespace units
  {
    /// Exponents of the base dimensions. Real numbers, because c0 of the
    /// boundary-layer law has the unit Pa^(1-m).
    struct Dimension
    {
      double length = 0, force = 0, time = 0, temperature = 0;

      bool operator==(const Dimension &other) const;
      bool operator!=(const Dimension &other) const { return !(*this == other); }
    };

    /// A unit: internal value = factor * number.
    struct Unit
    {
      double    factor = 1;
      Dimension dimension;
    };

    /// Read a unit such as `mm`, `mPa s`, `g/m^2`, `1/s`, `kN`, `Pa^0.25`, `deg`, `%`, `eV/K`.
    /// The empty text and `1` are dimensionless. Returns nothing if a symbol is unknown.
    std::optional<Unit> parse_unit(const std::string &text);

    /// Read `number unit` and return the value in internal units.
    /// @p expected_unit names the wanted dimension by an example unit (empty: dimensionless).
    /// Throws InputError with a sentence that names value, what is wrong and an example.
    double parse_quantity(const std::string &text, const std::string &expected_unit);

    /// Internal value of one @p unit (factor). Throws InputError on an unknown unit.
    double factor(const std::string &unit);

    /// Write an internal value in the given unit, shortest text that reads back exactly.
    std::string format(double internal_value, const std::string &unit);

    /// Shortest decimal text that reads back to the same double.
    std::string number(double value);
  } // namespace units
} // namespace tribodraw

#endif
