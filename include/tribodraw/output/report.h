#ifndef tribodraw_output_report_h
#define tribodraw_output_report_h

#include <filesystem>

namespace tribodraw
{
  /// Write `report.html` into an output folder from the files in it: key figures, figures, warnings, the parameters
  /// with their units, versions and how to cite. One self-contained page (inline style and SVG, no script, no network),
  /// light and dark, that also prints. Files that are missing are left out, so a running case can be reported on.
  void write_report(const std::filesystem::path &folder);
} // namespace tribodraw

#endif
