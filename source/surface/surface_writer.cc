#include <tribodraw/base/errors.h>
#include <tribodraw/base/files.h>
#include <tribodraw/base/units.h>
#include <tribodraw/surface/surface_writer.h>

#include <charconv>
#include <cstdint>
#include <cstring>

namespace tribodraw
{
  namespace
  {
    void
    append_float(std::string &content, float value)
    {
      std::uint32_t bits;
      std::memcpy(&bits, &value, sizeof(bits));
      for (int i = 0; i < 4; ++i)
        content += static_cast<char>((bits >> (8 * i)) & 0xFF);
    }

    void
    append_number(std::string &content, double value)
    {
      char       buffer[32];
      const auto result = std::to_chars(buffer, buffer + sizeof(buffer), value);
      content.append(buffer, result.ptr);
    }

    /// Comments are one line; a description may quote anything.
    std::string
    one_line(std::string text)
    {
      for (char &c : text)
        if (static_cast<unsigned char>(c) < 0x20)
          c = ' ';
      return text;
    }
  } // namespace

  const std::vector<std::string> &
  surface_format_names()
  {
    static const std::vector<std::string> names{ "csv", "gsf" };
    return names;
  }

  void
  write_surface_file(const HeightMap &map, const std::filesystem::path &file, const std::string &format)
  {
    const std::string extension = file.extension().string();
    const std::string name      = !format.empty() || extension.empty() ? format : extension.substr(1);
    if (map.size() == 0)
      throw InputError(describe_error("an empty map cannot be written.", file.string()));
    if (name == "csv")
      write_ascii_matrix(map, file);
    else if (name == "gsf")
      write_gsf(map, file);
    else
      throw InputError(describe_error("the format of a surface file to be written is unknown.", file.string(),
                                      "`" + name + "`", "csv, gsf"));
  }

  void
  write_gsf(const HeightMap &map, const std::filesystem::path &file)
  {
    const double metre   = units::factor("m");
    std::string  content = "Gwyddion Simple Field 1.0\nXRes = " + std::to_string(map.nx)
                          + "\nYRes = " + std::to_string(map.ny) + "\nXReal = ";
    append_number(content, static_cast<double>(map.nx) * map.dx / metre);
    content += "\nYReal = ";
    append_number(content, static_cast<double>(map.ny) * map.dy / metre);
    content += "\nXYUnits = m\nZUnits = m\nTitle = " + one_line(map.description) + "\n";
    content.append(4 - content.size() % 4, '\0');
    content.reserve(content.size() + 4 * map.size());
    for (std::size_t row = 0; row < map.ny; ++row)
      for (std::size_t ix = 0; ix < map.nx; ++ix)
        append_float(content, static_cast<float>(map(ix, map.ny - 1 - row) / metre));
    write_file(file, content);
  }

  void
  write_ascii_matrix(const HeightMap &map, const std::filesystem::path &file)
  {
    const double um      = units::factor("um");
    std::string  content = "# " + one_line(map.description) + "\n# Width: ";
    append_number(content, static_cast<double>(map.nx) * map.dx / um);
    content += " um\n# Height: ";
    append_number(content, static_cast<double>(map.ny) * map.dy / um);
    content += " um\n# Value units: um\n";
    for (std::size_t row = 0; row < map.ny; ++row)
      for (std::size_t ix = 0; ix < map.nx; ++ix)
        {
          append_number(content, map(ix, map.ny - 1 - row) / um);
          content += ix + 1 < map.nx ? '\t' : '\n';
        }
    write_file(file, content);
  }
} // namespace tribodraw
