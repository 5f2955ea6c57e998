// Parsers of files below the physics, small enough to be built for a fuzzer of their own.
#include "fuzz/parsers.h"
#include "fuzz/scratch_file.h"

#include <tribodraw/base/archive.h>
#include <tribodraw/base/csv.h>
#include <tribodraw/base/errors.h>
#include <tribodraw/base/files.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/base/units.h>
#include <tribodraw/surface/surface_reader.h>
#include <tribodraw/surface/surface_writer.h>
#include <tribodraw/tools/triangle_mesh.h>

#include <zlib.h>

#include <cmath>

using namespace tribodraw;

namespace
{
  const std::string archive_magic = "TRIBODRAW-ARCHIVE 1\n";
  constexpr std::size_t archive_head = 20 + 16; // magic, checksum, size

  std::string
  sample_archive()
  {
    Archive archive;
    archive.put("numbers", std::vector<double>{ 1, 2.5, -3e-300 });
    archive.put("empty", std::vector<double>{});
    archive.put("text", std::string("Blank/Thickness = 0.82 mm\n"));
    const ScratchFile file("");
    archive.save(file.path());
    return read_file(file.path());
  }

  /// A body with the checksum and size that belong to it: what is behind the checksum must stand damage too.
  void
  read_archive_body(const std::string &body)
  {
    const std::uint64_t head[2] = { crc32_z(0, reinterpret_cast<const Bytef *>(body.data()), body.size()), body.size() };
    Archive::load(ScratchFile(archive_magic + std::string(reinterpret_cast<const char *>(head), sizeof head) + body).path());
  }

  std::vector<std::string>
  sample_surfaces()
  {
    HeightMap map;
    map.nx = 5;
    map.ny = 4;
    map.dx = map.dy = 2e-3;
    for (int i = 0; i < 20; ++i)
      map.z.push_back(1e-4 * std::sin(2. + i * i));
    std::vector<std::string> contents;
    for (const std::string &format : surface_format_names())
      {
        const ScratchFile file("");
        write_surface_file(map, file.path(), format);
        contents.push_back(read_file(file.path()));
      }
    return contents;
  }

  void
  read_surface_content(const std::string &content)
  {
    const ScratchFile file(content);
    try
      {
        read_surface_file(file.path());
      }
    catch (const InputError &)
      {
        GivenScales given; // formats without scales
        given.pixel_size  = { 2e-3, 2e-3 };
        given.height_unit = 1e-3;
        read_surface_file(file.path(), given);
      }
  }

  std::vector<std::string>
  sample_triangles()
  {
    const std::string facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 9 0 0\nvertex 0 9 0\nendloop\nendfacet\n",
                      other = "facet normal 0 0 1\nouter loop\nvertex 9 9 1\nvertex 0 9 0\nvertex 9 0 0\nendloop\nendfacet\n";
    std::string       binary(80, ' ');
    const std::uint32_t n = 2;
    const float         corners[2][12] = { { 0, 0, 1, 0, 0, 0, 9, 0, 0, 0, 9, 0 }, { 0, 0, 1, 9, 9, 1, 0, 9, 0, 9, 0, 0 } };
    binary.append(reinterpret_cast<const char *>(&n), 4);
    for (const auto &triangle : corners)
      binary.append(reinterpret_cast<const char *>(triangle), sizeof triangle).append(2, '\0');
    return { "solid a\n" + facet + other + "endsolid a\n", binary };
  }

  void
  read_numbers_of_all_columns(const CsvData &data)
  {
    for (const auto &column : data.columns)
      data.numbers(column);
  }

  /// The format of parameter files, without the program's entries.
  void
  read_parameter_text(const std::string &text)
  {
    Parameters parameters = Parameters::from_text(text);
    parameters.text("Task", "Anything.");
    {
      const auto scope = parameters.section("Blank");
      parameters.quantity("Thickness", "mm", Range::positive(), "A length.");
      parameters.quantity_list("Lengths", "mm", Range::positive(), "Lengths.");
    }
    parameters.finish();
  }

  std::vector<FuzzedParser>
  make_parsers()
  {
    const std::string csv = "time_s,punch_travel_mm,punch_force_n\n0,0,0\n0.5,1e-3,2.25e4\n1,2,3\r\n";
    return {
      { "quantity", true, [](const std::string &text) { units::parse_quantity(text, "mm"); }, { "0.82 mm", "1e-3 m", "25.4e3um " } },
      { "csv", true, [](const std::string &text) { read_numbers_of_all_columns(read_csv(ScratchFile(text).path())); }, { csv } },
      { "checkpoint", false, [](const std::string &text) { Archive::load(ScratchFile(text).path()); }, { sample_archive() } },
      { "checkpoint body", false, read_archive_body, { sample_archive().substr(archive_head) } },
      { "surface", false, read_surface_content, sample_surfaces() },
      { "tool surface", false, [](const std::string &text) { read_triangles(ScratchFile(text, ".stl").path(), 1.); }, sample_triangles() },
      { "parameter text", true, read_parameter_text,
        { "set Task = forming # what\nsubsection Blank\n  set Thickness = 0.82 mm\n  set Lengths = 1, 2 mm\nend\n" } },
      { "tool object", true, [](const std::string &text) { read_triangles(ScratchFile(text, ".obj").path(), 1.); },
        { "v 0 0 0\nv 9 0 0\nv 0 9 0\nv 9 9 1\nf 1 2 3\nf 4/1 3/2 -3/3\n" } },
    };
  }
} // namespace

const std::vector<FuzzedParser> &
file_parsers()
{
  static const std::vector<FuzzedParser> parsers = make_parsers();
  return parsers;
}
