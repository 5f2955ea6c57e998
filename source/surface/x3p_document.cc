#include "x3p_document.h"

#include <cmath>
#include <pugixml.hpp>

#include "text_tools.h"

namespace tribodraw
{
  namespace
  {
    constexpr const char *main_xml = "main.xml";

    std::string_view
    local_name(const char *name)
    {
      const std::string_view all(name);
      const auto             colon = all.rfind(':');
      return colon == std::string_view::npos ? all : all.substr(colon + 1);
    }

    /// An element and its path, whatever prefix its namespace has.
    class Element
    {
    public:
      Element(const pugi::xml_node &xml, std::string full_path, const ZipArchive &zip)
          : node(xml), path(std::move(full_path)), archive(zip)
      {
      }

      bool
      has(const std::string &name) const
      {
        return static_cast<bool>(find(name));
      }

      Element
      child(const std::string &name) const
      {
        const auto found = find(name);
        if (!found)
          fail("the element `" + name + "` is missing");
        return { found, path + "/" + name, archive };
      }

      /// Text of a child, empty if there is none.
      std::string
      text(const std::string &name) const
      {
        return std::string(trimmed(find(name).text().get()));
      }

      std::size_t
      count(const std::string &name) const
      {
        const std::string value = text(name);
        const auto        n     = parse_count(value);
        if (!n || *n == 0 || *n > 0x7FFFFFFF)
          child(name).fail("not a number of points", "`" + excerpt(value) + "`", "1 to 2147483647");
        return *n;
      }

      double
      number(const std::string &name, double otherwise) const
      {
        const std::string value = text(name);
        if (value.empty())
          return otherwise;
        const auto n = parse_finite(value);
        if (!n)
          child(name).fail("not a finite number", "`" + excerpt(value) + "`");
        return *n;
      }

      [[noreturn]] void
      fail(const std::string &what, const std::string &value = "", const std::string &allowed = "",
           const std::string &hint = "") const
      {
        archive.fail(what, std::string(main_xml) + path, value, allowed, hint);
      }

    private:
      pugi::xml_node
      find(const std::string &name) const
      {
        return node.find_child([&](const pugi::xml_node &c) { return local_name(c.name()) == name; });
      }

      pugi::xml_node    node;
      std::string       path;
      const ZipArchive &archive;
    };

    void
    read_type(const Element &xml, X3pDocument::Axis &axis)
    {
      const std::string type = xml.text("DataType");
      if (type == "I")
        axis.bytes = 2, axis.decode = &decode_to_double<std::int16_t>;
      else if (type == "L")
        axis.bytes = 4, axis.decode = &decode_to_double<std::int32_t>;
      else if (type == "F")
        axis.bytes = 4, axis.decode = &decode_to_double<float>;
      else if (type == "D")
        axis.bytes = 8, axis.decode = &decode_to_double<double>;
      else
        xml.fail("unknown type of the stored numbers", "`" + excerpt(type) + "`", "I, L, F, D");
    }

    X3pDocument::Axis
    read_axis(const Element &xml, bool is_height)
    {
      X3pDocument::Axis axis;
      const std::string type = xml.text("AxisType");
      if (type != "I" && type != "A")
        xml.fail("unknown type of axis", "`" + excerpt(type) + "`", "I, A");
      axis.absolute = type == "A";
      if (is_height && !axis.absolute)
        xml.fail("the height axis must be absolute", "`I`", "A");
      if (!axis.absolute && !xml.has("Increment"))
        xml.fail("an incremental axis needs an increment");
      axis.increment = xml.number("Increment", 1.);
      if (!(axis.increment > 0.))
        xml.child("Increment").fail("the increment is not positive", xml.text("Increment").substr(0, 40));
      axis.offset = xml.number("Offset", 0.);
      if (axis.absolute)
        read_type(xml, axis);
      return axis;
    }

    void
    read_matrix(const Element &record, X3pDocument &document)
    {
      if (!record.has("MatrixDimension"))
        record.fail("the file holds a list of points and no map", "", "MatrixDimension");
      const Element matrix = record.child("MatrixDimension");
      document.nx          = matrix.count("SizeX");
      document.ny          = matrix.count("SizeY");
      document.layers      = matrix.count("SizeZ");
      document.is_inline   = record.has("DataList");
      if (document.is_inline)
        return;
      const Element link = record.child("DataLink");
      document.data      = link.text("PointDataLink");
      document.valid     = link.text("ValidPointsLink");
      document.data_md5  = lower(link.text("MD5ChecksumPointData"));
      document.valid_md5 = lower(link.text("MD5ChecksumValidPoints"));
      if (document.data.empty())
        link.fail("the element `PointDataLink` is missing");
    }

    std::string
    read_remark(const Element &root)
    {
      std::string remark = "X3P";
      if (!root.has("Record2"))
        return remark;
      const Element record = root.child("Record2");
      if (record.has("Instrument"))
        remark = excerpt(record.child("Instrument").text("Manufacturer"), 60) + " "
                 + excerpt(record.child("Instrument").text("Model"), 60);
      return remark + " " + excerpt(record.text("Date"), 30);
    }
  } // namespace

  std::size_t
  X3pDocument::point_bytes() const
  {
    return axes[0].bytes + axes[1].bytes + axes[2].bytes;
  }

  X3pDocument
  read_x3p_document(const std::string &text, const ZipArchive &archive)
  {
    pugi::xml_document xml;
    const auto         result = xml.load_buffer(text.data(), text.size());
    if (!result)
      archive.fail("the description is not well-formed XML (" + std::string(result.description()) + ")",
                   std::string(main_xml) + ", byte " + std::to_string(result.offset));
    if (local_name(xml.document_element().name()) != "ISO5436_2")
      archive.fail("the description is of something else", main_xml, "`" + excerpt(xml.document_element().name()) + "`",
                   "ISO5436_2");
    const Element     root(xml.document_element(), "", archive);
    const Element     first   = root.child("Record1");
    const std::string feature = first.text("FeatureType");
    if (feature != "SUR")
      first.fail("the file does not hold a surface", "FeatureType `" + excerpt(feature) + "`", "SUR");
    X3pDocument   document;
    const Element axes = first.child("Axes");
    document.axes
        = { read_axis(axes.child("CX"), false), read_axis(axes.child("CY"), false), read_axis(axes.child("CZ"), true) };
    document.rotated = axes.has("Rotation");
    document.remark  = read_remark(root);
    read_matrix(root.child("Record3"), document);
    return document;
  }
} // namespace tribodraw
