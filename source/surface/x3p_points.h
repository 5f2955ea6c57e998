#ifndef tribodraw_source_surface_x3p_points_h
#define tribodraw_source_surface_x3p_points_h

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "x3p_document.h"
#include "zip_archive.h"

namespace tribodraw
{
  /// Everything that the heights of an X3P file are read from.
  struct X3pSource
  {
    X3pSource(std::string_view content, const std::string &file) : archive(content, file) {}

    ZipArchive                       archive;
    std::string                      main; ///< text of main.xml
    std::string_view                 list; ///< the inline heights in it
    X3pDocument                      document;
    std::optional<ZipArchive::Entry> data, valid;
    /// Positions on axes that are stored with the points, from the corners of the map, in stored units.
    std::array<double, 2> first{}, step{};
  };

  /// Numbers of the absolute axes of a point as they are stored; the height is NaN if it was not measured.
  using X3pPoint = std::array<double, 3>;

  /// Goes through all points of the first layer in the order of the file. Throws InputError on malformed data, wrong
  /// checksums, and another number of points than the matrix has.
  void for_each_x3p_point(const X3pSource &source, const std::function<void(std::size_t i, const X3pPoint &)> &use);

  /// Where a point stands, for messages.
  std::string name_of_x3p_point(const X3pSource &source, std::size_t i);

  /// Throws InputError if the stated digest is one and differs.
  void check_md5(const ZipArchive &archive, const std::string &entry, const std::string &found,
                 const std::string &stated);
} // namespace tribodraw

#endif
