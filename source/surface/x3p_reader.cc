#include <tribodraw/base/errors.h>
#include <tribodraw/base/registry.h>
#include <tribodraw/base/units.h>
#include <tribodraw/surface/surface_reader.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "text_tools.h"
#include "x3p_points.h"

namespace tribodraw
{
  namespace
  {
    // Heights in the description itself take some 40 bytes each; larger maps are stored in binary form. The rest of the
    // description is a few kilobytes, and its tree in memory sixteen times as long as the text at most.
    constexpr std::size_t longest_main = 32u << 20, longest_description = 1u << 20;

    constexpr const char *main_xml = "main.xml";

    /// main.xml against the file that holds its checksum.
    void
    check_main(const X3pSource &source)
    {
      const auto entry = source.archive.find("md5checksum.hex");
      if (!entry || entry->bytes > 4096)
        return;
      Md5 md5;
      md5.add(source.main.data(), source.main.size());
      check_md5(source.archive, main_xml, md5.digest(),
                lower(std::string(trimmed(source.archive.read(*entry, 4096))).substr(0, 32)));
    }

    /// Takes the list of inline heights out of the description, because a tree of it would take too much memory.
    std::string
    cut_out_list(X3pSource &source)
    {
      const std::string_view all(source.main);
      for (const std::string_view prefix : { "", "p:" })
        {
          const std::string open = "<" + std::string(prefix) + "DataList>",
                            end  = "</" + std::string(prefix) + "DataList>";
          const auto begin = all.find(open), stop = all.rfind(end);
          if (begin != std::string_view::npos && stop != std::string_view::npos && stop > begin)
            {
              source.list = all.substr(begin + open.size(), stop - begin - open.size());
              return std::string(all.substr(0, begin + open.size())) + std::string(all.substr(stop));
            }
        }
      return source.main.size() <= longest_description ? source.main : std::string();
    }

    /// Where axes store a position for each point: the corners tell the step, and all points are checked later.
    void
    find_steps(X3pSource &source)
    {
      const auto &document = source.document;
      if (!document.axes[0].absolute && !document.axes[1].absolute)
        return;
      const std::array<std::size_t, 2> last{ document.nx - 1, (document.ny - 1) * document.nx };
      std::array<double, 2>            end{};
      for_each_x3p_point(source, [&](std::size_t i, const X3pPoint &point) {
        for (int axis = 0; axis < 2; ++axis)
          {
            if (i == 0)
              source.first[axis] = point[axis];
            if (i == last[axis])
              end[axis] = point[axis];
          }
      });
      for (int axis = 0; axis < 2; ++axis)
        if (document.axes[axis].absolute)
          {
            const std::size_t n = axis == 0 ? document.nx : document.ny;
            source.step[axis]   = (end[axis] - source.first[axis]) / static_cast<double>(n - 1);
            if (!std::isfinite(source.step[axis]) || source.step[axis] == 0.)
              source.archive.fail("the positions at the corners of the map are missing or equal",
                                  name_of_x3p_point(source, last[axis]), units::number(end[axis]));
          }
    }

    void
    check_position(const X3pSource &source, std::size_t i, const X3pPoint &point)
    {
      const std::array<std::size_t, 2> index{ i % source.document.nx, i / source.document.nx };
      for (int axis = 0; axis < 2; ++axis)
        if (source.document.axes[axis].absolute && !std::isnan(point[2]))
          {
            const double off
                = (point[axis] - source.first[axis]) / source.step[axis] - static_cast<double>(index[axis]);
            if (!(std::abs(off) <= 0.01))
              source.archive.fail("the points do not lie on a regular grid", name_of_x3p_point(source, i),
                                  units::number(off) + " pixels off", "0.01",
                                  "Interpolate them on a regular grid first.");
          }
    }

    void
    find_data(X3pSource &source)
    {
      const auto       &document = source.document;
      const std::size_t n        = document.nx * document.ny; // 31 bits each: no overflow
      if (document.is_inline)
        {
          if (n > source.list.size() / 8) // `<Datum/>`
            source.archive.fail("the list of points is shorter than the matrix", main_xml,
                                std::to_string(source.list.size()) + " bytes",
                                std::to_string(document.nx) + " x " + std::to_string(document.ny) + " points");
          return;
        }
      source.data = source.archive.find(document.data);
      if (!source.data)
        source.archive.fail("the entry with the points is missing", excerpt(document.data, 60));
      const std::size_t bytes = source.data->bytes, one = document.point_bytes() * document.layers;
      if (bytes / one != n || bytes % one != 0)
        source.archive.fail("the entry with the points has another size than the matrix", source.data->name,
                            std::to_string(bytes) + " bytes",
                            std::to_string(document.nx) + " x " + std::to_string(document.ny) + " x "
                                + std::to_string(document.layers) + " points of "
                                + std::to_string(document.point_bytes()) + " bytes");
      if (document.valid.empty())
        return;
      source.valid = source.archive.find(document.valid);
      if (!source.valid)
        source.archive.fail("the entry that marks the valid points is missing", excerpt(document.valid, 60));
      if (source.valid->bytes < (n * document.layers + 7) / 8)
        source.archive.fail("the entry that marks the valid points is too short", source.valid->name,
                            std::to_string(source.valid->bytes) + " bytes", "one bit for each point");
    }

    /// X3P (ISO 25178-72): zip archive of main.xml, its checksum, and binary data.
    class X3pReader : public SurfaceReader
    {
    public:
      explicit X3pReader(Parameters &) {}

      Match
      recognises(std::string_view content) const override
      {
        return content.substr(0, 4) == "PK\3\4" ? Match::certain : Match::none;
      }

      RawSurface
      read(std::string_view content, const std::string &file) const override
      {
        const auto source = std::make_shared<X3pSource>(content, file);
        const auto entry  = source->archive.find(main_xml);
        if (!entry)
          source->archive.fail("the archive has no description", main_xml, "", "",
                               "Of the formats that are zip archives only X3P is read.");
        source->main = source->archive.read(*entry, longest_main);
        check_main(*source);
        const std::string description = cut_out_list(*source);
        if (description.empty() || description.size() > longest_description)
          source->archive.fail("the description is too long", main_xml, std::to_string(source->main.size()) + " bytes",
                               std::to_string(longest_description) + " bytes without the list of points");
        source->document = read_x3p_document(description, source->archive);
        if (source->document.nx < 2 || source->document.ny < 2)
          source->archive.fail("the matrix is no map", main_xml,
                               std::to_string(source->document.nx) + " x " + std::to_string(source->document.ny)
                                   + " points",
                               "at least 2 x 2");
        find_data(*source);
        find_steps(*source);
        return surface_of(source);
      }

    private:
      static RawSurface
      surface_of(const std::shared_ptr<const X3pSource> &source)
      {
        const auto  &document = source->document;
        const double metre    = units::factor("m");
        RawSurface   raw;
        raw.nx         = document.nx;
        raw.ny         = document.ny;
        raw.remark     = document.remark;
        raw.pixel_size = { step(*source, 0) * metre, step(*source, 1) * metre };
        // Stored heights become metres in the sink, because of the offset.
        raw.height_unit   = metre;
        const bool flip_x = source->step[0] < 0., flip_y = source->step[1] < 0.;
        raw.heights = [source, flip_x, flip_y](const HeightSink &sink) {
          const auto &doc = source->document;
          for_each_x3p_point(*source, [&](std::size_t i, const X3pPoint &point) {
            check_position(*source, i, point);
            const std::size_t ix = i % doc.nx, iy = i / doc.nx;
            sink(flip_x ? doc.nx - 1 - ix : ix, flip_y ? doc.ny - 1 - iy : iy,
                 point[2] * doc.axes[2].increment + doc.axes[2].offset);
          });
        };
        raw.place = [source, flip_x, flip_y](std::size_t ix, std::size_t iy) {
          const auto &doc = source->document;
          return name_of_x3p_point(*source, (flip_y ? doc.ny - 1 - iy : iy) * doc.nx + (flip_x ? doc.nx - 1 - ix : ix));
        };
        if (document.layers > 1)
          raw.warning = "the file holds several layers; only the first is read.";
        if (document.rotated)
          raw.warning += " The rotation that the file states is not applied.";
        return raw;
      }

      static double
      step(const X3pSource &source, int axis)
      {
        const auto &a = source.document.axes[axis];
        return a.increment * (a.absolute ? std::abs(source.step[axis]) : 1.);
      }
    };
  } // namespace

  TRIBODRAW_REGISTER(SurfaceReader, X3pReader, "X3P", "X3P: zip archive with XML description, binary or inline points.",
                     "ISO 25178-72")
} // namespace tribodraw
