#ifndef tribodraw_source_output_report_parts_h
#define tribodraw_source_output_report_parts_h

#include <filesystem>
#include <string>

/// Pieces of report.html as text, each empty if the folder has nothing for it.
namespace tribodraw::report
{
  /// Text as it stands in HTML.
  std::string escape(const std::string &text);
  /// A heading, with an anchor for the list at the top of the page.
  std::string heading(const std::string &title);

  /// The few figures one runs a case for, as tiles; all others are more_results().
  std::string key_figures(const std::filesystem::path &folder);
  std::string more_results(const std::filesystem::path &folder);
  /// What must balance or stay small, with what is usual.
  std::string audits(const std::filesystem::path &folder);
  /// The figure with its caption, empty if the file is not there.
  std::string figure_of_comparison(const std::filesystem::path &svg_file);
  /// Measured against computed curves (compare.csv).
  std::string comparison(const std::filesystem::path &folder);
  /// Surfaces and their processing (surfaces.csv, written by drawings with friction from surfaces).
  std::string surfaces(const std::filesystem::path &folder);
  /// All parameters with their units, by section.
  std::string inputs(const std::filesystem::path &folder);
  /// All figures in groups.
  std::string figures(const std::filesystem::path &folder);
} // namespace tribodraw::report

#endif
