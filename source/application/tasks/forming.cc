#include <tribodraw/application/provenance.h>
#include <tribodraw/application/task.h>
#include <tribodraw/base/log.h>
#include <tribodraw/base/parallel.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/base/units.h>
#include <tribodraw/forming/constant_friction.h>
#include <tribodraw/forming/lubricated_friction.h>
#include <tribodraw/forming/pressure_friction.h>
#include <tribodraw/forming/simulation.h>
#include <tribodraw/friction_table/builder.h>
#include <tribodraw/output/dynain.h>
#include <tribodraw/output/forming_output.h>
#include <tribodraw/output/friction_inputs.h>

#include <algorithm>
#include <map>

namespace tribodraw
{
  namespace
  {
    /// The effective parameters as `Section/Entry = value`, one a line, without what a resumed run may change, and the
    /// contents of the files they name.
    std::string what_must_not_change(const RunContext &context)
    {
      std::string result;
      for (const auto &[path, value] : effective_values(context.effective_parameters))
        if (path.rfind("Solver/", 0) != 0 && path.rfind("Output/", 0) != 0 && path != "Process/Punch travel")
          result += path + " = " + value + "\n";
      for (const auto &[path, hash] : context.input_hashes)
        result += path + " (content of the file) = " + hash + "\n";
      return result;
    }

    /// Deep drawing: blank, material, tools, process; friction constant or lubricated.
    class FormingTask : public Task
    {
    public:
      explicit FormingTask(Parameters &p)
      {
        {
          const auto scope = p.section("Blank");
          blank            = Blank::read(p);
        }
        {
          const auto scope = p.section("Sheet material");
          material         = std::make_shared<SheetMaterial>(SheetMaterial::read(p));
        }
        {
          const auto scope = p.section("Tools");
          tools            = ToolSet::read(p);
        }
        {
          const auto scope = p.section("Process");
          process          = Process::read(p);
        }
        {
          const auto scope = p.section("Solver");
          settings         = SolverSettings::read(p);
        }
        read_friction(p);
        {
          const auto scope = p.section("Forming limit");
          limit            = p.model<FormingLimitCurve>("Model", "Forming limit curve of the sheet.");
        }
        check_process(p, blank, tools, process);
        {
          const auto scope    = p.section("Output");
          travel_between      = p.quantity("Travel between fields", "mm", Range::positive(), "Punch travel between two VTU steps.",
                                           Default{"5 mm", "a dozen steps for a typical part"});
          checkpoint_distance = p.quantity("Travel between checkpoints", "mm", Range::non_negative(), "Punch travel between two checkpoints; 0: none.",
                                           Default{"5 mm", "a checkpoint takes less time than an increment"});
          with_dynain = p.flag("Dynain", "Write the final state as `dynain` (LS-DYNA keywords: nodes, thickness, stresses and strains of the layers), from which "
                                         "programs for springback, trimming or crash go on.",
                               Default{"false", "some 2 kB an element"});
        }
      }

      std::string describe() const override
      {
        std::string names;
        for (const auto &tool : tools.tools)
          names += (names.empty() ? "" : ", ") + tool.name;
        return (process.punch_travel > 0 ? "Deep drawing to " + units::format(process.punch_travel, "mm") + " punch travel" : "Forming for " + units::format(process.duration, "s")) +
               (process.unloading ? " and unloading" : "") + (names.empty() ? "" : " with " + names) + ".";
      }

      bool has_checkpoints() const override { return true; }

      void run(const RunContext &context) override
      {
        Simulation simulation(blank, material, tools, process, settings, make_friction(context));
        simulation.watch_forming_limit(limit);
        simulation.add_observer(std::make_shared<HistoryWriter>(context.output_folder));
        simulation.add_observer(std::make_shared<FieldWriter>(context.output_folder, travel_between, limit));
        simulation.add_observer(std::make_shared<ResultsWriter>(context.output_folder));
        simulation.checkpoint_to(context.output_folder, checkpoint_distance, what_must_not_change(context));
        if (context.resume && !simulation.resume(context.output_folder))
          log::warning("There is no checkpoint in " + context.output_folder.string() + "; the run starts from the beginning.");
        simulation.run();
        if (with_dynain)
          write_dynain(context.output_folder / "dynain", simulation.shell(), "final state of a drawing by tribodraw");
      }

    private:
      std::unique_ptr<FrictionCoupling> make_friction(const RunContext &context)
      {
        if (lubricated)
          return std::make_unique<LubricatedFriction>(friction_tables(context), lubricant, lubrication);
        if (pressure_law)
          return std::make_unique<PressureFriction>(pressure_law);
        if (std::none_of(tools.tools.begin(), tools.tools.end(), [](const ProcessTool &tool) { return tool.friction; }))
          return std::make_unique<ConstantFriction>(friction_coefficient);
        std::vector<double> coefficients;
        for (const auto &tool : tools.tools)
          coefficients.push_back(tool.friction.value_or(friction_coefficient));
        return std::make_unique<ConstantFriction>(coefficients);
      }

      void read_friction(Parameters &p)
      {
        {
          const auto        scope = p.section("Coupling");
          const std::string kind  = p.choice("Friction", {"lubricated", "constant", "pressure law"},
                                             "Where the friction coefficient comes from: lubricated (surfaces, lubricant and process, node by node), constant, or a law of the contact pressure.");
          lubricated              = kind == "lubricated";
          if (kind == "constant" || p.documentation_mode())
            friction_coefficient = p.quantity("Constant friction coefficient", "", Range::non_negative().usual(0, 0.5), "Coulomb coefficient on all tools that have none of their own.");
          else
            p.mark_unselected("Constant friction coefficient");
          if (kind == "pressure law" || p.documentation_mode())
            {
              const auto law_scope = p.section("Pressure law");
              pressure_law         = p.model<PressureFrictionLaw>("Model", "Friction coefficient over contact pressure.");
            }
          else
            p.mark_unselected("Pressure law");
          for (const auto &tool : tools.tools)
            if (tool.friction && kind != "constant" && !p.documentation_mode())
              p.warning("'Tools/" + tool.name + "/Friction coefficient' has no effect with 'Coupling/Friction = " + kind + "'.");
        }
        if (lubricated || p.documentation_mode())
          read_lubrication(p);
        else
          mark_lubrication_unselected(p);
      }

      /// By their names, so that mistyped entries beside them are found.
      static void mark_lubrication_unselected(Parameters &p)
      {
        Parameters known = Parameters::for_documentation();
        LubricationSettings::read(known);
        for (const EntryInfo &entry : known.entries())
          p.mark_unselected(entry.path);
        for (const char *section : {"Lubricant", "Sheet surface", "Tool surface", "Flattening", "Flow factors", "Boundary friction", "Friction table"})
          p.mark_unselected(section);
      }

      void read_lubrication(Parameters &p)
      {
        lubrication = LubricationSettings::read(p);
        {
          const auto scope = p.section("Lubricant");
          lubricant        = Lubricant::read(p);
        }
        std::vector<std::string> zones; // one for each tool, in the order of the tools
        for (const auto &tool : tools.tools)
          zones.push_back(tool.name);
        table_files.resize(zones.size());
        builders.resize(zones.size());
        for (std::size_t zone = 0; zone < zones.size(); ++zone)
          {
            const std::string entry = zones[zone] + " file";
            {
              const auto scope = p.section("Friction table");
              if (p.has(entry))
                table_files[zone] = p.input_file(entry, "friction_table.json of this tool zone; without it the table is built from the surfaces described in this file.");
            }
            if (table_files[zone].empty())
              builders[zone] = std::make_unique<FrictionTableBuilder>(FrictionTableBuilder::read(p, zones[zone]));
          }
      }

      /// The friction table of each tool: read, found in the cache beside the output, or built.
      std::vector<std::shared_ptr<const FrictionTable>> friction_tables(const RunContext &context)
      {
        const std::filesystem::path         cache = context.output_folder.parent_path();
        std::vector<ToolFriction>           inputs;
        std::map<std::string, ToolFriction> made; // tools with one surface share a table
        for (std::size_t zone = 0; zone < builders.size(); ++zone)
          {
            ToolFriction input{ tools.tools[zone].name, nullptr, builders[zone].get() };
            if (input.builder == nullptr)
              input.table = std::make_shared<FrictionTable>(FrictionTable::read(table_files[zone]));
            else if (const auto same = made.find(input.builder->tool_surface_zone()); same != made.end())
              {
                input.table   = same->second.table;
                input.builder = same->second.builder;
              }
            else
              {
                Progress progress("Friction table of the " + input.tool, 1.);
                input.table = std::make_shared<FrictionTable>(input.builder->load_or_build(cache, [&](const double done) { progress.update(done); }));
                progress.finish((input.builder->was_cached() ? "found in " : "kept in ") + input.builder->cached_file(cache).string());
                made[input.builder->tool_surface_zone()] = input;
              }
            inputs.push_back(input);
          }
        if (parallel::rank() == 0)
          write_friction_inputs(inputs, context.output_folder);
        std::vector<std::shared_ptr<const FrictionTable>> tables;
        for (const auto &input : inputs)
          tables.push_back(input.table);
        return tables;
      }

      bool                             lubricated = false;
      LubricationSettings              lubrication;
      Lubricant                        lubricant;
      std::vector<std::filesystem::path>                 table_files; // of each tool
      std::vector<std::unique_ptr<FrictionTableBuilder>> builders;
      std::shared_ptr<const PressureFrictionLaw>         pressure_law;
      Blank                                    blank;
      std::shared_ptr<const SheetMaterial>     material;
      ToolSet                                  tools;
      Process                                  process;
      SolverSettings                           settings;
      double                                   friction_coefficient = 0;
      std::shared_ptr<const FormingLimitCurve> limit;
      double                                   travel_between = 0, checkpoint_distance = 0;
      bool                                     with_dynain = false;
    };
  } // namespace

  TRIBODRAW_REGISTER(Task, FormingTask, "forming", "Deep drawing with a Kirchhoff shell and friction from surfaces, lubricant and process.", "Shisode et al. 2021")
} // namespace tribodraw
