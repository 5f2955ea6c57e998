#include <tribodraw/base/errors.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/base/suggest.h>
#include <tribodraw/output/friction_export.h>

namespace tribodraw
{
  std::vector<std::string>
  friction_export_formats()
  {
    std::vector<std::string> names;
    for (const auto &[name, entry] : Registry<FrictionExport>::entries())
      names.push_back(name);
    return names;
  }

  std::unique_ptr<FrictionExport>
  make_friction_export(const std::string &format)
  {
    const auto &entries = Registry<FrictionExport>::entries();
    const auto  at      = entries.find(format);
    if (at == entries.end())
      {
        std::string all;
        for (const auto &name : friction_export_formats())
          all += (all.empty() ? "" : ", ") + name;
        const std::string near = nearest(format, friction_export_formats());
        throw InputError(describe_error("Unknown format of the export.", "tribodraw export, --format",
                                        "'" + format + "'", all, near.empty() ? "" : "Did you mean '" + near + "'?"));
      }
    Parameters none = Parameters::from_text("", "export");
    return at->second.create(none);
  }
} // namespace tribodraw
