#include <tribodraw/base/registry.h>
#include <tribodraw/output/friction_export.h>

#include <algorithm>
#include <cstdio>
#include <sstream>

namespace tribodraw
{
  class Parameters;

  namespace
  {
    // Numbers of the table and its curves; the user may renumber them with *INCLUDE_TRANSFORM.
    constexpr int table_id = 900001;

    std::string
    fields(const std::initializer_list<double> values)
    {
      std::string result;
      for (const double v : values)
        {
          char text[32];
          std::snprintf(text, sizeof text, "%20.10g", v);
          result += text;
        }
      return result + "\n";
    }

    /// Comment lines; a line may have 80 columns.
    std::string
    comment(const std::string &text)
    {
      std::istringstream words(text);
      std::string        result, line = "$";
      for (std::string word; words >> word;)
        {
          if (line.size() + 1 + word.size() > 80)
            {
              result += line + "\n";
              line = "$";
            }
          line += " " + word;
        }
      return result + line + "\n";
    }

    /// *DEFINE_TABLE of curves mu(sliding velocity), one for each pressure, for FS = 2 and FD = number of the table.
    class LsDynaExport : public FrictionExport
    {
    public:
      explicit LsDynaExport(Parameters &) {}
      std::string
      file_ending() const override
      {
        return "_ls-dyna.k";
      }
      std::string
      text(const CoefficientTable &table, const FrictionExportSettings &settings) const override
      {
        char       number[16];
        const auto id = [&](const int value) {
          std::snprintf(number, sizeof number, "%10d", value);
          return std::string(number);
        };
        std::string result = "*KEYWORD\n";
        result += comment("Friction table " + settings.name + ", made by tribodraw. Units: mm, N, MPa, s (tonne).");
        if (!settings.note.empty())
          result += comment(settings.note);
        result
            += comment("Use: FS = 2.0 and FD = " + std::to_string(table_id)
                       + " on card 2 of *CONTACT_FORMING_ONE_WAY_SURFACE_TO_SURFACE, with the thickness offset option. "
                         "VALUE: pressure; curves: friction coefficient over velocity.");
        result += "*DEFINE_TABLE_TITLE\n" + settings.name.substr(0, 80) + "\n$     tbid       sfa      offa\n"
                  + id(table_id) + "       1.0       0.0\n$              value\n";
        for (const double p : table.pressures)
          result += fields({ p });
        // A curve needs two points; all have the same velocities. The last value is continued.
        std::vector<double> speeds = table.speeds;
        if (speeds.front() > 0)
          speeds.insert(speeds.begin(), 0.);
        speeds.push_back(10. * std::max(1000., speeds.back()));
        for (std::size_t i = 0; i < table.pressures.size(); ++i)
          {
            result
                += "*DEFINE_CURVE\n$     lcid      sidr       sfa       sfo      offa      offo    dattyp     lcint\n"
                   + id(table_id + 1 + static_cast<int>(i))
                   + "         0       1.0       1.0       0.0       0.0         0         0\n"
                     "$                 a1                  o1\n";
            for (const double v : speeds)
              {
                const auto at = std::min<std::size_t>(std::lower_bound(table.speeds.begin(), table.speeds.end(), v)
                                                          - table.speeds.begin(),
                                                      table.speeds.size() - 1);
                result += fields({ v, table(i, at, 0) });
              }
          }
        return result + "*END\n";
      }
    };
  } // namespace

  TRIBODRAW_REGISTER(FrictionExport, LsDynaExport, "ls-dyna",
                     "*DEFINE_TABLE of curves over velocity, one for each pressure, for FS = 2.",
                     "LS-DYNA keyword manual, *CONTACT, FS = 2")
} // namespace tribodraw
