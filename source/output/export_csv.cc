#include <tribodraw/base/registry.h>
#include <tribodraw/output/friction_export.h>

namespace tribodraw
{
  class Parameters;

  namespace
  {
    /// Long form, one operating point a line.
    class CsvExport : public FrictionExport
    {
    public:
      explicit CsvExport(Parameters &) {}
      std::string
      file_ending() const override
      {
        return "_export.csv";
      }
      bool
      takes_strain() const override
      {
        return true;
      }
      std::string
      text(const CoefficientTable &table, const FrictionExportSettings &) const override
      {
        return table.csv().text();
      }
    };
  } // namespace

  TRIBODRAW_REGISTER(FrictionExport, CsvExport, "csv",
                     "One operating point a line: pressure_mpa,speed_mm_per_s,eps_p,mu.", "")
} // namespace tribodraw
