#include <tribodraw/application/task.h>
#include <tribodraw/base/log.h>
#include <tribodraw/base/parallel.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/friction_table/builder.h>
#include <tribodraw/friction_table/scatter.h>

#include <cmath>
#include <filesystem>
#include <sstream>

namespace tribodraw
{
  namespace
  {
    /// Flattening, flow factors and boundary friction of one tool-sheet pair in one table.
    class FrictionTableTask : public Task
    {
    public:
      explicit FrictionTableTask(Parameters &parameters) : builder(FrictionTableBuilder::read(parameters))
      {
        const auto scope = parameters.section("Scatter");
        read_further_maps(parameters);
      }

      std::string
      describe() const override
      {
        return "Friction table of one pair of sheet and tool"
               + (further_maps.empty()
                      ? "."
                      : ", and of " + std::to_string(further_maps.size()) + " further maps of the sheet.");
      }

      void
      run(const RunContext &context) override
      {
        const FrictionTable table = build(builder, "Friction table");
        log::info("Sheet: " + builder.sheet().description);
        log::info("Tool: " + (builder.tool().size() > 0 ? builder.tool().description : std::string("ideally smooth")));
        if (further_maps.empty())
          {
            if (parallel::rank() == 0)
              table.write(context.file("friction_table.json"), context.file("friction_table.csv"));
            return;
          }
        std::vector<FrictionTable> tables{ table };
        for (const std::string &map : further_maps)
          {
            FrictionTableBuilder other = with_other_map(context, map);
            tables.push_back(build(other, "Map " + std::to_string(tables.size() + 1)));
          }
        write_scatter(tables, context);
      }

    private:
      FrictionTableBuilder     builder;
      std::vector<std::string> further_maps; ///< settings that lead to them

      void
      read_further_maps(Parameters &parameters)
      {
        for (const double seed : parameters.quantity_list(
                 "Seeds", "", Range::between(0, 4294967295.),
                 "Seeds of further maps of a generated sheet. friction_table.json is then the mean over all maps, "
                 "friction_table_map_<n>.json are the single tables and scatter.csv their scatter.",
                 Default{ "", "one map" }))
          further_maps.push_back("Sheet surface/Generated/Seed = " + std::to_string(std::llround(seed)));
        {
          std::istringstream list(parameters.text(
              "Files", "Further maps of a measured sheet, separated by commas; read as the first one. See `Seeds`.",
              Default{ "", "one map" }));
          for (std::string file; std::getline(list, file, ',');)
            {
              const auto first = file.find_first_not_of(' '), last = file.find_last_not_of(' ');
              if (first == std::string::npos)
                continue;
              file = file.substr(first, last - first + 1);
              if (!std::filesystem::exists(parameters.base_folder() / file) && !parameters.documentation_mode())
                parameters.problem("Files", "The file `" + file + "` does not exist.");
              further_maps.push_back("Sheet surface/File/Path = " + file);
            }
        }
      }

      static FrictionTable
      build(FrictionTableBuilder &from, const std::string &name)
      {
        Progress      progress(name, 1.);
        FrictionTable table = from.build([&](const double done) { progress.update(done); });
        progress.finish();
        return table;
      }

      /// The same parameter file with another map of the sheet.
      static FrictionTableBuilder
      with_other_map(const RunContext &context, const std::string &setting)
      {
        std::vector<std::string> settings = context.settings;
        settings.push_back(setting);
        Parameters           parameters = Parameters::from_file(context.parameter_file, settings);
        FrictionTableBuilder other      = FrictionTableBuilder::read(parameters);
        if (parameters.has_problems())
          parameters.finish(); // tells them
        return other;
      }

      static void
      write_scatter(const std::vector<FrictionTable> &tables, const RunContext &context)
      {
        const FrictionTable mean = mean_friction_table(tables);
        if (parallel::rank() != 0)
          return;
        for (std::size_t i = 0; i < tables.size(); ++i)
          {
            const std::string name = "friction_table_map_" + std::to_string(i + 1);
            tables[i].write(context.file(name + ".json"), context.file(name + ".csv"));
          }
        mean.write(context.file("friction_table.json"), context.file("friction_table.csv"));
        friction_table_scatter(tables).save(context.file("scatter.csv"));
      }
    };
  } // namespace

  TRIBODRAW_REGISTER(Task, FrictionTableTask, "friction table",
                     "Flattening, flow factors and boundary friction of one sheet-tool pair over pressure and strain.",
                     "M. Shisode et al., J. Mater. Process. Technol. 2021, doi 10.1016/j.jmatprotec.2020.117035")
} // namespace tribodraw
