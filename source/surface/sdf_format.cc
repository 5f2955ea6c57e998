#include "sdf_format.h"

#include <array>
#include <cmath>
#include <limits>

namespace tribodraw
{
  namespace
  {
    template <class T>
    SdfType
    make_type()
    {
      using Limits = std::numeric_limits<T>;
      return { sizeof(T),
               &decode_to_double<T>,
               static_cast<double>(Limits::lowest()),
               static_cast<double>(Limits::max()),
               std::is_floating_point_v<T>,
               std::is_unsigned_v<T> };
    }
  } // namespace

  bool
  SdfType::is_missing(double value, const SdfDialect &dialect) const
  {
    if (std::isnan(value))
      return true;
    // Files state the limits of floating point numbers with ten digits.
    const auto equals = [this, value](double limit) {
      return is_float ? std::abs(value - limit) <= 1e-9 * std::abs(limit) : value == limit;
    };
    if (dialect.bcr)
      return equals(highest) || (!is_unsigned && equals(lowest));
    return equals(lowest);
  }

  const SdfType *
  sdf_type(unsigned code, const SdfDialect &dialect)
  {
    static const std::array<SdfType, 8> types{ make_type<std::uint8_t>(),  make_type<std::uint16_t>(),
                                               make_type<std::uint32_t>(), make_type<float>(),
                                               make_type<std::int8_t>(),   make_type<std::int16_t>(),
                                               make_type<std::int32_t>(),  make_type<double>() };
    if (code >= types.size() || (types[code].is_unsigned && !dialect.bcr))
      return nullptr;
    return &types[code];
  }
} // namespace tribodraw
