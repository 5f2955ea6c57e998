#include "x3p_points.h"

#include <tribodraw/base/errors.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "text_tools.h"

namespace tribodraw
{
  namespace
  {
    constexpr const char *main_xml = "main.xml";

    bool
    is_digest(const std::string &text)
    {
      return text.size() == 32 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
    }

    /// The texts of the elements `Datum`, one after another.
    class Datums
    {
    public:
      Datums(const X3pSource &all) : source(all), rest(all.list) {}

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

      const X3pSource &source;
      std::string_view rest;
    };

    /// One inline point: numbers of the absolute axes separated by `;`, or all three; empty: not measured.
    X3pPoint
    parse_datum(std::string_view text, const X3pSource &source, const Datums &datums)
    {
      const auto       &axes = source.document.axes;
      const std::size_t stored
          = 1 + static_cast<std::size_t>(axes[0].absolute) + static_cast<std::size_t>(axes[1].absolute);
      constexpr double      nan = std::numeric_limits<double>::quiet_NaN();
      X3pPoint              point{ nan, nan, nan };
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
    for_each_inline(const X3pSource &source, const Use &use)
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
        check_md5(archive, entry.name, md5.digest(), stated);
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
      explicit ValidPoints(const X3pSource &source)
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
    for_each_binary(const X3pSource &source, const Use &use)
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
          X3pPoint    point{};
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
  } // namespace

  void
  check_md5(const ZipArchive &archive, const std::string &entry, const std::string &found, const std::string &stated)
  {
    if (is_digest(stated) && found != stated)
      archive.fail("the MD5 checksum of an entry is wrong", entry, found, stated,
                   "The file was changed after it was written: export it again.");
  }

  void
  for_each_x3p_point(const X3pSource &source, const std::function<void(std::size_t i, const X3pPoint &)> &use)
  {
    if (source.document.is_inline)
      for_each_inline(source, use);
    else
      for_each_binary(source, use);
  }

  std::string
  name_of_x3p_point(const X3pSource &source, std::size_t i)
  {
    return (source.document.is_inline ? std::string(main_xml) : source.data->name) + ", point " + std::to_string(i + 1)
           + (source.document.is_inline ? "" : ", byte " + std::to_string(i * source.document.point_bytes()));
  }
} // namespace tribodraw
