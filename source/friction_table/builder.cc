#include <tribodraw/base/errors.h>
#include <tribodraw/base/files.h>
#include <tribodraw/base/log.h>
#include <tribodraw/base/parallel.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/base/units.h>
#include <tribodraw/friction_table/builder.h>
#include <tribodraw/material/sheet_material.h>
#include <tribodraw/surface/surface.h>

#include <algorithm>
#include <exception>
#include <sstream>

namespace tribodraw
{
  namespace
  {
    /// Changes whenever the same input would give another table; part of every fingerprint.
    constexpr const char *method_version = "3";

    /// The lines of the named top-level subsections of an effective parameter file.
    std::string
    sections_of(const std::string &effective, const std::vector<std::string> &names)
    {
      std::istringstream in(effective);
      std::string        result;
      bool               inside = false;
      for (std::string line; std::getline(in, line);)
        {
          if (line.rfind("subsection ", 0) == 0)
            inside = std::find(names.begin(), names.end(), line.substr(11)) != names.end();
          if (inside && !line.empty())
            result += line + "\n";
          if (line == "end")
            inside = false;
        }
      return result;
    }

    void
    check_ascending(Parameters &parameters, const std::string &entry, const std::vector<double> &values)
    {
      for (std::size_t i = 1; i < values.size(); ++i)
        if (!(values[i] > values[i - 1]))
          {
            parameters.problem(entry, "value " + std::to_string(i + 1) + " is not greater than the one before it",
                               "an ascending list");
            return;
          }
      if (values.size() < 2 && !parameters.documentation_mode())
        parameters.problem(entry, "the list has less than two values", "at least two values");
    }

    std::function<HeightMap()>
    read_tool_surface(Parameters &parameters, const std::string &zone, std::string &own_zone)
    {
      const auto section    = parameters.section("Tool surface");
      const auto read_zones = !zone.empty() && (parameters.has_section(zone) || parameters.documentation_mode());
      if (!read_zones)
        return read_surface(parameters);
      own_zone                = zone;
      const auto zone_section = parameters.section(zone);
      return read_surface(parameters);
    }
  } // namespace

  FrictionTableAxes
  FrictionTableAxes::read(Parameters &parameters)
  {
    FrictionTableAxes axes;
    axes.pressures = parameters.quantity_list(
        "Pressures", "MPa", Range::positive().usual(1e-3, 2e3), "Solid pressures of the table, ascending.",
        Default{ "0.5, 1, 2, 4, 7, 12, 20, 35, 60, 100 MPa", "from a lightly held flange to the edge radii of deep "
                                                             "drawing; below the first, the limit of zero is known" });
    axes.strains = parameters.quantity_list(
        "Strains", "", Range::between(0, 5), "Equivalent plastic strains of the table, ascending from 0.",
        Default{ "0, 0.02, 0.05, 0.1, 0.2, 0.3, 0.45, 0.65, 0.9",
                 "finer where the sheet hardens fast; to the strains of a deep drawn corner" });
    axes.n_cut_heights  = static_cast<unsigned int>(parameters.integer(
         "Cut heights", Range::between(3, 1000),
         "Number of separations at which flow factors are computed; between them a monotone cubic interpolates.",
         Default{ "16", "error of the flow factors about 0.01, below the scatter between maps of one sheet" }));
    axes.n_curve_points = static_cast<unsigned int>(
        parameters.integer("Curve points", Range::between(16, 100000),
                           "Points over the cut height of contact fraction, film and flattening, which cost little.",
                           Default{ "256", "interpolation errors of the film below 0.1 %" }));
    axes.interpolation_error = parameters.quantity(
        "Interpolation error", "", Range{ 1e-4, 1. },
        "Between the points of the table, contact fraction, mean film over Sq and flow factors shall be nearer than "
        "this to "
        "the model. Pressures, strains and cut heights are added until they are. The error that remains is printed and "
        "stored with the table. 1: nothing is added.",
        Default{ "0.01", "below the scatter between maps of one sheet" });
    axes.max_points = static_cast<unsigned int>(parameters.integer(
        "Largest number of points", Range::between(2, 500),
        "Pressures and strains are added up to this number of each.",
        Default{ "40", "a table of a few megabytes; ploughing at 1,600 points takes half a minute" }));
    check_ascending(parameters, "Pressures", axes.pressures);
    check_ascending(parameters, "Strains", axes.strains);
    if (!axes.strains.empty() && axes.strains.front() != 0. && !parameters.documentation_mode())
      parameters.problem("Strains", "the first strain is " + units::number(axes.strains.front()),
                         "0 as the first value");
    return axes;
  }

  FrictionTableBuilder
  FrictionTableBuilder::read(Parameters &parameters, const std::string &zone)
  {
    FrictionTableBuilder builder;
    builder.zone = zone;
    {
      const auto section = parameters.section("Sheet surface");
      builder.make_sheet = read_surface(parameters);
    }
    builder.make_tool = read_tool_surface(parameters, zone, builder.own_zone);
    {
      const auto section      = parameters.section("Flattening");
      builder.pair.flattening = Flattening::read(parameters);
    }
    {
      const auto section        = parameters.section("Flow factors");
      builder.pair.flow_factors = read_flow_factors(parameters);
    }
    {
      const auto section             = parameters.section("Boundary friction");
      builder.pair.boundary_friction = BoundaryFriction::read(parameters);
    }
    {
      const auto section = parameters.section("Friction table");
      builder.pair.axes  = FrictionTableAxes::read(parameters);
    }
    {
      const auto section = parameters.section("Sheet material");
      builder.material   = std::make_shared<const SheetMaterial>(SheetMaterial::read(parameters));
    }
    const std::string effective = parameters.effective();
    builder.settings            = sections_of(
                   effective, { "Flattening", "Flow factors", "Boundary friction", "Friction table", "Sheet material" });
    builder.surface_settings = sections_of(effective, { "Sheet surface", "Tool surface" });
    return builder;
  }

  const PairDescription &
  FrictionTableBuilder::make_maps()
  {
    if (!have_maps)
      {
        pair.sheet     = make_sheet();
        pair.tool      = make_tool();
        pair.hardening = std::shared_ptr<const HardeningLaw>(material, &material->hardening());
        have_maps      = true;
      }
    return pair;
  }

  std::string
  FrictionTableBuilder::fingerprint()
  {
    make_maps();
    // The surface sections act through the maps alone; maps hold a measured file's content, not its name.
    return hash_text(std::string("friction table ") + method_version + "\n" + pair.sheet.hash() + "\n"
                     + pair.tool.hash() + "\n" + (pair.sheet.periodic ? "periodic\n" : "\n")
                     + pair.flow_factors->fingerprint() + "\n" + settings);
  }

  FrictionTable
  FrictionTableBuilder::build(const std::function<void(double)> &progress)
  {
    FrictionTable table             = build_friction_table(make_maps(), progress);
    table.provenance["program"]     = "tribodraw";
    table.provenance["method"]      = method_version;
    table.provenance["zone"]        = zone;
    table.provenance["settings"]    = surface_settings + settings;
    table.provenance["fingerprint"] = fingerprint();
    return table;
  }

  std::filesystem::path
  FrictionTableBuilder::cached_file(const std::filesystem::path &folder)
  {
    return folder / ("friction_table_" + fingerprint() + ".json");
  }

  FrictionTable
  FrictionTableBuilder::load_or_build(const std::filesystem::path &folder, const std::function<void(double)> &progress)
  {
    const std::filesystem::path file = cached_file(folder);
    // One rank looks, so that all decide alike even if the file appears meanwhile.
    std::string text;
    if (parallel::rank() == 0 && std::filesystem::exists(file))
      {
        try
          {
            const FrictionTable table = FrictionTable::read(file);
            if (table.provenance.value("fingerprint", std::string()) == fingerprint())
              text = table.to_json().dump();
            else
              log::warning("The friction table " + file.string() + " belongs to other input; it is built again.");
          }
        catch (const std::exception &e)
          {
            log::warning(std::string("A kept friction table cannot be used and is built again: ") + e.what());
          }
      }
    parallel::broadcast(text);
    found = !text.empty();
    if (found)
      return FrictionTable::from_json(nlohmann::json::parse(text), file.string());

    const FrictionTable table = build(progress);
    std::string         failure;
    if (parallel::rank() == 0)
      {
        try
          {
            std::filesystem::path csv = file;
            table.write(file, csv.replace_extension(".csv"));
          }
        catch (const std::exception &e)
          {
            failure = e.what();
          }
      }
    parallel::broadcast(failure);
    if (!failure.empty())
      throw InputError(failure);
    return table;
  }
} // namespace tribodraw
