#include <tribodraw/base/errors.h>
#include <tribodraw/base/registry.h>
#include <tribodraw/base/units.h>
#include <tribodraw/surface/surface_reader.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "text_tools.h"
#include "x3p_document.h"
#include "zip_archive.h"

namespace tribodraw
{
  namespace
  {
    // Heights in the description itself take some 40 bytes each; larger maps are stored in binary form. The rest of the
    // description is a few kilobytes, and its tree in memory sixteen times as long as the text at most.
    constexpr std::size_t longest_main = 32u << 20, longest_description = 1u << 20;

    constexpr const char *main_xml = "main.xml";

    /// Everything that the heights are read from; shared by the calls.
    struct Source
    {
      Source(std::string_view content, const std::string &file) : archive(content, file) {}

      ZipArchive                       archive;
      std::string                      main; ///< text of main.xml
      std::string_view                 list; ///< the inline heights in it
      X3pDocument                      document;
      std::optional<ZipArchive::Entry> data, valid;
      /// Positions on axes that are stored with the points, from the corners of the map.
      std::array<double, 2> first{}, step{};
    };

    /// Coordinates of a point on the absolute axes and its height, in stored units.
    using Coordinates = std::array<double, 3>;

    bool
    is_digest(const std::string &text)
    {
      return text.size() == 32 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
    }

    void
    check_digest(const ZipArchive &archive, const std::string &entry, const std::string &found,
                 const std::string &stated)
    {
      if (is_digest(stated) && found != stated)
        archive.fail("the MD5 checksum of an entry is wrong", entry, found, stated,
                     "The file was changed after it was written: export it again.");
    }

    /// main.xml against the file that holds its checksum.
    void
    check_main(const Source &source)
    {
      const auto entry = source.archive.find("md5checksum.hex");
      if (!entry || entry->bytes > 4096)
        return;
      Md5 md5;
      md5.add(source.main.data(), source.main.size());
      check_digest(source.archive, main_xml, md5.digest(),
                   lower(std::string(trimmed(source.archive.read(*entry, 4096))).substr(0, 32)));
    }

    /// Takes the list of inline heights out of the description, because a tree of it would take too much memory.
    std::string
    cut_out_list(Source &source)
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

    /// The texts of the elements `Datum`, one after another.
    class Datums
    {
    public:
      Datums(const Source &all) : source(all), rest(all.list) {}

      bool
      next(std::string_view &text)
      {
        skip_blanks_and_comments();
        if (rest.empty())
          return false;
        for (const std::string_view open : { "<Datum>", "<p:Datum>" })
          if (rest.substr(0, open.size()) == open)
            {
              const auto end = rest.find('<', open.size());
              text           = end == std::string_view::npos ? rest : rest.substr(open.size(), end - open.size());
              rest.remove_prefix(std::min(end, rest.size()));
              const std::string close = "</" + std::string(open.substr(1));
              if (rest.substr(0, close.size()) != close)
                fail("an element `Datum` is not ended", rest);
              rest.remove_prefix(close.size());
              return true;
            }
        for (const std::string_view empty : { "<Datum/>", "<Datum />", "<p:Datum/>", "<p:Datum />" })
          if (rest.substr(0, empty.size()) == empty)
            {
              text = {};
              rest.remove_prefix(empty.size());
              return true;
            }
        fail("not an element `Datum`", rest);
      }

      [[noreturn]] void
      fail(const std::string &what, std::string_view at, const std::string &allowed = "") const
      {
        source.archive.fail(what, std::string(main_xml) + ", byte " + std::to_string(at.data() - source.main.data()),
                            "`" + excerpt(at) + "`", allowed);
      }

      std::string_view
      remaining() const
      {
        return rest;
      }

    private:
      void
      skip_blanks_and_comments()
      {
        for (;;)
          {
            rest.remove_prefix(std::min(rest.find_first_not_of(" \t\r\n"), rest.size()));
            if (rest.substr(0, 4) != "<!--")
              return;
            const auto end = rest.find("-->");
            if (end == std::string_view::npos)
              fail("a comment is not ended", rest);
            rest.remove_prefix(end + 3);
          }
      }

      const Source    &source;
      std::string_view rest;
    };

    /// One inline point: numbers of the absolute axes separated by `;`, or all three; empty: not measured.
    Coordinates
    parse_datum(std::string_view text, const Source &source, const Datums &datums)
    {
      const auto       &axes = source.document.axes;
      const std::size_t stored
          = 1 + static_cast<std::size_t>(axes[0].absolute) + static_cast<std::size_t>(axes[1].absolute);
      constexpr double      nan = std::numeric_limits<double>::quiet_NaN();
      Coordinates           point{ nan, nan, nan };
      std::array<double, 3> numbers{};
      std::size_t           n = 0;
      if (trimmed(text).empty())
        return point;
      Fields           fields(text, { ';', false });
      std::string_view field;
      while (fields.next(field))
        {
          const auto value = parse_height(field);
          if (!value || n >= 3)
            datums.fail("a point is not made of numbers", text, std::to_string(stored) + " or 3 numbers");
          numbers[n++] = *value;
        }
      if (n != stored && n != 3)
        datums.fail("a point has another number of coordinates than the axes need", text,
                    std::to_string(stored) + " or 3 numbers");
      point[2] = numbers[n - 1];
      if (n == 3)
        return { numbers[0], numbers[1], numbers[2] };
      if (n == 2)
        point[axes[0].absolute ? 0 : 1] = numbers[0];
      return point;
    }

    template <class Use>
    void
    for_each_inline(const Source &source, const Use &use)
    {
      const auto      &document = source.document;
      Datums           datums(source);
      std::string_view text;
      const auto       n = document.nx * document.ny;
      for (std::size_t i = 0; i < n; ++i)
        {
          if (!datums.next(text))
            datums.fail("the list has fewer points than the matrix", datums.remaining(),
                        std::to_string(n) + ", there are " + std::to_string(i));
          use(i, parse_datum(text, source, datums));
        }
      std::size_t n_more = 0;
      while (datums.next(text))
        ++n_more;
      if (n_more != n * (document.layers - 1))
        datums.fail("the list has another number of points than the matrix", datums.remaining(),
                    std::to_string(n) + " x " + std::to_string(document.layers) + ", there are "
                        + std::to_string(n + n_more));
    }

    /// Bytes of an entry that go through its checksum.
    class CheckedStream
    {
    public:
      CheckedStream(const ZipArchive &zip, const ZipArchive::Entry &what, std::string digest)
          : archive(zip), entry(what), stated(std::move(digest)), stream(zip, what)
      {
      }

      void
      read(char *target, std::size_t n)
      {
        stream.read(target, n);
        if (!stated.empty())
          md5.add(target, n);
        done += n;
      }

      /// Reads what is left, for the checksums of the archive and the document.
      void
      finish()
      {
        std::vector<char> buffer(1 << 16);
        while (done < entry.bytes)
          read(buffer.data(), std::min(buffer.size(), entry.bytes - done));
        stream.finish();
        check_digest(archive, entry.name, md5.digest(), stated);
      }

    private:
      const ZipArchive  &archive;
      ZipArchive::Entry  entry;
      std::string        stated;
      ZipArchive::Stream stream;
      Md5                md5;
      std::size_t        done = 0;
    };

    /// One bit a point, the lowest bit of a byte first; 1: measured.
    class ValidPoints
    {
    public:
      explicit ValidPoints(const Source &source)
      {
        if (source.valid)
          stream = std::make_unique<CheckedStream>(source.archive, *source.valid, source.document.valid_md5);
      }

      bool
      operator()(std::size_t i)
      {
        if (!stream)
          return true;
        if (i % 8 == 0)
          stream->read(&byte, 1);
        return ((static_cast<unsigned char>(byte) >> (i % 8)) & 1) != 0;
      }

      void
      finish()
      {
        if (stream)
          stream->finish();
      }

    private:
      std::unique_ptr<CheckedStream> stream;
      char                           byte = 0;
    };

    template <class Use>
    void
    for_each_binary(const Source &source, const Use &use)
    {
      const auto           &document = source.document;
      const std::size_t     bytes = document.point_bytes(), n = document.nx * document.ny;
      constexpr std::size_t piece = 4096; // points
      std::vector<char>     buffer(piece * bytes);
      CheckedStream         stream(source.archive, *source.data, document.data_md5);
      ValidPoints           valid(source);
      for (std::size_t i = 0; i < n; ++i)
        {
          if (i % piece == 0)
            stream.read(buffer.data(), bytes * std::min(piece, n - i));
          const char *stored = buffer.data() + (i % piece) * bytes;
          Coordinates point{};
          for (int axis = 0; axis < 3; ++axis)
            if (document.axes[axis].absolute)
              {
                point[axis] = document.axes[axis].decode(stored);
                stored += document.axes[axis].bytes;
              }
          if (!valid(i))
            point[2] = std::numeric_limits<double>::quiet_NaN();
          use(i, point);
        }
      stream.finish();
      valid.finish();
    }

    template <class Use>
    void
    for_each_point(const Source &source, const Use &use)
    {
      if (source.document.is_inline)
        for_each_inline(source, use);
      else
        for_each_binary(source, use);
    }

    std::string
    name_of_point(const Source &source, std::size_t i)
    {
      return (source.document.is_inline ? std::string(main_xml) : source.data->name) + ", point "
             + std::to_string(i + 1)
             + (source.document.is_inline ? "" : ", byte " + std::to_string(i * source.document.point_bytes()));
    }

    /// Where axes store a position for each point: the corners tell the step, and all points are checked later.
    void
    find_steps(Source &source)
    {
      const auto &document = source.document;
      if (!document.axes[0].absolute && !document.axes[1].absolute)
        return;
      const std::array<std::size_t, 2> last{ document.nx - 1, (document.ny - 1) * document.nx };
      std::array<double, 2>            end{};
      for_each_point(source, [&](std::size_t i, const Coordinates &point) {
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
                                  name_of_point(source, last[axis]), units::number(end[axis]));
          }
    }

    void
    check_position(const Source &source, std::size_t i, const Coordinates &point)
    {
      const std::array<std::size_t, 2> index{ i % source.document.nx, i / source.document.nx };
      for (int axis = 0; axis < 2; ++axis)
        if (source.document.axes[axis].absolute && !std::isnan(point[2]))
          {
            const double off
                = (point[axis] - source.first[axis]) / source.step[axis] - static_cast<double>(index[axis]);
            if (!(std::abs(off) <= 0.01))
              source.archive.fail("the points do not lie on a regular grid", name_of_point(source, i),
                                  units::number(off) + " pixels off", "0.01",
                                  "Interpolate them on a regular grid first.");
          }
    }

    void
    find_data(Source &source)
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
        const auto source = std::make_shared<Source>(content, file);
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
      surface_of(const std::shared_ptr<const Source> &source)
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
          for_each_point(*source, [&](std::size_t i, const Coordinates &point) {
            check_position(*source, i, point);
            const std::size_t ix = i % doc.nx, iy = i / doc.nx;
            sink(flip_x ? doc.nx - 1 - ix : ix, flip_y ? doc.ny - 1 - iy : iy,
                 point[2] * doc.axes[2].increment + doc.axes[2].offset);
          });
        };
        raw.place = [source, flip_x, flip_y](std::size_t ix, std::size_t iy) {
          const auto &doc = source->document;
          return name_of_point(*source, (flip_y ? doc.ny - 1 - iy : iy) * doc.nx + (flip_x ? doc.nx - 1 - ix : ix));
        };
        if (document.layers > 1)
          raw.warning = "the file holds several layers; only the first is read.";
        if (document.rotated)
          raw.warning += " The rotation that the file states is not applied.";
        return raw;
      }

      static double
      step(const Source &source, int axis)
      {
        const auto &a = source.document.axes[axis];
        return a.increment * (a.absolute ? std::abs(source.step[axis]) : 1.);
      }
    };
  } // namespace

  TRIBODRAW_REGISTER(SurfaceReader, X3pReader, "X3P", "X3P: zip archive with XML description, binary or inline points.",
                     "ISO 25178-72")
} // namespace tribodraw
