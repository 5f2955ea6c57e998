#include <tribodraw/base/registry.h>
#include <tribodraw/output/friction_export.h>

namespace tribodraw
{
  class Parameters;

  namespace
  {
    /// The neutral, self-describing form, with provenance.
    class JsonExport : public FrictionExport
    {
    public:
      explicit JsonExport(Parameters &) {}
      std::string
      file_ending() const override
      {
        return "_export.json";
      }
      bool
      takes_strain() const override
      {
        return true;
      }
      std::string
      text(const CoefficientTable &table, const FrictionExportSettings &) const override
      {
        return table.to_json().dump(1, ' ') + "\n";
      }
    };
  } // namespace

  TRIBODRAW_REGISTER(FrictionExport, JsonExport, "json",
                     "Axes with units, values and provenance; read again by this program.", "")
} // namespace tribodraw
