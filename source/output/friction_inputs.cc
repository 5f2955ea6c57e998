#include <tribodraw/base/csv.h>
#include <tribodraw/base/units.h>
#include <tribodraw/output/friction_inputs.h>
#include <tribodraw/surface/roughness.h>
#include <tribodraw/surface/surface_writer.h>

#include <algorithm>
#include <limits>
#include <set>

namespace tribodraw
{
  namespace
  {
    /// So much of a map is shown.
    constexpr std::size_t section_pixels = 256;

    HeightMap
    section(const HeightMap &map)
    {
      HeightMap part = map;
      part.nx        = std::min(map.nx, section_pixels);
      part.ny        = std::min(map.ny, section_pixels);
      part.periodic  = false;
      part.z.clear();
      for (std::size_t iy = 0; iy < part.ny; ++iy)
        for (std::size_t ix = 0; ix < part.nx; ++ix)
          part.z.push_back(map(ix, iy));
      return part;
    }

    /// A row of surfaces.csv. The numbers are missing if only the table is known.
    void
    add_surface(CsvTable &table, const std::string &name, std::string description, const HeightMap *map)
    {
      std::replace(description.begin(), description.end(), ',', ';'); // no quotes in our CSV
      const double none = std::numeric_limits<double>::quiet_NaN(), um = units::factor("um");
      if (map == nullptr || map->size() == 0)
        return table.add_row({ name, description, none, none, none, none, none, none });
      const Roughness r = roughness(*map);
      table.add_row({ name, description, r.sa / um, r.sq / um, r.ssk, r.sku, r.sp / um, r.sv / um });
    }

    std::string
    described(const FrictionTable &table, const char *map)
    {
      return table.provenance.contains(map) ? table.provenance[map].value("description", "unknown") : "ideally smooth";
    }

    void
    write_surfaces(const std::vector<ToolFriction> &tools, const std::filesystem::path &folder)
    {
      CsvTable              surfaces({ "surface", "description", "sa_um", "sq_um", "ssk", "sku", "sp_um", "sv_um" });
      std::set<std::string> known;
      for (const ToolFriction &t : tools)
        {
          const HeightMap *sheet     = t.builder ? &t.builder->sheet() : nullptr,
                          *tool      = t.builder ? &t.builder->tool() : nullptr;
          const std::string of_sheet = described(*t.table, "sheet_map"), of_tool = described(*t.table, "tool_map");
          if (known.insert("sheet " + of_sheet).second)
            add_surface(surfaces, "sheet", of_sheet, sheet);
          if (known.insert("tool " + of_tool).second)
            add_surface(surfaces, t.tool, of_tool, tool);
        }
      surfaces.save(folder / "surfaces.csv");
    }
  } // namespace

  void
  write_friction_inputs(const std::vector<ToolFriction> &tools, const std::filesystem::path &folder)
  {
    if (tools.empty())
      return;
    write_surfaces(tools, folder);
    if (FrictionTableBuilder *first = tools.front().builder)
      {
        write_gsf(section(first->sheet()), folder / "sheet_surface.gsf");
        if (first->tool().size() > 0)
          write_gsf(section(first->tool()), folder / "tool_surface.gsf");
      }
    std::set<const FrictionTable *> known; // tools with one surface share a table
    std::set<std::string>           written;
    for (const ToolFriction &t : tools)
      {
        if (!known.insert(t.table.get()).second)
          continue;
        nlohmann::json content = t.table->to_json();
        content.erase("provenance"); // names the tool
        if (!written.insert(content.dump()).second)
          continue;
        std::string name = t.tool;
        std::replace(name.begin(), name.end(), ' ', '_');
        t.table->monotone_look_up().save(
            folder / (written.size() == 1 ? "friction_table.csv" : "friction_table_of_" + name + ".csv"));
      }
  }
} // namespace tribodraw
