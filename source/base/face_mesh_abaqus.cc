// Abaqus keywords reference guide: input syntax rules, *NODE, *ELEMENT, *ELSET, *PART, *INSTANCE, *INCLUDE.
#include "face_mesh_reading.h"

#include <tribodraw/base/errors.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>

namespace tribodraw::face_mesh
{
  namespace
  {
    constexpr unsigned deepest_include = 8;
    constexpr unsigned most_includes   = 200;

    /// A keyword line: its name and its options, both in capital letters; values as they stand.
    struct Keyword
    {
      std::string                        name;
      std::map<std::string, std::string> options;

      std::string
      option(const std::string &key) const
      {
        const auto found = options.find(key);
        return found == options.end() ? "" : found->second;
      }
    };

    enum class Kind
    {
      triangle,
      quadrangle,
      without_area,
      other
    };

    Kind
    kind_of(const std::string &type)
    {
      static const std::set<std::string> triangles{ "S3",   "S3R", "S3RS",   "S3T",  "S3RT", "STRI3", "R3D3",
                                                    "M3D3", "DS3", "SFM3D3", "CPS3", "CPE3", "CPS3T", "CPE3T" };
      static const std::set<std::string> quadrangles{ "S4",   "S4R",  "S4RS",  "S4RSW", "S4R5",   "S4T",
                                                      "S4RT", "R3D4", "M3D4",  "M3D4R", "SFM3D4", "SFM3D4R",
                                                      "DS4",  "CPS4", "CPS4R", "CPE4",  "CPE4R" };
      if (triangles.count(type) > 0)
        return Kind::triangle;
      if (quadrangles.count(type) > 0)
        return Kind::quadrangle;
      for (const char *begin : { "MASS", "ROTARYI", "T2D", "T3D", "B2", "B3", "SPRING", "DASHPOT", "CONN", "R2D2",
                                 "RB2D2", "RB3D2", "HEATCAP", "PIPE" })
        if (type.rfind(begin, 0) == 0)
          return Kind::without_area;
      return Kind::other;
    }

    /// A part, or what stands outside of all parts.
    struct Part
    {
      std::string                                      name;
      Block                                            block;
      std::vector<std::string>                         sets;  ///< names that elements are given with
      std::map<std::string, std::vector<std::int64_t>> lists; ///< element sets, by name in capitals
      std::string                                      other; ///< type and place of the first element that is not read

      /// Names of sets of *ELEMENT get an index; 0 is none.
      unsigned
      set_index(const std::string &set)
      {
        if (set.empty())
          return 0;
        const auto found = std::find(sets.begin(), sets.end(), set);
        if (found != sets.end())
          return static_cast<unsigned>(found - sets.begin()) + 1;
        sets.push_back(set);
        return static_cast<unsigned>(sets.size());
      }
    };

    struct Instance
    {
      std::string     name;
      Part           *part     = nullptr;
      Eigen::Affine3d position = Eigen::Affine3d::Identity();
      /// Sets of the assembly with elements of this instance.
      std::map<std::string, std::vector<std::int64_t>> lists;
    };

    class Reader
    {
    public:
      explicit Reader(const std::filesystem::path &file) : root(file)
      {
        outside = open->part;
        read(file, 0);
      }

      FaceMesh choose(const std::string &wanted) const;

    private:
      /// What node, element and set lines belong to at the moment.
      struct Scope
      {
        Part     *part     = nullptr;
        Instance *instance = nullptr;
      };

      Part *
      new_part(const std::string &name)
      {
        parts.push_back(std::make_unique<Part>());
        parts.back()->name = name;
        return parts.back().get();
      }

      std::filesystem::path                  root;
      std::vector<std::unique_ptr<Part>>     parts;
      std::vector<std::unique_ptr<Instance>> instances;
      std::unique_ptr<Scope>                 open       = std::make_unique<Scope>(Scope{ new_part(""), nullptr });
      Part                                  *outside    = nullptr;
      unsigned                               n_includes = 0;

      void    read(const std::filesystem::path &file, unsigned depth);
      Keyword read_keyword(Text &text) const;
      void    handle(Text &text, const Keyword &keyword, unsigned depth);
      void    read_nodes(Text &text, const Keyword &keyword);
      void    read_elements(Text &text, const Keyword &keyword);
      void    read_set(Text &text, const Keyword &keyword);
      void    begin_instance(Text &text, const Keyword &keyword);
      void    refuse_other(const Part &part) const;
      void    append_chosen(FaceMesh &mesh, const Part &part, const Instance *instance, const std::string &set) const;
    };

    bool
    is_comment(const std::string_view line)
    {
      return line.size() >= 2 && line[0] == '*' && line[1] == '*';
    }

    bool
    is_keyword(const std::string_view line)
    {
      const auto text = trimmed(line);
      return !text.empty() && text[0] == '*' && !is_comment(text);
    }

    /// The next line of data; false before the next keyword and at the end.
    bool
    next_data(Text &text)
    {
      while (text.next())
        {
          if (is_keyword(text.line()))
            {
              text.step_back();
              return false;
            }
          if (!is_comment(trimmed(text.line())) && !trimmed(text.line()).empty())
            return true;
        }
      return false;
    }

    std::string
    without_quotes(std::string_view value)
    {
      if (value.size() >= 2 && value.front() == '"' && value.back() == '"')
        value = value.substr(1, value.size() - 2);
      return std::string(value);
    }

    /// The present line and those that continue it after a comma at the end.
    Keyword
    Reader::read_keyword(Text &text) const
    {
      std::string whole(trimmed(text.line()));
      while (whole.back() == ',')
        {
          do
            if (!text.next())
              return {};
          while (is_comment(trimmed(text.line())));
          const auto more = trimmed(text.line());
          if (more.empty() || more[0] == '*')
            text.refuse("A keyword ends with a comma, but is not continued.");
          whole += more;
        }
      Keyword keyword;
      bool    first = true;
      for (const auto word : split(whole, ','))
        {
          const std::size_t equal = word.find('=');
          std::string       key   = upper(trimmed(word.substr(0, equal)));
          if (first)
            keyword.name = key;
          else
            keyword.options[key]
                = equal == std::string_view::npos ? "" : without_quotes(trimmed(word.substr(equal + 1)));
          first = false;
        }
      return keyword;
    }

    void
    Reader::read_nodes(Text &text, const Keyword &keyword)
    {
      const std::string system = upper(keyword.option("SYSTEM"));
      if (keyword.options.count("INPUT") > 0 || (!system.empty() && system != "R"))
        text.refuse("Nodes from another file or in another system of coordinates are not read.", "", "Cartesian nodes");
      while (next_data(text))
        {
          const auto      fields = split(text.line(), ',');
          Eigen::Vector3d x(0, 0, 0); // missing coordinates are zero
          for (unsigned k = 0; k < 3 && k + 1 < fields.size(); ++k)
            if (!fields[k + 1].empty())
              x[k] = text.real(fields[k + 1]);
          open->part->block.add_node(text, text.whole(fields.empty() ? "" : fields[0]), x);
        }
    }

    void
    Reader::read_elements(Text &text, const Keyword &keyword)
    {
      if (keyword.options.count("INPUT") > 0)
        text.refuse("Elements from another file are not read.", "", "", "Use *INCLUDE.");
      const std::string type = upper(keyword.option("TYPE"));
      const Kind        kind = kind_of(type);
      if (kind == Kind::without_area)
        return;
      Part &part = *open->part;
      if (kind == Kind::other)
        {
          if (part.other.empty())
            part.other = "'" + type.substr(0, 20) + "', " + text.place();
          return;
        }
      const unsigned    set = part.set_index(keyword.option("ELSET"));
      const std::size_t n   = kind == Kind::triangle ? 3 : 4;
      while (next_data(text))
        {
          const auto fields = split(text.line(), ',');
          if (fields.size() != n + 1)
            text.refuse("The element has a wrong number of nodes.",
                        std::to_string(fields.empty() ? 0 : fields.size() - 1), std::to_string(n) + " for " + type);
          std::array<std::int64_t, 4> corners{ Face::none, Face::none, Face::none, Face::none };
          for (std::size_t k = 0; k < n; ++k)
            corners[k] = text.whole(fields[k + 1]);
          part.block.add_face(text, text.whole(fields[0]), corners, set);
        }
    }

    void
    Reader::read_set(Text &text, const Keyword &keyword)
    {
      const std::string name = upper(keyword.option("ELSET"));
      if (name.empty())
        text.refuse("A set needs a name.", "", "*ELSET, ELSET=name");
      auto             *lists    = &open->part->lists;
      const std::string instance = keyword.option("INSTANCE");
      if (!instance.empty())
        {
          const auto found = std::find_if(instances.begin(), instances.end(),
                                          [&](const auto &i) { return upper(i->name) == upper(instance); });
          if (found == instances.end())
            text.refuse("The instance does not exist.", "'" + instance + "'");
          lists = &(*found)->lists;
        }
      auto      &list     = (*lists)[name];
      const bool generate = keyword.options.count("GENERATE") > 0;
      while (next_data(text))
        {
          const auto fields = split(text.line(), ',');
          if (generate)
            {
              if (fields.size() < 2)
                text.refuse("A set with GENERATE needs the first and the last number.");
              const std::int64_t first = text.whole(fields[0]), last = text.whole(fields[1]),
                                 step = fields.size() > 2 ? text.whole(fields[2]) : 1;
              if (step < 1 || last < first || (last - first) / step > std::int64_t(most_faces))
                text.refuse("These numbers make no set.");
              for (std::int64_t e = first; e <= last; e += step)
                list.push_back(e);
            }
          else
            for (const auto field : fields)
              {
                if (!field.empty() && (field[0] < '0' || field[0] > '9'))
                  {
                    const auto other = lists->find(upper(without_quotes(field)));
                    if (other != lists->end() && other->first != name)
                      list.insert(list.end(), other->second.begin(), other->second.end());
                  }
                else if (!field.empty())
                  list.push_back(text.whole(field));
                if (list.size() > 2 * most_faces)
                  text.refuse("The set is too large.");
              }
        }
    }

    void
    Reader::begin_instance(Text &text, const Keyword &keyword)
    {
      instances.push_back(std::make_unique<Instance>());
      Instance &instance     = *instances.back();
      instance.name          = keyword.option("NAME");
      const std::string name = keyword.option("PART");
      for (const auto &part : parts)
        if (!part->name.empty() && upper(part->name) == upper(name))
          instance.part = part.get();
      if (!instance.part)
        {
          if (!name.empty())
            text.refuse("The instance belongs to a part that does not exist.", "'" + name + "'");
          instance.part = new_part(""); // its mesh stands inside
        }
      // A translation, and a rotation about an axis given by two points, by an angle in degrees.
      Eigen::Affine3d shift = Eigen::Affine3d::Identity(), turn = Eigen::Affine3d::Identity();
      if (next_data(text))
        {
          const auto      fields = split(text.line(), ',');
          Eigen::Vector3d x(0, 0, 0);
          for (unsigned k = 0; k < 3 && k < fields.size(); ++k)
            x[k] = fields[k].empty() ? 0. : text.real(fields[k]);
          shift.translate(x);
          if (next_data(text))
            {
              const auto r = split(text.line(), ',');
              if (r.size() != 7)
                text.refuse("The rotation of an instance needs seven numbers.", std::to_string(r.size()));
              std::array<double, 7> v{};
              for (unsigned k = 0; k < 7; ++k)
                v[k] = text.real(r[k]);
              const Eigen::Vector3d a(v[0], v[1], v[2]), axis = Eigen::Vector3d(v[3], v[4], v[5]) - a;
              if (!(axis.norm() > 0))
                text.refuse("The two points of the axis of rotation are the same.");
              turn = Eigen::Translation3d(a) * Eigen::AngleAxisd(v[6] * M_PI / 180, axis.normalized())
                     * Eigen::Translation3d(-a);
            }
        }
      instance.position = turn * shift;
      open->part        = instance.part;
      open->instance    = &instance;
    }

    void
    Reader::handle(Text &text, const Keyword &keyword, const unsigned depth)
    {
      if (keyword.name == "*NODE")
        read_nodes(text, keyword);
      else if (keyword.name == "*ELEMENT")
        read_elements(text, keyword);
      else if (keyword.name == "*ELSET")
        read_set(text, keyword);
      else if (keyword.name == "*PART")
        {
          if (keyword.option("NAME").empty())
            text.refuse("A part needs a name.");
          open->part = new_part(keyword.option("NAME"));
        }
      else if (keyword.name == "*END PART" || keyword.name == "*END INSTANCE")
        *open = Scope{ outside, nullptr };
      else if (keyword.name == "*INSTANCE")
        begin_instance(text, keyword);
      else if (keyword.name == "*INCLUDE")
        {
          const std::string name = keyword.option("INPUT");
          if (depth >= deepest_include || ++n_includes > most_includes)
            text.refuse("Files include each other too often.", name,
                        "at most " + std::to_string(deepest_include) + " levels, " + std::to_string(most_includes)
                            + " files");
          std::filesystem::path file = root.parent_path() / name;
          if (!std::filesystem::is_regular_file(file))
            file = text.path().parent_path() / name;
          if (name.empty() || !std::filesystem::is_regular_file(file))
            text.refuse("The included file does not exist.", "'" + name + "'");
          read(file, depth + 1);
        }
      else if (keyword.name == "*NGEN" || keyword.name == "*NFILL" || keyword.name == "*NCOPY"
               || keyword.name == "*NMAP" || keyword.name == "*ELGEN" || keyword.name == "*ELCOPY"
               || keyword.name == "*SYSTEM" || keyword.name == "*PARAMETER")
        text.refuse("This keyword is not understood, and the mesh depends on it.", keyword.name, "",
                    "Write the model with all its nodes and elements.");
    }

    void
    Reader::read(const std::filesystem::path &file, const unsigned depth)
    {
      Text text(file);
      while (text.next())
        if (is_keyword(text.line()))
          handle(text, read_keyword(text), depth);
    }

    void
    Reader::refuse_other(const Part &part) const
    {
      if (!part.other.empty())
        throw InputError(
            describe_error("The model has elements that are not read.", root.string(), part.other,
                           "triangles and quadrangles of first order (S3, S3R, S4, S4R, R3D3, R3D4, M3D3, ...)",
                           "Name the part of the faces that are meant, or save it alone."));
    }

    void
    Reader::append_chosen(FaceMesh &mesh, const Part &part, const Instance *instance, const std::string &set) const
    {
      const auto position = instance ? instance->position : Eigen::Affine3d::Identity();
      if (set.empty())
        {
          refuse_other(part);
          return part.block.append_to(mesh, position, [](const Face &) { return true; });
        }
      std::set<unsigned> index;
      for (unsigned k = 0; k < part.sets.size(); ++k)
        if (upper(part.sets[k]) == set)
          index.insert(k + 1);
      std::set<std::int64_t> elements;
      const auto             take = [&](const auto &lists) {
        const auto list = lists.find(set);
        if (list != lists.end())
          elements.insert(list->second.begin(), list->second.end());
      };
      take(part.lists);
      if (instance)
        take(instance->lists);
      part.block.append_to(mesh, position, [&](const Face &face) {
        return index.count(face.part) > 0 || elements.count(face.element) > 0;
      });
    }

    FaceMesh
    Reader::choose(const std::string &wanted) const
    {
      FaceMesh mesh;
      mesh.name             = root.string();
      const std::string set = upper(wanted);
      // Each placed part: a part without an instance is not in the model, unless the file has no assembly.
      struct Placed
      {
        const Part     *part;
        const Instance *instance;
      };
      std::vector<Placed>   placed;
      std::set<std::string> known;
      for (const auto &instance : instances)
        placed.push_back({ instance->part, instance.get() });
      for (const auto &part : parts)
        if (instances.empty() || part.get() == outside)
          placed.push_back({ part.get(), nullptr });
      bool found = wanted.empty();
      for (const auto &[part, instance] : placed)
        {
          const bool whole = wanted.empty() || (!part->name.empty() && upper(part->name) == set)
                             || (instance && upper(instance->name) == set);
          const std::size_t before = mesh.triangles.size();
          append_chosen(mesh, *part, instance, whole ? "" : set);
          found = found || whole || mesh.triangles.size() > before;
          if (!part->name.empty())
            known.insert(part->name);
          if (instance)
            known.insert(instance->name);
          known.insert(part->sets.begin(), part->sets.end());
          for (const auto &list : part->lists)
            known.insert(list.first);
        }
      if (!found)
        refuse_part(root, wanted, { known.begin(), known.end() });
      return mesh;
    }
  } // namespace

  FaceMesh
  read_abaqus(const std::filesystem::path &file, const std::string &part)
  {
    return Reader(file).choose(part);
  }
} // namespace tribodraw::face_mesh
