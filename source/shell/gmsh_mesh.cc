#include <tribodraw/base/errors.h>
#include <tribodraw/shell/blank_mesh.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>
#include <unordered_map>

namespace tribodraw
{
  using Eigen::Vector3d;

  namespace
  {
    /// Distances below this share of the size of the mesh count as zero.
    constexpr double same_place = 1e-7;

    /// Lines of a file with their numbers.
    class Lines
    {
    public:
      explicit Lines(const std::filesystem::path &path) : stream(path), name(path.string())
      {
        if (!stream)
          throw InputError(describe_error("The mesh file cannot be opened.", name));
        bytes = std::filesystem::file_size(path);
      }

      bool
      next()
      {
        if (!std::getline(stream, text))
          return false;
        ++number;
        if (!text.empty() && text.back() == '\r')
          text.pop_back();
        return true;
      }
      void
      demand_next(const std::string &what)
      {
        if (!next())
          refuse("The file ends where " + what + " should stand.");
      }
      /// The numbers of the line: at least @p least.
      std::vector<double>
      numbers(const std::size_t least, const std::string &what) const
      {
        std::istringstream  words(text);
        std::vector<double> result;
        std::string         word;
        while (words >> word)
          {
            std::size_t end   = 0;
            double      value = std::numeric_limits<double>::quiet_NaN();
            try
              {
                value = std::stod(word, &end);
              }
            catch (const std::exception &)
              {
                end = 0;
              }
            if (end != word.size() || !std::isfinite(value))
              refuse("'" + word.substr(0, 40) + "' is not a number.");
            result.push_back(value);
          }
        if (result.size() < least)
          refuse("Too few numbers for " + what + ".", std::to_string(result.size()),
                 "at least " + std::to_string(least));
        return result;
      }
      /// A count; each thing counted needs at least two bytes of the file.
      std::size_t
      count(const double value, const std::string &what) const
      {
        if (!(value >= 0 && value == std::floor(value) && value <= static_cast<double>(bytes) / 2))
          refuse("The number of " + what + " does not fit the size of the file.", std::to_string(value));
        return static_cast<std::size_t>(value);
      }
      [[noreturn]] void
      refuse(const std::string &what, const std::string &value = "", const std::string &allowed = "",
             const std::string &hint = "") const
      {
        throw InputError(describe_error(what, name + ", line " + std::to_string(number), value, allowed, hint));
      }

      std::string text;

    private:
      std::ifstream  stream;
      std::string    name;
      std::size_t    number = 0;
      std::uintmax_t bytes  = 0;
    };

    /// What the sections of a file say.
    struct Raw
    {
      std::vector<Vector3d>                      nodes;
      std::unordered_map<std::int64_t, unsigned> index; ///< of a node by its number in the file
      std::vector<std::array<unsigned, 3>>       triangles;
      bool                                       new_format = false;
    };

    std::int64_t
    tag(const Lines &lines, const double value)
    {
      if (!(std::abs(value) < 1e15 && value == std::floor(value)))
        lines.refuse("A number of a node or element is not a whole number.", std::to_string(value));
      return static_cast<std::int64_t>(value);
    }

    void
    add_node(const Lines &lines, Raw &raw, const std::int64_t number, const Vector3d &x)
    {
      if (!raw.index.emplace(number, static_cast<unsigned>(raw.nodes.size())).second)
        lines.refuse("Two nodes have the same number.", std::to_string(number));
      raw.nodes.push_back(x);
    }

    void
    add_element(const Lines &lines, Raw &raw, const int type, const std::vector<double> &numbers,
                const std::size_t first)
    {
      constexpr int line = 1, triangle = 2, quadrangle = 3, point = 15;
      if (type == line || type == point)
        return;
      if (type != triangle && type != quadrangle)
        lines.refuse("Elements of this type are not read.", "Gmsh type " + std::to_string(type),
                     "2 (triangle) and 3 (quadrangle)", "Save a mesh of the surface with elements of first order.");
      const std::size_t n = type == triangle ? 3 : 4;
      if (numbers.size() != first + n)
        lines.refuse("The element has a wrong number of nodes.",
                     std::to_string(numbers.size() - std::min(first, numbers.size())), std::to_string(n));
      std::array<unsigned, 4> v{};
      for (std::size_t k = 0; k < n; ++k)
        {
          const auto found = raw.index.find(tag(lines, numbers[first + k]));
          if (found == raw.index.end())
            lines.refuse("The element has a node that does not exist.", std::to_string(tag(lines, numbers[first + k])));
          v[k] = found->second;
        }
      const auto add = [&](const unsigned a, const unsigned b, const unsigned c) {
        const Vector3d normal = (raw.nodes[b] - raw.nodes[a]).cross(raw.nodes[c] - raw.nodes[a]);
        if (a == b || b == c || c == a
            || !(normal.norm() > 1e-6 * (raw.nodes[b] - raw.nodes[a]).norm() * (raw.nodes[c] - raw.nodes[a]).norm()))
          lines.refuse("The element has no area.");
        if (normal.z() > 0)
          raw.triangles.push_back({ a, b, c });
        else
          raw.triangles.push_back({ a, c, b });
      };
      if (n == 3)
        add(v[0], v[1], v[2]);
      else if ((raw.nodes[v[0]] - raw.nodes[v[2]]).norm() <= (raw.nodes[v[1]] - raw.nodes[v[3]]).norm())
        {
          add(v[0], v[1], v[2]);
          add(v[0], v[2], v[3]);
        }
      else
        {
          add(v[0], v[1], v[3]);
          add(v[1], v[2], v[3]);
        }
    }

    void
    read_nodes(Lines &lines, Raw &raw)
    {
      lines.demand_next("the number of nodes");
      const auto head = lines.numbers(1, "the head of the nodes");
      if (!raw.new_format)
        {
          for (std::size_t n = lines.count(head[0], "nodes"); n > 0; --n)
            {
              lines.demand_next("a node");
              const auto x = lines.numbers(4, "a node");
              add_node(lines, raw, tag(lines, x[0]), { x[1], x[2], x[3] });
            }
          return;
        }
      for (std::size_t block = lines.count(head[0], "blocks of nodes"); block > 0; --block)
        {
          lines.demand_next("a block of nodes");
          const auto                block_head = lines.numbers(4, "the head of a block of nodes");
          const std::size_t         n          = lines.count(block_head[3], "nodes");
          std::vector<std::int64_t> tags;
          for (std::size_t k = 0; k < n; ++k)
            {
              lines.demand_next("the number of a node");
              tags.push_back(tag(lines, lines.numbers(1, "the number of a node")[0]));
            }
          for (std::size_t k = 0; k < n; ++k)
            {
              lines.demand_next("a node");
              const auto x = lines.numbers(3, "a node");
              add_node(lines, raw, tags[k], { x[0], x[1], x[2] });
            }
        }
    }

    void
    read_elements(Lines &lines, Raw &raw)
    {
      lines.demand_next("the number of elements");
      const auto head = lines.numbers(1, "the head of the elements");
      if (!raw.new_format)
        {
          for (std::size_t n = lines.count(head[0], "elements"); n > 0; --n)
            {
              lines.demand_next("an element");
              const auto e = lines.numbers(3, "an element");
              add_element(lines, raw, static_cast<int>(tag(lines, e[1])), e, 3 + lines.count(e[2], "tags"));
            }
          return;
        }
      for (std::size_t block = lines.count(head[0], "blocks of elements"); block > 0; --block)
        {
          lines.demand_next("a block of elements");
          const auto block_head = lines.numbers(4, "the head of a block of elements");
          for (std::size_t n = lines.count(block_head[3], "elements"); n > 0; --n)
            {
              lines.demand_next("an element");
              add_element(lines, raw, static_cast<int>(tag(lines, block_head[2])), lines.numbers(1, "an element"), 1);
            }
        }
    }

    Raw
    read_sections(Lines &lines)
    {
      Raw  raw;
      bool has_format = false;
      while (lines.next())
        {
          const std::string section = lines.text;
          if (section.empty())
            continue;
          if (section[0] != '$' || section.rfind("$End", 0) == 0)
            lines.refuse("A section should begin here.", "'" + section.substr(0, 40) + "'", "for example $Nodes",
                         "Is it a Gmsh file of version 2.2 or 4.1 in ASCII?");
          if (section == "$MeshFormat")
            {
              lines.demand_next("the version of the format");
              const auto head = lines.numbers(3, "the format");
              if (head[0] != 2.2 && head[0] != 4.1)
                lines.refuse("This version of the format is not read.", std::to_string(head[0]), "2.2 or 4.1");
              if (head[1] != 0)
                lines.refuse("Binary files are not read.", "", "", "Save as ASCII.");
              raw.new_format = head[0] == 4.1;
              has_format     = true;
            }
          else if ((section == "$Nodes" || section == "$Elements") && !has_format)
            lines.refuse("The section $MeshFormat must come first.");
          else if (section == "$Nodes")
            read_nodes(lines, raw);
          else if (section == "$Elements")
            read_elements(lines, raw);
          const std::string end = "$End" + section.substr(1);
          for (lines.demand_next(end); lines.text != end; lines.demand_next(end))
            if (section == "$Nodes" || section == "$Elements" || section == "$MeshFormat")
              lines.refuse("The section is longer than its head says.", "", end);
        }
      if (raw.triangles.empty())
        lines.refuse("The file has no triangles or quadrangles.");
      return raw;
    }

    /// Nodes of triangles only, in the unit mm, at z = 0.
    BlankMesh
    compress(const Raw &raw, const double length_unit, const std::string &name)
    {
      BlankMesh                    mesh;
      std::map<unsigned, unsigned> number;
      for (const auto &t : raw.triangles)
        {
          std::array<unsigned, 3> image{};
          for (unsigned k = 0; k < 3; ++k)
            {
              const auto found = number.emplace(t[k], static_cast<unsigned>(mesh.nodes.size()));
              if (found.second)
                mesh.nodes.push_back(length_unit * raw.nodes[t[k]]);
              image[k] = found.first->second;
            }
          mesh.triangles.push_back(image);
        }
      Vector3d low = mesh.nodes[0], high = low;
      for (const Vector3d &x : mesh.nodes)
        {
          low  = low.cwiseMin(x);
          high = high.cwiseMax(x);
        }
      const double limit = same_place * (high - low).norm();
      if (high.z() - low.z() > limit)
        throw InputError(
            describe_error("The mesh of a blank must lie in a plane of constant z.", name,
                           "z from " + std::to_string(low.z()) + " to " + std::to_string(high.z()) + " mm"));
      for (Vector3d &x : mesh.nodes)
        {
          x.z() = 0;
          // Exactly on the planes of symmetry.
          if (std::abs(x.x()) < limit)
            x.x() = 0;
          if (std::abs(x.y()) < limit)
            x.y() = 0;
        }
      return mesh;
    }

    void
    check_distances(const BlankMesh &mesh, const std::string &name)
    {
      // Sorted along x, equal places are neighbours within the limit.
      const double          limit = 1e-3 * mesh.smallest_edge();
      std::vector<unsigned> order(mesh.nodes.size());
      for (unsigned i = 0; i < order.size(); ++i)
        order[i] = i;
      std::sort(order.begin(), order.end(),
                [&](const unsigned a, const unsigned b) { return mesh.nodes[a].x() < mesh.nodes[b].x(); });
      // Bins along y keep the comparison short where many nodes have the same x.
      std::map<std::pair<std::int64_t, std::int64_t>, unsigned> seen;
      const auto cell = [&](const double value, const double shift) { return std::llround(value / limit + shift); };
      for (const unsigned node : order)
        for (const double shift_x : { 0., 0.5 })
          for (const double shift_y : { 0., 0.5 })
            {
              const Vector3d &x = mesh.nodes[node];
              // The shift is part of the key, so that the four grids do not mix.
              const auto found = seen.emplace(
                  std::make_pair(4 * cell(x.x(), shift_x) + (shift_x > 0 ? 2 : 0) + (shift_y > 0 ? 1 : 0),
                                 cell(x.y(), shift_y)),
                  node);
              if (!found.second && found.first->second != node)
                throw InputError(describe_error("Two nodes of the mesh lie at the same place.", name,
                                                "(" + std::to_string(x.x()) + ", " + std::to_string(x.y()) + ") mm", "",
                                                "Remove duplicate nodes before saving the mesh."));
            }
    }

    void
    detect_symmetry(BlankMesh &mesh)
    {
      const auto opposite = mesh.opposite_nodes();
      mesh.on_x_plane.assign(mesh.nodes.size(), false);
      mesh.on_y_plane.assign(mesh.nodes.size(), false);
      for (unsigned axis = 0; axis < 2; ++axis)
        {
          const bool one_side
              = std::all_of(mesh.nodes.begin(), mesh.nodes.end(), [&](const Vector3d &x) { return x[axis] >= 0; });
          bool found = false;
          for (std::size_t e = 0; one_side && e < mesh.triangles.size(); ++e)
            for (unsigned k = 0; k < 3; ++k)
              {
                const unsigned a = mesh.triangles[e][k], b = mesh.triangles[e][(k + 1) % 3];
                if (opposite[e][k] < 0 && mesh.nodes[a][axis] == 0 && mesh.nodes[b][axis] == 0)
                  {
                    auto &on_plane = axis == 0 ? mesh.on_x_plane : mesh.on_y_plane;
                    on_plane[a] = on_plane[b] = found = true;
                  }
              }
          if (found)
            mesh.symmetry_factor *= 2;
        }
      mesh.mark_outer_edge();
    }
  } // namespace

  BlankMesh
  read_gmsh(const std::filesystem::path &file, const double length_unit)
  {
    if (!(length_unit > 0))
      throw InputError(describe_error("The unit of length of a mesh must be positive.", file.string(),
                                      std::to_string(length_unit) + " mm", "> 0"));
    Lines     lines(file);
    const Raw raw  = read_sections(lines);
    BlankMesh mesh = compress(raw, length_unit, file.string());
    check_distances(mesh, file.string());
    detect_symmetry(mesh);
    return mesh;
  }
} // namespace tribodraw
