#include <tribodraw/base/errors.h>
#include <tribodraw/base/face_mesh.h>
#include <tribodraw/base/files.h>
#include <tribodraw/base/units.h>
#include <tribodraw/tools/triangle_mesh.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace tribodraw
{
  namespace
  {
    using Eigen::Vector3d;

    /// A tool of a car's side panel has some 200 000; memory grows by about 0.6 kB a triangle.
    constexpr std::size_t most_triangles = 2000000;

    /// Words of a text, line by line.
    class Words
    {
    public:
      Words(const std::string &content, const std::string &name_of_file) : text(content), name(name_of_file) {}

      /// The next line with at least one word; false at the end.
      bool
      next_line()
      {
        do
          {
            if (at >= text.size())
              return false;
            const std::size_t end = std::min(text.find('\n', at), text.size());
            words.clear();
            split(std::string_view(text).substr(at, end - at));
            at = end + 1;
            ++number;
          }
        while (words.empty());
        return true;
      }
      std::size_t
      size() const
      {
        return words.size();
      }
      std::string_view
      word(const std::size_t i) const
      {
        return i < words.size() ? words[i] : std::string_view();
      }
      bool
      is(const std::size_t i, const char *expected) const
      {
        const std::string_view w = word(i);
        return w.size() == std::strlen(expected)
               && std::equal(w.begin(), w.end(), expected,
                             [](const char a, const char b) { return (a >= 'A' && a <= 'Z' ? a + 32 : a) == b; });
      }
      double
      real(const std::size_t i, const char *what) const
      {
        std::string_view w = word(i);
        if (!w.empty() && w[0] == '+')
          w.remove_prefix(1);
        double value              = 0;
        const auto [end, problem] = std::from_chars(w.data(), w.data() + w.size(), value);
        if (problem != std::errc() || end != w.data() + w.size() || !std::isfinite(value))
          refuse(std::string("a number is missing or not finite (") + what + ").");
        return value;
      }
      Vector3d
      vector(const std::size_t first, const char *what) const
      {
        return { real(first, what), real(first + 1, what), real(first + 2, what) };
      }
      [[noreturn]] void
      refuse(const std::string &what, const std::string &allowed = "") const
      {
        std::string line;
        for (const auto &w : words)
          if (line.size() < 60)
            line += (line.empty() ? "" : " ") + std::string(w.substr(0, 60));
        throw InputError(describe_error("surface of a tool: " + what, name + ", line " + std::to_string(number),
                                        words.empty() ? "" : "'" + line + "'", allowed));
      }

    private:
      const std::string            &text;
      const std::string             name;
      std::size_t                   at = 0, number = 0;
      std::vector<std::string_view> words;

      void
      split(std::string_view line)
      {
        constexpr const char *blanks = " \t\r\v\f";
        for (std::size_t begin = line.find_first_not_of(blanks); begin != std::string_view::npos;
             begin             = line.find_first_not_of(blanks))
          {
                        line.remove_prefix(begin);
                        const std::size_t end = std::min(line.find_first_of(blanks), line.size());
                        words.push_back(line.substr(0, end));
                        line.remove_prefix(end);
          }
      }
    };

    void
    check_number(const std::size_t n, const std::string &name)
    {
      if (n > most_triangles)
        throw InputError(describe_error("surface of a tool: too many triangles.", name, std::to_string(n),
                                        "at most " + std::to_string(most_triangles),
                                        "The surface is smoothed between the corners: export it coarser."));
    }

    template <class Number>
    Number
    little_endian(const char *bytes)
    {
      static_assert(sizeof(Number) == 4, "STL has numbers of four bytes");
      std::uint32_t bits = 0;
      for (int k = 3; k >= 0; --k)
        bits = bits << 8 | static_cast<unsigned char>(bytes[k]);
      Number value;
      std::memcpy(&value, &bits, 4);
      return value;
    }

    // A header of 80 bytes, the number of triangles, and for each normal, three corners and two more bytes.
    constexpr std::size_t binary_head = 84, binary_triangle = 50;

    bool
    is_binary_stl(const std::string &content)
    {
      return content.size() >= binary_head
             && content.size()
                    == binary_head + binary_triangle * std::size_t(little_endian<std::uint32_t>(&content[80]));
    }

    void
    read_binary_stl(const std::string &content, TriangleMesh &mesh)
    {
      const std::size_t n = (content.size() - binary_head) / binary_triangle;
      check_number(n, mesh.name);
      mesh.vertices.reserve(3 * n);
      for (std::size_t t = 0; t < n; ++t)
        {
          const char *bytes = content.data() + binary_head + binary_triangle * t + 12; // behind the normal
          for (unsigned k = 0; k < 9; k += 3)
            {
              const Vector3d x(little_endian<float>(bytes + 4 * k), little_endian<float>(bytes + 4 * k + 4),
                               little_endian<float>(bytes + 4 * k + 8));
              if (!x.allFinite())
                throw InputError(describe_error("surface of a tool: a coordinate is not a finite number.",
                                                mesh.name + ", triangle " + std::to_string(t + 1)));
              mesh.vertices.push_back(x);
            }
          const auto first = static_cast<unsigned>(3 * t);
          mesh.triangles.push_back({ first, first + 1, first + 2 });
        }
    }

    void
    read_ascii_stl(const std::string &content, TriangleMesh &mesh)
    {
      Words      words(content, mesh.name);
      const auto demand = [&](const char *keyword) {
        if (!words.next_line())
          words.refuse(std::string("the file ends where '") + keyword + "' should stand.");
        if (!words.is(0, keyword))
          words.refuse("the line is not what the format demands.", std::string("'") + keyword + "'");
      };
      bool inside = false;
      while (words.next_line())
        if (words.is(0, "solid"))
          inside = true;
        else if (words.is(0, "endsolid") && inside)
          inside = false;
        else if (words.is(0, "facet") && inside)
          {
            demand("outer");
            const auto first = static_cast<unsigned>(mesh.vertices.size());
            for (int k = 0; k < 3; ++k)
              {
                demand("vertex");
                mesh.vertices.push_back(words.vector(1, "corner"));
              }
            demand("endloop");
            demand("endfacet");
            mesh.triangles.push_back({ first, first + 1, first + 2 });
            check_number(mesh.triangles.size(), mesh.name);
          }
        else
          words.refuse("the line is not what the format demands.", inside ? "'facet' or 'endsolid'" : "'solid'");
      if (inside)
        words.refuse("the file ends before 'endsolid': it is truncated.");
    }

    /// Index of an OBJ file: from one, or from the end if negative; 0-based result.
    unsigned
    obj_index(const Words &words, std::string_view text, const std::size_t count)
    {
      long value                = 0;
      const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
      const long n              = static_cast<long>(count);
      if (problem != std::errc() || end != text.data() + text.size() || value == 0 || value > n || value < -n)
        words.refuse("a corner does not exist.", "1 to " + std::to_string(count));
      return static_cast<unsigned>(value > 0 ? value - 1 : n + value);
    }

    void
    read_obj(const std::string &content, TriangleMesh &mesh)
    {
      Words                 words(content, mesh.name);
      std::vector<Vector3d> normals;
      bool                  all_have_normals = true;
      const auto            corner           = [&](const std::size_t i, Vector3d &normal) {
        const std::string_view text  = words.word(i);
        const std::size_t      slash = text.find('/');
        const std::size_t      last  = slash == std::string_view::npos ? slash : text.find('/', slash + 1);
        if (last != std::string_view::npos && last + 1 < text.size())
          normal = normals.empty() ? Vector3d::Zero().eval()
                                                        : normals[obj_index(words, text.substr(last + 1), normals.size())];
        else
          all_have_normals = false;
        return obj_index(words, text.substr(0, slash), mesh.vertices.size());
      };
      while (words.next_line())
        if (words.is(0, "v"))
          mesh.vertices.push_back(words.vector(1, "corner"));
        else if (words.is(0, "vn"))
          {
            const Vector3d n = words.vector(1, "normal");
            if (!(n.norm() > 0))
              words.refuse("a normal is zero.");
            normals.push_back(n / n.norm());
          }
        else if (words.is(0, "f"))
          {
            if (words.size() != 4 && words.size() != 5)
              words.refuse("only triangles and quadrangles are read.", "3 or 4 corners");
            std::array<unsigned, 4> v{};
            std::array<Vector3d, 4> n{};
            for (std::size_t k = 0; k + 1 < words.size(); ++k)
              v[k] = corner(k + 1, n[k]);
            const auto add = [&](const unsigned a, const unsigned b, const unsigned c) {
              mesh.triangles.push_back({ v[a], v[b], v[c] });
              mesh.normals.push_back({ n[a], n[b], n[c] });
            };
            const auto &x = mesh.vertices;
            if (words.size() == 4)
              add(0, 1, 2);
            else
              for (const auto &[a, b, c] : cut_quadrangle({ x[v[0]], x[v[1]], x[v[2]], x[v[3]] }))
                add(a, b, c);
            check_number(mesh.triangles.size(), mesh.name);
          }
      if (!all_have_normals)
        mesh.normals.clear();
    }

    void
    read_by_content(const std::string &content, const bool named_obj, TriangleMesh &mesh)
    {
      const std::size_t begin        = content.find_first_not_of(" \t\r\n");
      const bool        starts_solid = begin != std::string::npos && content.compare(begin, 5, "solid") == 0;
      if (is_binary_stl(content))
        return read_binary_stl(content, mesh);
      // Text has no zero bytes; headers of binary files often begin with `solid` too.
      const bool is_text = content.find('\0') == std::string::npos;
      if (starts_solid && is_text)
        return read_ascii_stl(content, mesh);
      if (named_obj && is_text)
        return read_obj(content, mesh);
      if (content.size() >= binary_head)
        throw InputError(describe_error(
            "surface of a tool: the file is neither STL nor OBJ, or it is truncated.", mesh.name,
            std::to_string(content.size()) + " bytes",
            "as a binary STL file its head announces "
                + std::to_string(binary_head
                                 + binary_triangle * std::size_t(little_endian<std::uint32_t>(&content[80])))
                + " bytes"));
      throw InputError(describe_error("surface of a tool: the file is neither STL nor OBJ.", mesh.name,
                                      std::to_string(content.size()) + " bytes", "",
                                      "Files of the format OBJ must end in .obj."));
    }
  } // namespace

  TriangleMesh
  read_triangles(const std::filesystem::path &file, const double unit, const std::string &part)
  {
    if (!(unit > 0) || !std::isfinite(unit))
      throw InputError(
          describe_error("surface of a tool: the unit must be positive.", file.string(), units::number(unit) + " mm"));
    TriangleMesh mesh;
    mesh.name             = file.string();
    if (is_face_mesh(file))
      {
        FaceMesh faces = read_face_mesh(file, part);
        mesh.vertices  = std::move(faces.nodes);
        mesh.triangles = std::move(faces.triangles);
      }
    else if (!part.empty())
      throw InputError(describe_error("surface of a tool: files of this format have no parts.", mesh.name,
                                      "'" + part + "'", "empty, or one of the formats " + std::string(face_mesh_formats)));
    else
      {
        std::string extension = file.extension().string();
        for (char &c : extension)
          c = static_cast<char>(c >= 'A' && c <= 'Z' ? c + 32 : c);
        // A triangle takes at most some 350 bytes of text.
        read_by_content(read_file(file, 400 * most_triangles), extension == ".obj", mesh);
      }
    if (mesh.triangles.empty())
      throw InputError(describe_error("surface of a tool: the file has no triangles.", mesh.name));
    Vector3d low = mesh.vertices[mesh.triangles[0][0]] * unit, high = low;
    for (Vector3d &x : mesh.vertices)
      x *= unit;
    for (const auto &t : mesh.triangles)
      for (const unsigned v : t)
        {
          low  = low.cwiseMin(mesh.vertices[v]);
          high = high.cwiseMax(mesh.vertices[v]);
        }
    const double size = (high - low).norm();
    const auto   mm   = [](const double x) { return units::number(std::round(x * 1e6) / 1e6); };
    if (!(size >= 1 && size <= 50000))
      throw InputError(describe_error(
          "surface of a tool: its size is not that of a tool.", mesh.name,
          mm(high[0] - low[0]) + " x " + mm(high[1] - low[1]) + " x " + mm(high[2] - low[2]) + " mm", "1 mm to 50 m",
          "Is `Unit` that of the file? One unit is now " + units::format(unit, "mm") + "."));
    const double far = std::max(low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff());
    if (far > 100 * std::max(size, 1000.))
      throw InputError(describe_error("surface of a tool: it lies far away from its origin.", mesh.name,
                                      mm(far) + " mm", "at most " + mm(100 * std::max(size, 1000.)) + " mm",
                                      "Move it before the export: the origin is that of the tool's frame."));
    // Single precision leaves 1e-7 of the size.
    weld(mesh, 1e-6 * size);
    if (mesh.triangles.empty())
      throw InputError(describe_error("surface of a tool: all triangles have collapsed.", mesh.name));
    return mesh;
  }
} // namespace tribodraw
