#include <tribodraw/application/task.h>
#include <tribodraw/base/log.h>
#include <tribodraw/base/parallel.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/base/timing.h>
#include <tribodraw/friction_table/builder.h>

namespace tribodraw
{
  namespace
  {
    /// Flattening, flow factors and boundary friction of one tool-sheet pair in one table.
    class FrictionTableTask : public Task
    {
    public:
      explicit FrictionTableTask(Parameters &parameters) : builder(FrictionTableBuilder::read(parameters)) {}

      std::string
      describe() const override
      {
        return "Friction table of one pair of sheet and tool.";
      }

      void
      run(const RunContext &context) override
      {
        Progress   progress("Friction table", 1.);
        const auto table = [&] {
          const timing::Scope scope("friction_table/build");
          return builder.build([&](const double done) { progress.update(done); });
        }();
        progress.finish();
        log::info("Sheet: " + builder.sheet().description);
        log::info("Tool: " + (builder.tool().size() > 0 ? builder.tool().description : std::string("ideally smooth")));
        if (parallel::rank() == 0)
          table.write(context.file("friction_table.json"), context.file("friction_table.csv"));
      }

    private:
      FrictionTableBuilder builder;
    };
  } // namespace

  TRIBODRAW_REGISTER(Task, FrictionTableTask, "friction table",
                     "Flattening, flow factors and boundary friction of one sheet-tool pair over pressure and strain.",
                     "M. Shisode et al., J. Mater. Process. Technol. 2021, doi 10.1016/j.jmatprotec.2020.117035")
} // namespace tribodraw
