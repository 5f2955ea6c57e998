#ifndef tribodraw_output_friction_inputs_h
#define tribodraw_output_friction_inputs_h

#include <tribodraw/friction_table/builder.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace tribodraw
{
  /// What the friction on a tool comes from.
  struct ToolFriction
  {
    std::string                          tool; ///< its name
    std::shared_ptr<const FrictionTable> table;
    FrictionTableBuilder                *builder = nullptr; ///< none: the table was read from a file
  };

  /// Write what the report shows of it: surfaces.csv (each surface, its processing and height parameters), a section of
  /// the sheet's and of the first tool's surface as sheet_surface.gsf and tool_surface.gsf, and the curves of the first
  /// tool's table as friction_table.csv; of tools with another table as friction_table_of_<tool>.csv. On the first
  /// rank.
  void write_friction_inputs(const std::vector<ToolFriction> &tools, const std::filesystem::path &folder);
} // namespace tribodraw

#endif
