#include "face_mesh_reading.h"

#include <tribodraw/base/errors.h>
#include <tribodraw/base/files.h>
#include <tribodraw/base/suggest.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace tribodraw
{
  namespace face_mesh
  {
    namespace
    {
      constexpr std::uintmax_t most_bytes = 1ull << 30;
    }

    Text::Text(const std::filesystem::path &path) : file(path), content(read_file(path, most_bytes))
    {
    }

    bool
    Text::next()
    {
      if (end >= content.size())
        return false;
      begin = end;
      end   = std::min(content.find('\n', begin), content.size() - 1) + 1;
      ++number;
      present = std::string_view(content).substr(begin, end - begin);
      while (!present.empty() && (present.back() == '\n' || present.back() == '\r'))
        present.remove_suffix(1);
      return true;
    }

    void
    Text::demand_next(const std::string &what)
    {
      if (!next())
        refuse("The file ends where " + what + " should stand.");
    }

    void
    Text::step_back()
    {
      end = begin;
      --number;
    }

    std::string
    Text::place() const
    {
      return file.string() + ", line " + std::to_string(number);
    }

    std::vector<std::string_view>
    Text::words() const
    {
      constexpr const char         *blanks = " \t\v\f";
      std::vector<std::string_view> result;
      for (std::size_t at = present.find_first_not_of(blanks); at != std::string_view::npos;)
        {
          const std::size_t to = std::min(present.find_first_of(blanks, at), present.size());
          result.push_back(present.substr(at, to - at));
          at = present.find_first_not_of(blanks, to);
        }
      return result;
    }

    double
    Text::real(std::string_view word) const
    {
      word = trimmed(word);
      if (!word.empty() && word[0] == '+')
        word.remove_prefix(1);
      double value      = 0;
      auto [to, result] = std::from_chars(word.data(), word.data() + word.size(), value);
      std::string fortran;
      if (result == std::errc() && to != word.data() + word.size() && to != word.data())
        {
          // Exponents as Fortran writes them: 1.5D-03, 1.5-03.
          fortran        = word;
          std::size_t at = to - word.data();
          if (fortran[at] == 'd' || fortran[at] == 'D')
            fortran[at] = 'e';
          else if (fortran[at] == '+' || fortran[at] == '-')
            fortran.insert(at, "e");
          // from_chars takes no plus sign in front, but one in the exponent.
          std::tie(to, result) = [&] {
            const auto again = std::from_chars(fortran.data(), fortran.data() + fortran.size(), value);
            return std::make_pair(again.ptr, again.ec);
          }();
          if (to != fortran.data() + fortran.size())
            result = std::errc::invalid_argument;
        }
      if (word.empty() || result != std::errc() || !std::isfinite(value))
        refuse("'" + std::string(word.substr(0, 40)) + "' is not a number.");
      return value;
    }

    std::int64_t
    Text::whole(std::string_view word) const
    {
      word                    = trimmed(word);
      std::int64_t value      = 0;
      const auto [to, result] = std::from_chars(word.data(), word.data() + word.size(), value);
      if (word.empty() || result != std::errc() || to != word.data() + word.size() || value < 0)
        refuse("'" + std::string(word.substr(0, 40)) + "' is not a number of a node, an element or a part.", "",
               "a whole number that is not negative");
      return value;
    }

    void
    Text::refuse(const std::string &what, const std::string &value, const std::string &allowed,
                 const std::string &hint) const
    {
      throw InputError(describe_error(what, place(), value, allowed, hint));
    }

    std::string_view
    trimmed(std::string_view text)
    {
      constexpr const char *blanks = " \t\v\f\r";
      const std::size_t     at     = text.find_first_not_of(blanks);
      if (at == std::string_view::npos)
        return {};
      return text.substr(at, text.find_last_not_of(blanks) + 1 - at);
    }

    std::string
    upper(const std::string_view text)
    {
      std::string result(text);
      for (char &c : result)
        c = static_cast<char>(c >= 'a' && c <= 'z' ? c - 32 : c);
      return result;
    }

    std::vector<std::string_view>
    split(std::string_view text, const char separator)
    {
      std::vector<std::string_view> fields;
      for (std::size_t at = 0; at <= text.size();)
        {
          const std::size_t to = std::min(text.find(separator, at), text.size());
          fields.push_back(trimmed(text.substr(at, to - at)));
          at = to + 1;
        }
      while (!fields.empty() && fields.back().empty())
        fields.pop_back();
      return fields;
    }

    void
    Block::add_node(const Text &text, const std::int64_t number, const Eigen::Vector3d &x)
    {
      if (!index.emplace(number, static_cast<unsigned>(nodes.size())).second)
        text.refuse("Two nodes have the same number.", std::to_string(number));
      nodes.push_back(x);
    }

    void
    Block::add_face(const Text &text, const std::int64_t number, const std::array<std::int64_t, 4> &corners,
                    const unsigned part)
    {
      if (faces.size() >= most_faces)
        text.refuse("The file has too many elements.", "", "at most " + std::to_string(most_faces));
      faces.push_back({ number, corners, part });
    }

    void
    Block::append(FaceMesh &mesh, const Eigen::Affine3d &position, const Face &face, std::vector<unsigned> &image) const
    {
      const unsigned          n = face.corners[3] == Face::none ? 3 : 4;
      std::array<unsigned, 4> v{};
      for (unsigned k = 0; k < n; ++k)
        {
          const auto found = index.find(face.corners[k]);
          if (found == index.end())
            throw InputError(describe_error("An element has a node that does not exist.",
                                            mesh.name + ", element " + std::to_string(face.element),
                                            std::to_string(face.corners[k])));
          unsigned &node = image[found->second];
          if (node == unused)
            {
              node = static_cast<unsigned>(mesh.nodes.size());
              mesh.nodes.push_back(position * nodes[found->second]);
            }
          v[k] = node;
        }
      const auto add = [&](const unsigned a, const unsigned b, const unsigned c) {
        mesh.triangles.push_back({ v[a], v[b], v[c] });
        mesh.elements.push_back(face.element);
      };
      if (n == 3)
        return add(0, 1, 2);
      const auto &x = mesh.nodes;
      for (const auto &[a, b, c] : cut_quadrangle({ x[v[0]], x[v[1]], x[v[2]], x[v[3]] }))
        add(a, b, c);
    }

    void
    refuse_part(const std::filesystem::path &file, const std::string &part, const std::vector<std::string> &known)
    {
      std::string list;
      for (std::size_t k = 0; k < known.size() && k < 20; ++k)
        list += (k > 0 ? ", " : "") + known[k];
      if (known.size() > 20)
        list += " and " + std::to_string(known.size() - 20) + " more";
      const std::string near = nearest(part, known);
      throw InputError(describe_error("The mesh has no such part.", file.string(), "'" + part + "'",
                                      known.empty() ? "nothing: the file names no parts" : list,
                                      near.empty() ? "" : "Did you mean '" + near + "'?"));
    }
  } // namespace face_mesh

  namespace
  {
    using Reader = FaceMesh (*)(const std::filesystem::path &, const std::string &);

    Reader
    reader_of(const std::filesystem::path &file)
    {
      const std::string extension = face_mesh::upper(file.extension().string());
      if (extension == ".MSH")
        return face_mesh::read_gmsh;
      if (extension == ".INP")
        return face_mesh::read_abaqus;
      if (extension == ".K" || extension == ".KEY" || extension == ".DYN")
        return face_mesh::read_ls_dyna;
      return nullptr;
    }
  } // namespace

  std::array<std::array<unsigned, 3>, 2>
  cut_quadrangle(const std::array<Eigen::Vector3d, 4> &x)
  {
    if ((x[0] - x[2]).norm() <= (x[1] - x[3]).norm())
      return { { { 0, 1, 2 }, { 0, 2, 3 } } };
    return { { { 0, 1, 3 }, { 1, 2, 3 } } };
  }

  const char *const face_mesh_formats = "Gmsh (.msh), Abaqus (.inp), LS-DYNA (.k, .key, .dyn)";

  bool
  is_face_mesh(const std::filesystem::path &file)
  {
    return reader_of(file) != nullptr;
  }

  FaceMesh
  read_face_mesh(const std::filesystem::path &file, const std::string &part)
  {
    const Reader reader = reader_of(file);
    if (!reader)
      throw InputError(describe_error("The format of the mesh is not known.", file.string(),
                                      "'" + file.extension().string() + "'", face_mesh_formats));
    FaceMesh mesh = reader(file, part);
    if (mesh.triangles.empty())
      throw InputError(describe_error("The mesh has no triangles or quadrangles.",
                                      file.string() + (part.empty() ? "" : ", part '" + part + "'")));
    return mesh;
  }
} // namespace tribodraw
