// Gmsh reference manual, sections "MSH file format" 2.2 and 4.1 (ASCII).
#include "face_mesh_reading.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace tribodraw::face_mesh
{
  namespace
  {
    class Reader
    {
    public:
      explicit Reader(const std::filesystem::path &file) : text(file) {}

      void     read();
      FaceMesh choose(const std::string &part) const;

    private:
      Text                                          text;
      Block                                         block;
      bool                                          new_format = false;
      std::map<std::int64_t, std::string>           names;  ///< of the physical surfaces
      std::map<std::int64_t, std::vector<unsigned>> groups; ///< physical surfaces of each surface (4.1)

      std::vector<double> numbers(std::size_t least, const std::string &what) const;
      std::int64_t        tag(double value) const;
      std::size_t         count(double value, const std::string &what) const;
      void                read_format();
      void                read_names();
      void                read_entities();
      void                read_nodes();
      void                read_elements();
      void                add_element(int type, const std::vector<double> &e, std::size_t first, unsigned group);
    };

    /// The numbers of the line: at least @p least.
    std::vector<double>
    Reader::numbers(const std::size_t least, const std::string &what) const
    {
      std::vector<double> result;
      for (const auto &word : text.words())
        result.push_back(text.real(word));
      if (result.size() < least)
        text.refuse("Too few numbers for " + what + ".", std::to_string(result.size()),
                    "at least " + std::to_string(least));
      return result;
    }

    std::int64_t
    Reader::tag(const double value) const
    {
      if (!(std::abs(value) < 1e15 && value == std::floor(value)))
        text.refuse("A number of a node or element is not a whole number.", std::to_string(value));
      return static_cast<std::int64_t>(value);
    }

    /// A count; each thing counted needs at least two bytes of the file.
    std::size_t
    Reader::count(const double value, const std::string &what) const
    {
      if (!(value >= 0 && value == std::floor(value) && value <= static_cast<double>(text.bytes()) / 2))
        text.refuse("The number of " + what + " does not fit the size of the file.", std::to_string(value));
      return static_cast<std::size_t>(value);
    }

    void
    Reader::read_format()
    {
      text.demand_next("the version of the format");
      const auto head = numbers(3, "the format");
      if (head[0] != 2.2 && head[0] != 4.1)
        text.refuse("This version of the format is not read.", std::to_string(head[0]), "2.2 or 4.1");
      if (head[1] != 0)
        text.refuse("Binary files are not read.", "", "", "Save as ASCII.");
      new_format = head[0] == 4.1;
    }

    void
    Reader::read_names()
    {
      text.demand_next("the number of names");
      for (std::size_t n = count(numbers(1, "the number of names")[0], "names"); n > 0; --n)
        {
          text.demand_next("a name");
          const auto words = text.words();
          if (words.size() < 3)
            text.refuse("A name needs a dimension, a number and a text.");
          const std::string_view line = text.line();
          const std::size_t      from = line.find('"'), to = line.rfind('"');
          if (from == std::string_view::npos || to == from)
            text.refuse("The name stands between no quotation marks.");
          if (text.whole(words[0]) == 2)
            names[text.whole(words[1])] = line.substr(from + 1, to - from - 1);
        }
    }

    void
    Reader::read_entities()
    {
      text.demand_next("the numbers of points, curves, surfaces and volumes");
      const auto  head     = numbers(4, "the head of the entities");
      std::size_t before   = count(head[0], "points") + count(head[1], "curves");
      std::size_t surfaces = count(head[2], "surfaces");
      for (; before > 0; --before)
        text.demand_next("an entity");
      for (; surfaces > 0; --surfaces)
        {
          text.demand_next("a surface");
          const auto        s = numbers(8, "a surface"); // number, two corners of its box, number of groups, groups
          const std::size_t n = count(s[7], "groups");
          if (s.size() < 8 + n)
            text.refuse("Too few numbers for the groups of a surface.");
          for (std::size_t k = 0; k < n; ++k)
            groups[tag(s[0])].push_back(static_cast<unsigned>(std::abs(tag(s[8 + k]))));
        }
      for (std::size_t volumes = count(head[3], "volumes"); volumes > 0; --volumes)
        text.demand_next("a volume");
    }

    void
    Reader::read_nodes()
    {
      text.demand_next("the number of nodes");
      const auto head = numbers(1, "the head of the nodes");
      if (!new_format)
        {
          for (std::size_t n = count(head[0], "nodes"); n > 0; --n)
            {
              text.demand_next("a node");
              const auto x = numbers(4, "a node");
              block.add_node(text, tag(x[0]), { x[1], x[2], x[3] });
            }
          return;
        }
      for (std::size_t blocks = count(head[0], "blocks of nodes"); blocks > 0; --blocks)
        {
          text.demand_next("a block of nodes");
          const auto                block_head = numbers(4, "the head of a block of nodes");
          const std::size_t         n          = count(block_head[3], "nodes");
          std::vector<std::int64_t> tags;
          for (std::size_t k = 0; k < n; ++k)
            {
              text.demand_next("the number of a node");
              tags.push_back(tag(numbers(1, "the number of a node")[0]));
            }
          for (std::size_t k = 0; k < n; ++k)
            {
              text.demand_next("a node");
              const auto x = numbers(3, "a node");
              block.add_node(text, tags[k], { x[0], x[1], x[2] });
            }
        }
    }

    void
    Reader::add_element(const int type, const std::vector<double> &e, const std::size_t first, const unsigned group)
    {
      constexpr int line = 1, triangle = 2, quadrangle = 3, point = 15;
      if (type == line || type == point)
        return;
      if (type != triangle && type != quadrangle)
        text.refuse("Elements of this type are not read.", "Gmsh type " + std::to_string(type),
                    "2 (triangle) and 3 (quadrangle)", "Save a mesh of the surface with elements of first order.");
      const std::size_t n = type == triangle ? 3 : 4;
      if (e.size() != first + n)
        text.refuse("The element has a wrong number of nodes.", std::to_string(e.size() - std::min(first, e.size())),
                    std::to_string(n));
      std::array<std::int64_t, 4> corners{ Face::none, Face::none, Face::none, Face::none };
      for (std::size_t k = 0; k < n; ++k)
        corners[k] = tag(e[first + k]);
      block.add_face(text, tag(e[0]), corners, group);
    }

    void
    Reader::read_elements()
    {
      text.demand_next("the number of elements");
      const auto head = numbers(1, "the head of the elements");
      if (!new_format)
        {
          for (std::size_t n = count(head[0], "elements"); n > 0; --n)
            {
              text.demand_next("an element");
              const auto        e      = numbers(3, "an element");
              const std::size_t n_tags = count(e[2], "tags");
              const unsigned    group  = n_tags > 0 && e.size() > 3 ? static_cast<unsigned>(tag(std::abs(e[3]))) : 0;
              add_element(static_cast<int>(tag(e[1])), e, 3 + n_tags, group);
            }
          return;
        }
      for (std::size_t blocks = count(head[0], "blocks of elements"); blocks > 0; --blocks)
        {
          text.demand_next("a block of elements");
          const auto block_head = numbers(4, "the head of a block of elements");
          for (std::size_t n = count(block_head[3], "elements"); n > 0; --n)
            {
              text.demand_next("an element");
              // The number of the surface stands for its groups.
              add_element(static_cast<int>(tag(block_head[2])), numbers(1, "an element"), 1,
                          static_cast<unsigned>(tag(block_head[1])));
            }
        }
    }

    void
    Reader::read()
    {
      bool has_format = false;
      while (text.next())
        {
          const std::string section(text.line());
          if (section.empty())
            continue;
          if (section[0] != '$' || section.rfind("$End", 0) == 0)
            text.refuse("A section should begin here.", "'" + section.substr(0, 40) + "'", "for example $Nodes",
                        "Is it a Gmsh file of version 2.2 or 4.1 in ASCII?");
          const bool known = section == "$MeshFormat" || section == "$Nodes" || section == "$Elements"
                             || section == "$PhysicalNames" || section == "$Entities";
          if ((section == "$Nodes" || section == "$Elements") && !has_format)
            text.refuse("The section $MeshFormat must come first.");
          if (section == "$MeshFormat")
            {
              read_format();
              has_format = true;
            }
          else if (section == "$Nodes")
            read_nodes();
          else if (section == "$Elements")
            read_elements();
          else if (section == "$PhysicalNames")
            read_names();
          else if (section == "$Entities")
            read_entities();
          const std::string end = "$End" + section.substr(1);
          for (text.demand_next(end); text.line() != end; text.demand_next(end))
            if (known)
              text.refuse("The section is longer than its head says.", "", end);
        }
    }

    FaceMesh
    Reader::choose(const std::string &part) const
    {
      FaceMesh mesh;
      mesh.name = text.path().string();
      // All numbers of physical groups that there are, and the one asked for.
      std::map<std::int64_t, std::string> known = names;
      for (const auto &[surface, of_surface] : groups)
        for (const unsigned group : of_surface)
          known.emplace(group, std::to_string(group));
      if (!new_format)
        for (const Face &face : block.faces)
          if (face.part > 0)
            known.emplace(face.part, std::to_string(face.part));
      std::int64_t wanted = -1;
      for (const auto &[number, name] : known)
        if (upper(name) == upper(part) || std::to_string(number) == part)
          wanted = number;
      if (!part.empty() && wanted < 0)
        {
          std::vector<std::string> list;
          for (const auto &[number, name] : known)
            list.push_back(name);
          refuse_part(text.path(), part, list);
        }
      block.append_to(mesh, Eigen::Affine3d::Identity(), [&](const Face &face) {
        if (part.empty())
          return true;
        if (!new_format)
          return face.part == wanted;
        const auto of_surface = groups.find(face.part);
        return of_surface != groups.end()
               && std::find(of_surface->second.begin(), of_surface->second.end(), wanted) != of_surface->second.end();
      });
      return mesh;
    }
  } // namespace

  FaceMesh
  read_gmsh(const std::filesystem::path &file, const std::string &part)
  {
    Reader reader(file);
    reader.read();
    return reader.choose(part);
  }
} // namespace tribodraw::face_mesh
