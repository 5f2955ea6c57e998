#ifndef tribodraw_source_surface_x3p_document_h
#define tribodraw_source_surface_x3p_document_h

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "byte_view.h"
#include "zip_archive.h"

namespace tribodraw
{
  /// What `main.xml` of an X3P archive says.
  struct X3pDocument
  {
    struct Axis
    {
      bool          absolute  = false;         ///< coordinates are stored with the points
      double        increment = 1, offset = 0; ///< [m]
      std::size_t   bytes  = 0;                ///< of a stored number
      NumberDecoder decode = nullptr;
    };

    std::array<Axis, 3> axes;
    std::size_t         nx = 0, ny = 0, layers = 0;
    bool                is_inline = false;                ///< heights stand in main.xml
    std::string         data, data_md5, valid, valid_md5; ///< names of entries and their digests
    std::string         remark;
    bool                rotated = false;

    /// Bytes of a point in the binary form.
    std::size_t point_bytes() const;
  };

  /// @param text main.xml with an empty list of data.
  X3pDocument read_x3p_document(const std::string &text, const ZipArchive &archive);
} // namespace tribodraw

#endif
