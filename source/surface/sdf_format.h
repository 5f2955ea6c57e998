#ifndef tribodraw_source_surface_sdf_format_h
#define tribodraw_source_surface_sdf_format_h

#include <optional>
#include <string_view>

#include "byte_view.h"

namespace tribodraw
{
  /// What the text and the binary form of SDF (ISO 25178-71 and its forerunner BCR) have in common.
  struct SdfDialect
  {
    bool bcr         = false; ///< forerunner: more types, highest value for missing points, rows from the top
    bool wide_counts = false; ///< version 2.0: counts of 32 bit in the binary form

    /// Nothing if the eight characters are no known mark; @p form is `a` (text) or `b` (binary).
    static std::optional<SdfDialect>
    recognise(std::string_view content, char form)
    {
      if (content.size() < 8 || content[0] != form)
        return {};
      const auto name = content.substr(1, 7);
      if (name == "ISO-1.0")
        return SdfDialect{ false, false };
      if (name == "ISO-2.0")
        return SdfDialect{ false, true };
      if (name == "BCR-1.0" || name == "BCR-0.0") // the latter is what Gwyddion writes
        return SdfDialect{ true, false };
      return {};
    }
  };

  struct SdfType
  {
    std::size_t   bytes;
    NumberDecoder decode;
    double        lowest, highest; ///< values of the type
    bool          is_float, is_unsigned;

    /// The mark of a point that was not measured: the lowest value in ISO files, the highest in BCR files, where
    /// programs write the lowest too. NaN is accepted.
    bool is_missing(double value, const SdfDialect &dialect) const;
  };

  /// The type of number @p code, or nothing. Unsigned ones exist in BCR files only. (Version 1.0 lists 5, 6 and 7 only;
  /// programs write 3 and 4 all the same, and the size of the file shows whether that is meant.)
  const SdfType *sdf_type(unsigned code, const SdfDialect &dialect);
} // namespace tribodraw

#endif
