#include <tribodraw/base/errors.h>
#include <tribodraw/base/files.h>
#include <tribodraw/base/units.h>
#include <tribodraw/surface/surface_writer.h>

#include <charconv>
#include <map>

#include "number_bytes.h"
#include "text_tools.h"

namespace tribodraw
{
  namespace
  {
    using Writer = void (*)(const HeightMap &, const std::filesystem::path &);

    const std::map<std::string, Writer> &
    writers()
    {
      static const std::map<std::string, Writer> all{ { "csv", &write_ascii_matrix },
                                                      { "gsf", &write_gsf },
                                                      { "npy", &write_npy },
                                                      { "sdf", &write_sdf_binary },
                                                      { "sdf ascii", &write_sdf_text } };
      return all;
    }
  } // namespace

  void
  append_text(std::string &content, double value)
  {
    char       buffer[32];
    const auto result = std::to_chars(buffer, buffer + sizeof(buffer), value);
    content.append(buffer, result.ptr);
  }

  std::string
  one_line(std::string text)
  {
    for (char &c : text)
      if (static_cast<unsigned char>(c) < 0x20)
        c = ' ';
    return text;
  }

  const std::vector<std::string> &
  surface_format_names()
  {
    static const auto names = [] {
      std::vector<std::string> all;
      for (const auto &[name, writer] : writers())
        all.push_back(name);
      return all;
    }();
    return names;
  }

  void
  write_surface_file(const HeightMap &map, const std::filesystem::path &file, const std::string &format)
  {
    const std::string extension = lower(file.extension().string());
    const std::string name      = !format.empty() || extension.empty() ? format : extension.substr(1);
    const auto        writer    = writers().find(name);
    if (writer == writers().end())
      {
        std::string allowed;
        for (const std::string &known : surface_format_names())
          allowed += (allowed.empty() ? "" : ", ") + known;
        throw InputError(describe_error("the format of a surface file to be written is unknown.", file.string(),
                                        "`" + name + "`", allowed));
      }
    if (map.size() == 0)
      throw InputError(describe_error("an empty map cannot be written.", file.string()));
    writer->second(map, file);
  }

  void
  write_gsf(const HeightMap &map, const std::filesystem::path &file)
  {
    const double metre   = units::factor("m");
    std::string  content = "Gwyddion Simple Field 1.0\nXRes = " + std::to_string(map.nx)
                          + "\nYRes = " + std::to_string(map.ny) + "\nXReal = ";
    append_text(content, static_cast<double>(map.nx) * map.dx / metre);
    content += "\nYReal = ";
    append_text(content, static_cast<double>(map.ny) * map.dy / metre);
    content += "\nXYUnits = m\nZUnits = m\nTitle = " + one_line(map.description) + "\n";
    content.append(4 - content.size() % 4, '\0');
    content.reserve(content.size() + 4 * map.size());
    for (std::size_t row = 0; row < map.ny; ++row)
      for (std::size_t ix = 0; ix < map.nx; ++ix)
        append_number(content, static_cast<float>(map(ix, map.ny - 1 - row) / metre));
    write_file(file, content);
  }

  void
  write_ascii_matrix(const HeightMap &map, const std::filesystem::path &file)
  {
    const double um      = units::factor("um");
    std::string  content = "# tribodraw: " + one_line(map.description) + "\n# Columns: " + std::to_string(map.nx)
                          + "\n# Rows: " + std::to_string(map.ny) + "\n# Width: ";
    append_text(content, static_cast<double>(map.nx) * map.dx / um);
    content += " um\n# Height: ";
    append_text(content, static_cast<double>(map.ny) * map.dy / um);
    content += " um\n# Value units: um\n";
    for (std::size_t row = 0; row < map.ny; ++row)
      for (std::size_t ix = 0; ix < map.nx; ++ix)
        {
          append_text(content, map(ix, map.ny - 1 - row) / um);
          content += ix + 1 < map.nx ? ',' : '\n';
        }
    write_file(file, content);
  }
} // namespace tribodraw
