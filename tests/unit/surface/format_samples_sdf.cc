// SDF: layouts of ISO 25178-71 and, for BCR-1.0, of what MountainsMap and Gwyddion write.
#include "format_samples.h"

#include <limits>

namespace format_samples
{
  namespace
  {
    bool
    is_bcr(const std::string &mark)
    {
      return mark.substr(1, 3) == "BCR";
    }

    bool
    is_unsigned(int type)
    {
      return type <= 2;
    }

    template <class T>
    void
    add_heights(Bytes &bytes, const std::string &mark, int type, bool with_missing, int mark_of_missing)
    {
      using Limits         = std::numeric_limits<T>;
      const T not_measured = mark_of_missing == 1 ? not_a_number<T>() : is_bcr(mark) ? Limits::max() : Limits::lowest();
      for (int k = 0; k < ny; ++k)
        for (int ix = 0; ix < nx; ++ix)
          {
            const int iy = is_bcr(mark) ? ny - 1 - k : k; // BCR: first profile at the largest y
            bytes.little(with_missing && missing(ix, iy)
                             ? not_measured
                             : static_cast<T>(height(ix, iy) + (is_unsigned(type) ? 100 : 0)));
          }
    }

    std::string
    binary(const std::string &mark, int type, bool with_missing, int mark_of_missing, const std::string &extra,
           const std::string &trailer)
    {
      Bytes bytes;
      bytes.add(mark).add(std::string("test\0gar\xFF.", 10)); // garbage after the end of the text
      bytes.add("040120100853").add("050320101353");
      if (mark.substr(4) == "-2.0")
        bytes.little<std::uint32_t>(nx).little<std::uint32_t>(ny);
      else
        bytes.little<std::uint16_t>(nx).little<std::uint16_t>(ny);
      bytes.little(2e-6).little(3e-6).little(1e-8).little(1e-9);
      bytes.add(std::string(1, '\0')).add(std::string(1, static_cast<char>(type))).add(std::string(1, '\0'));
      bytes.add(extra);
      switch (type)
        {
        case 0:
          add_heights<std::uint8_t>(bytes, mark, type, with_missing, 0);
          break;
        case 1:
          add_heights<std::uint16_t>(bytes, mark, type, with_missing, 0);
          break;
        case 2:
          add_heights<std::uint32_t>(bytes, mark, type, with_missing, 0);
          break;
        case 3:
          add_heights<float>(bytes, mark, type, with_missing, mark_of_missing);
          break;
        case 4:
          add_heights<std::int8_t>(bytes, mark, type, with_missing, 0);
          break;
        case 5:
          add_heights<std::int16_t>(bytes, mark, type, with_missing, 0);
          break;
        case 6:
          add_heights<std::int32_t>(bytes, mark, type, with_missing, 0);
          break;
        case 7:
          add_heights<double>(bytes, mark, type, with_missing, mark_of_missing);
          break;
        }
      return bytes.add(trailer).text;
    }

    Sample
    make_sample(const std::string &format, const std::string &variant, const std::string &content, bool with_missing,
                int type)
    {
      Sample result{ format, variant, content, {}, expected(with_missing) };
      if (is_unsigned(type))
        for (double &z : result.z)
          z += 100 * 1e-5;
      return result;
    }

    struct TextStyle
    {
      std::string line_end = "\r\n", equals = " = ", bad = "BAD", separator = " ", row_end = "\r\n", tail = "*\r\n";
      bool        lower_case = false, extra_fields = false;
    };

    std::string
    text(const std::string &mark, int type, bool with_missing, const TextStyle &style = {})
    {
      std::string result = mark + style.line_end;
      const auto  field  = [&](std::string name, const std::string &value) {
        if (style.lower_case)
          for (char &c : name)
            c = static_cast<char>(std::tolower(c));
        result += name + style.equals + value + style.line_end;
      };
      field("ManufacID", "test");
      field("CreateDate", "040120100853");
      field("ModDate", "050320101353");
      field("NumPoints", "5");
      field("NumProfiles", "4");
      field("Xscale", "2.0E-6");
      field("Yscale", "3e-006");
      field("Zscale", "+1.0E-8");
      field("Zresolution", "-1");
      field("Compression", "0");
      field("DataType", std::to_string(type));
      field("CheckType", "0");
      if (style.extra_fields)
        {
          field("NumDataSet", "1");
          field("NanPresent", "0");
        }
      result += "*" + style.line_end;
      for (int k = 0; k < ny; ++k)
        for (int ix = 0; ix < nx; ++ix)
          {
            const int iy = is_bcr(mark) ? ny - 1 - k : k;
            result += with_missing && missing(ix, iy) ? style.bad
                                                      : std::to_string(height(ix, iy) + (is_unsigned(type) ? 100 : 0))
                                                            + (type == 3 || type == 7 ? ".0" : "");
            result += ix + 1 < nx ? style.separator : style.row_end;
          }
      return result + style.tail;
    }

    void
    add_text(std::vector<Sample> &samples)
    {
      for (const std::string mark : { "aISO-1.0", "aISO-2.0", "aBCR-1.0", "aBCR-0.0" })
        for (int type = is_bcr(mark) ? 0 : 3; type <= 7; ++type)
          samples.push_back(make_sample("sdf text", mark + " type " + std::to_string(type), text(mark, type, type > 3),
                                        type > 3, type));
      TextStyle unix_style;
      unix_style.line_end = unix_style.row_end = "\n";
      unix_style.equals                        = "=";
      unix_style.bad                           = "bad";
      unix_style.lower_case                    = true;
      // the example of the standard: a trailer that is not XML, and no line end after the last asterisk
      unix_style.tail = "*\n< OperatorName > Tom Jones < / OperatorName >\n*";
      samples.push_back(make_sample("sdf text", "unix", text("aISO-1.0", 7, true, unix_style), true, 7));
      // Gwyddion: more fields, a number a line, nothing after the last
      TextStyle gwyddion;
      gwyddion.line_end = gwyddion.row_end = gwyddion.separator = "\n";
      gwyddion.equals                                           = "   = ";
      gwyddion.tail                                             = "";
      gwyddion.extra_fields                                     = true;
      samples.push_back(make_sample("sdf text", "gwyddion", text("aBCR-0.0", 3, false, gwyddion), false, 3));
      // numbers that mark missing points in the binary form
      TextStyle numbers;
      numbers.bad = "-32768";
      samples.push_back(make_sample("sdf text", "number marks", text("aISO-1.0", 5, true, numbers), true, 5));
      numbers.bad = "-3.402823466e+38";
      samples.push_back(make_sample("sdf text", "float mark", text("aISO-2.0", 3, true, numbers), true, 3));
      // no relation between lines and profiles
      TextStyle wild;
      wild.row_end = "  \r\n\r\n\t";
      wild.tail    = "\t* ignored\r\n";
      samples.push_back(make_sample("sdf text", "blanks", text("aISO-1.0", 6, true, wild), true, 6));
    }
  } // namespace

  std::string
  sdf_binary(const std::string &mark, int type, bool with_missing)
  {
    return binary(mark, type, with_missing, 0, "", "");
  }

  std::vector<Sample>
  sdf_samples()
  {
    std::vector<Sample> samples;
    for (const std::string mark : { "bISO-1.0", "bISO-2.0", "bBCR-1.0" })
      for (int type = is_bcr(mark) ? 0 : 3; type <= 7; ++type)
        for (const bool with_missing : { false, true })
          samples.push_back(make_sample("sdf binary", mark + " type " + std::to_string(type),
                                        sdf_binary(mark, type, with_missing), with_missing, type));
    for (const int type : { 3, 7 })
      samples.push_back(make_sample("sdf binary", "NaN", binary("bISO-2.0", type, true, 1, "", ""), true, type));
    samples.push_back(make_sample("sdf binary", "trailer",
                                  binary("bISO-1.0", 5, true, 0, "", "\r\n*\r\n<Part>1</Part>\r\n*\r\n"), true, 5));
    samples.push_back(make_sample("sdf binary", "olympus",
                                  binary("bISO-1.0", 6, false, 0, std::string("\5\0\0\0\1\0\0\0", 8), ""), false, 6));
    add_text(samples);
    return samples;
  }
} // namespace format_samples
