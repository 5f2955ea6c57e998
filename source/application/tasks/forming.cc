#include <tribodraw/application/task.h>
#include <tribodraw/base/log.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/base/units.h>
#include <tribodraw/forming/constant_friction.h>
#include <tribodraw/forming/lubricated_friction.h>
#include <tribodraw/forming/simulation.h>
#include <tribodraw/friction_table/builder.h>
#include <tribodraw/output/forming_output.h>

#include <algorithm>
#include <array>
#include <sstream>

namespace tribodraw
{
  namespace
  {
    /// The effective parameters as `Section/Entry = value`, one a line, without what a resumed run may change.
    std::string what_must_not_change(const std::string &effective)
    {
      std::istringstream       in(effective);
      std::vector<std::string> sections;
      std::string              result;
      for (std::string line; std::getline(in, line);)
        {
          line = line.substr(std::min(line.size(), line.find_first_not_of(' ')));
          if (line.rfind("subsection ", 0) == 0)
            sections.push_back(line.substr(11));
          else if (line == "end")
            sections.pop_back();
          else if (line.rfind("set ", 0) == 0)
            {
              std::string path;
              for (const auto &s : sections)
                path += s + "/";
              std::istringstream words(line.substr(4));
              for (std::string word; words >> word;)
                path += word + " ";
              if (path.rfind("Solver/", 0) != 0 && path.rfind("Output/", 0) != 0 && path.rfind("Process/Punch travel", 0) != 0)
                result += path + "\n";
            }
        }
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
        check_process(p, blank, tools);
        {
          const auto scope    = p.section("Output");
          travel_between      = p.quantity("Travel between fields", "mm", Range::positive(), "Punch travel between two VTU steps.",
                                           Default{"5 mm", "a dozen steps for a typical part"});
          checkpoint_distance = p.quantity("Travel between checkpoints", "mm", Range::non_negative(), "Punch travel between two checkpoints; 0: none.",
                                           Default{"5 mm", "a checkpoint takes less time than an increment"});
        }
      }

      std::string describe() const override
      {
        return "Deep drawing to " + units::format(process.punch_travel, "mm") + " punch travel.";
      }

      void run(const RunContext &context) override
      {
        std::unique_ptr<FrictionCoupling> friction;
        if (lubricated)
          friction = std::make_unique<LubricatedFriction>(friction_tables(context.output_folder.parent_path()), lubricant, lubrication);
        else
          friction = std::make_unique<ConstantFriction>(friction_coefficient);
        Simulation simulation(blank, material, tools, process, settings, std::move(friction));
        simulation.add_observer(std::make_shared<HistoryWriter>(context.output_folder));
        simulation.add_observer(std::make_shared<FieldWriter>(context.output_folder, travel_between, limit));
        simulation.checkpoint_to(context.output_folder, checkpoint_distance, what_must_not_change(context.effective_parameters));
        if (context.resume && !simulation.resume(context.output_folder))
          log::warning("There is no checkpoint in " + context.output_folder.string() + "; the run starts from the beginning.");
        simulation.run();
      }

    private:
      void read_friction(Parameters &p)
      {
        {
          const auto scope = p.section("Coupling");
          lubricated       = p.choice("Friction", {"lubricated", "constant"},
                                      "Where the friction coefficient comes from: lubricated (surfaces, lubricant and process, node by node) or constant.") == "lubricated";
          if (!lubricated || p.documentation_mode())
            friction_coefficient = p.quantity("Constant friction coefficient", "", Range::non_negative().usual(0, 0.5), "Coulomb coefficient on all tools.");
          else
            p.mark_unselected("Constant friction coefficient");
          if (!lubricated)
            p.mark_unselected(""); // what else stands in this section belongs to lubricated friction
        }
        if (lubricated || p.documentation_mode())
          read_lubrication(p);
        else
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
      std::vector<std::shared_ptr<const FrictionTable>> friction_tables(const std::filesystem::path &cache)
      {
        std::vector<std::shared_ptr<const FrictionTable>> tables;
        for (std::size_t zone = 0; zone < zones.size(); ++zone)
          if (builders[zone])
            {
              Progress progress("Friction table of the " + zones[zone], 1.);
              tables.push_back(std::make_shared<FrictionTable>(builders[zone]->load_or_build(cache, [&](const double done) { progress.update(done); })));
              progress.finish(builders[zone]->was_cached() ? "found in " + builders[zone]->cached_file(cache).string() : "kept in " + builders[zone]->cached_file(cache).string());
            }
          else
            tables.push_back(std::make_shared<FrictionTable>(FrictionTable::read(table_files[zone])));
        return tables;
      }

      const std::array<std::string, 3> zones{{"Die", "Punch", "Blank holder"}}; // in the order of ToolSet::Index
      bool                             lubricated = false;
      LubricationSettings              lubrication;
      Lubricant                        lubricant;
      std::array<std::filesystem::path, 3>                 table_files;
      std::array<std::unique_ptr<FrictionTableBuilder>, 3> builders;
      Blank                                    blank;
      std::shared_ptr<const SheetMaterial>     material;
      ToolSet                                  tools;
      Process                                  process;
      SolverSettings                           settings;
      double                                   friction_coefficient = 0;
      std::shared_ptr<const FormingLimitCurve> limit;
      double                                   travel_between = 0, checkpoint_distance = 0;
    };
  } // namespace

  TRIBODRAW_REGISTER(Task, FormingTask, "forming", "Deep drawing with a Kirchhoff shell and friction from surfaces, lubricant and process.", "Shisode et al. 2021")
} // namespace tribodraw
