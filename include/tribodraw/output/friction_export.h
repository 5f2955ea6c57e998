#ifndef tribodraw_output_friction_export_h
#define tribodraw_output_friction_export_h

#include <tribodraw/friction_table/coefficient_table.h>

#include <memory>
#include <string>
#include <vector>

namespace tribodraw
{
  /// What a written table is to tell its reader, and how far a fitted formula may be off.
  struct FrictionExportSettings
  {
    std::string name;             ///< of the table, for titles: letters, digits, `_` and `-`
    double      max_error = 0.02; ///< greatest difference of a fitted formula from the table [friction coefficient]
    std::string note;             ///< what was done to the table before (mean over strain)
  };

  /// A file that another program reads the friction coefficient from, in mm, N, MPa, s (tonne).
  class FrictionExport
  {
  public:
    virtual ~FrictionExport() = default;
    static const char *
    kind()
    {
      return "friction export";
    }
    /// What follows the name of the table in the default name of the file, such as `_abaqus.inp`.
    virtual std::string file_ending() const = 0;
    /// Whether the format holds the friction coefficient as a function of strain. If not, text() gets one strain.
    virtual bool
    takes_strain() const
    {
      return false;
    }
    /// Throws InputError if the table cannot be represented (a fit beyond settings.max_error).
    virtual std::string text(const CoefficientTable &table, const FrictionExportSettings &settings) const = 0;
  };

  /// Names of all formats, sorted.
  std::vector<std::string> friction_export_formats();
  /// Throws InputError (with the nearest known name) if there is no such format.
  std::unique_ptr<FrictionExport> make_friction_export(const std::string &format);
} // namespace tribodraw

#endif
