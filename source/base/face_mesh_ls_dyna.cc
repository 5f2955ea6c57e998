// LS-DYNA keyword manual, volume I: general card format, *INCLUDE, *NODE, *ELEMENT_SHELL, *PART.
#include "face_mesh_reading.h"

#include <tribodraw/base/errors.h>

#include <algorithm>
#include <map>

namespace tribodraw::face_mesh
{
  namespace
  {
    constexpr unsigned deepest_include = 8;
    constexpr unsigned most_includes   = 200;

    /// Width of the fields of a card.
    enum class Format
    {
      standard, ///< numbers of 8 columns, coordinates of 16
      i10,      ///< numbers of 10 columns
      wide      ///< 20 columns each ("long")
    };

    class Reader
    {
    public:
      explicit Reader(const std::filesystem::path &file) : root(file) { read(file, 0); }

      FaceMesh choose(const std::string &part) const;

    private:
      std::filesystem::path               root;
      Block                               block;
      std::map<std::int64_t, std::string> titles;      ///< of parts
      std::string                         with_volume; ///< where the first solid elements stand
      Format                              general    = Format::standard;
      unsigned                            n_includes = 0;

      void read(const std::filesystem::path &file, unsigned depth);
      void read_nodes(Text &text, Format format);
      void read_shells(Text &text, Format format, unsigned further_cards);
      void read_parts(Text &text);
      void read_includes(Text &text, unsigned depth);
    };

    bool
    is_keyword(const std::string_view line)
    {
      return !line.empty() && line[0] == '*';
    }

    /// The next line of data, comments passed over; false before the next keyword and at the end.
    bool
    next_card(Text &text)
    {
      while (text.next())
        {
          if (is_keyword(text.line()))
            {
              text.step_back();
              return false;
            }
          if (!(text.line().size() > 0 && text.line()[0] == '$') && !trimmed(text.line()).empty())
            return true;
        }
      return false;
    }

    /// Fields of a card: columns of the given widths, or between commas.
    std::vector<std::string_view>
    fields(const std::string_view line, const std::vector<unsigned> &widths)
    {
      if (line.find(',') != std::string_view::npos)
        return split(line, ',');
      std::vector<std::string_view> result;
      std::size_t                   at = 0;
      for (const unsigned width : widths)
        {
          result.push_back(at < line.size() ? trimmed(line.substr(at, width)) : std::string_view());
          at += width;
        }
      return result;
    }

    std::string_view
    field(const std::vector<std::string_view> &card, const std::size_t k)
    {
      return k < card.size() ? card[k] : std::string_view();
    }

    void
    Reader::read_nodes(Text &text, const Format format)
    {
      const std::vector<unsigned> widths = format == Format::wide  ? std::vector<unsigned>{ 20, 20, 20, 20 }
                                           : format == Format::i10 ? std::vector<unsigned>{ 10, 16, 16, 16 }
                                                                   : std::vector<unsigned>{ 8, 16, 16, 16 };
      while (next_card(text))
        {
          const auto      card = fields(text.line(), widths);
          Eigen::Vector3d x(0, 0, 0); // empty fields are zero
          for (unsigned k = 0; k < 3; ++k)
            if (!field(card, k + 1).empty())
              x[k] = text.real(card[k + 1]);
          block.add_node(text, text.whole(field(card, 0)), x);
        }
    }

    void
    Reader::read_shells(Text &text, const Format format, const unsigned further_cards)
    {
      const std::vector<unsigned> widths(10, format == Format::wide ? 20 : format == Format::i10 ? 10 : 8);
      while (next_card(text))
        {
          const auto                  card    = fields(text.line(), widths);
          const std::int64_t          element = text.whole(field(card, 0)), part = text.whole(field(card, 1));
          std::array<std::int64_t, 4> corners{};
          for (unsigned k = 0; k < 4; ++k)
            corners[k] = field(card, k + 2).empty() && k == 3 ? 0 : text.whole(field(card, k + 2));
          for (unsigned k = 4; k < 8; ++k)
            if (!field(card, k + 2).empty() && text.whole(card[k + 2]) != 0)
              text.refuse("Elements of second order are not read.", "element " + std::to_string(element),
                          "3 or 4 nodes");
          if (corners[3] == 0 || corners[3] == corners[2])
            corners[3] = Face::none;
          if (part > std::int64_t(0xffffffff))
            text.refuse("The number of the part is too large.", std::to_string(part));
          block.add_face(text, element, corners, static_cast<unsigned>(part));
          for (unsigned k = 0; k < further_cards; ++k)
            if (!next_card(text))
              text.refuse("The second card of an element is missing.");
        }
    }

    void
    Reader::read_parts(Text &text)
    {
      while (next_card(text))
        {
          const std::string title(trimmed(text.line()));
          if (!next_card(text))
            text.refuse("The card with the number of the part is missing.");
          const unsigned width                                         = general == Format::wide ? 20 : 10;
          titles[text.whole(field(fields(text.line(), { width }), 0))] = title;
        }
    }

    void
    Reader::read_includes(Text &text, const unsigned depth)
    {
      while (next_card(text))
        {
          std::string name(trimmed(text.line()));
          // A name goes on in the next line after " +".
          while (name.size() > 2 && name.compare(name.size() - 2, 2, " +") == 0 && next_card(text))
            name = name.substr(0, name.size() - 2) + std::string(trimmed(text.line()));
          if (depth >= deepest_include || ++n_includes > most_includes)
            text.refuse("Files include each other too often.", name,
                        "at most " + std::to_string(deepest_include) + " levels, " + std::to_string(most_includes)
                            + " files");
          std::filesystem::path file = text.path().parent_path() / name;
          if (!std::filesystem::exists(file))
            file = root.parent_path() / name;
          if (!std::filesystem::is_regular_file(file))
            text.refuse("The included file does not exist.", name, "",
                        "It is searched beside the file that includes it and beside the first file.");
          read(file, depth + 1);
        }
    }

    void
    Reader::read(const std::filesystem::path &file, const unsigned depth)
    {
      Text text(file);
      while (text.next())
        {
          if (!is_keyword(text.line()))
            {
              // Cards of keywords that are passed over. Before the first keyword there are only comments.
              continue;
            }
          const auto  words   = text.words();
          std::string keyword = upper(words[0]);
          Format      format  = general;
          // The width of one keyword's fields: a sign behind it.
          const std::string_view sign = words.size() > 1 ? words[1]
                                        : std::string_view("+-%").find(keyword.back()) < 3
                                            ? words[0].substr(words[0].size() - 1)
                                            : std::string_view();
          if (sign == "+" || sign == "-" || sign == "%")
            {
              format = sign == "+" ? Format::wide : sign == "%" ? Format::i10 : Format::standard;
              if (words.size() == 1)
                keyword.pop_back();
            }
          if (keyword == "*END")
            return;
          if (keyword == "*KEYWORD")
            for (std::size_t k = 1; k < words.size(); ++k)
              {
                const std::string option = upper(words[k]);
                if (option == "LONG=Y" || option == "LONG=K")
                  general = Format::wide;
                else if (option == "I10=Y")
                  general = Format::i10;
              }
          else if (keyword == "*NODE")
            read_nodes(text, format);
          else if (keyword == "*PART")
            read_parts(text);
          else if (keyword == "*INCLUDE")
            read_includes(text, depth);
          else if (keyword.rfind("*INCLUDE", 0) == 0 || keyword.rfind("*NODE_TRANSFORM", 0) == 0
                   || keyword.rfind("*PARAMETER", 0) == 0 || keyword.rfind("*DEFINE_TRANSFORM", 0) == 0)
            text.refuse("This keyword is not understood, and the mesh may depend on it.", keyword, "",
                        "Write the model with its nodes in their final place (LS-PrePost: Save Keyword).");
          else if (keyword.rfind("*ELEMENT_SHELL", 0) == 0)
            {
              const std::string option = keyword.substr(14);
              unsigned          cards  = 0;
              if (option == "_THICKNESS" || option == "_BETA" || option == "_THICKNESS_BETA" || option == "_MCID"
                  || option == "_THICKNESS_MCID" || option == "_OFFSET")
                cards = 1;
              else if (option == "_THICKNESS_OFFSET" || option == "_THICKNESS_BETA_OFFSET" || option == "_BETA_OFFSET")
                cards = 2;
              else if (!option.empty())
                text.refuse("This kind of shell elements is not read.", keyword,
                            "*ELEMENT_SHELL, with THICKNESS, BETA, MCID, OFFSET");
              read_shells(text, format, cards);
            }
          else if ((keyword.rfind("*ELEMENT_SOLID", 0) == 0 || keyword.rfind("*ELEMENT_TSHELL", 0) == 0)
                   && with_volume.empty())
            with_volume = text.place();
        }
    }

    FaceMesh
    Reader::choose(const std::string &part) const
    {
      FaceMesh mesh;
      mesh.name = root.string();
      if (part.empty() && !with_volume.empty())
        throw InputError(describe_error("The model has elements with a volume; only faces are read.", with_volume, "",
                                        "", "Name the part of the faces that are meant."));
      std::map<std::int64_t, std::string> known = titles;
      for (const Face &face : block.faces)
        known.emplace(face.part, std::to_string(face.part));
      std::vector<std::int64_t> wanted;
      std::vector<std::string>  list;
      for (const auto &[number, title] : known)
        {
          list.push_back(title);
          if (std::to_string(number) == part || upper(title) == upper(part))
            wanted.push_back(number);
        }
      if (!part.empty() && wanted.empty())
        refuse_part(root, part, list);
      block.append_to(mesh, Eigen::Affine3d::Identity(), [&](const Face &face) {
        return part.empty() || std::find(wanted.begin(), wanted.end(), std::int64_t(face.part)) != wanted.end();
      });
      return mesh;
    }
  } // namespace

  FaceMesh
  read_ls_dyna(const std::filesystem::path &file, const std::string &part)
  {
    return Reader(file).choose(part);
  }
} // namespace tribodraw::face_mesh
