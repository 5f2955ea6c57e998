#include <tribodraw/base/registry.h>
#include <tribodraw/output/friction_export.h>

#include <algorithm>
#include <cstdio>

namespace tribodraw
{
  class Parameters;

  namespace
  {
    std::string
    line(const char *format, const double a, const double b, const double c)
    {
      char text[120];
      std::snprintf(text, sizeof text, format, a, b, c);
      return text;
    }

    /// Keyword *FRICTION: coefficient over slip rate, contact pressure, temperature (left open) and one field variable,
    /// the equivalent plastic strain. The slip rate varies fastest, the field slowest.
    class AbaqusExport : public FrictionExport
    {
    public:
      explicit AbaqusExport(Parameters &) {}
      std::string
      file_ending() const override
      {
        return "_abaqus.inp";
      }
      bool
      takes_strain() const override
      {
        return true;
      }
      std::string
      text(const CoefficientTable &table, const FrictionExportSettings &settings) const override
      {
        const bool  strain = table.strains.size() > 1;
        std::string name   = settings.name;
        std::transform(name.begin(), name.end(), name.begin(), [](const unsigned char c) { return std::toupper(c); });
        std::string result
            = "** Friction table " + settings.name
              + ", made by tribodraw. Units: mm, N, MPa, s.\n"
                "** Columns: friction coefficient, slip rate [mm/s], contact pressure [MPa], temperature";
        result += strain ? ", field 1: equivalent plastic strain\n" : "\n";
        if (!settings.note.empty())
          result += "** " + settings.note + "\n";
        if (strain)
          result += "** Field variable 1 must carry the equivalent plastic strain at the contact nodes.\n";
        result += "*SURFACE INTERACTION, NAME=" + name + "\n*FRICTION, SLIP TOLERANCE=0.005";
        result += strain ? ", DEPENDENCIES=1\n" : "\n";
        for (std::size_t k = 0; k < table.strains.size(); ++k)
          for (std::size_t i = 0; i < table.pressures.size(); ++i)
            for (std::size_t j = 0; j < table.speeds.size(); ++j)
              {
                result += line("%.8g, %.8g, %.8g", table(i, j, k), table.speeds[j], table.pressures[i]);
                result += strain ? line(", , %.8g\n", table.strains[k], 0, 0) : "\n";
              }
        return result;
      }
    };
  } // namespace

  TRIBODRAW_REGISTER(FrictionExport, AbaqusExport, "abaqus",
                     "Surface interaction with *FRICTION over slip rate, pressure and strain (as field variable 1).",
                     "Abaqus keyword *FRICTION")
} // namespace tribodraw
