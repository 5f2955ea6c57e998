#include <tribodraw/application/task.h>
#include <tribodraw/base/csv.h>
#include <tribodraw/base/errors.h>
#include <tribodraw/base/log.h>
#include <tribodraw/base/parallel.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/base/timing.h>
#include <tribodraw/base/units.h>
#include <tribodraw/flow_factors/flow_factors.h>
#include <tribodraw/surface/roughness.h>
#include <tribodraw/surface/surface.h>

#include <cmath>

namespace tribodraw
{
  namespace
  {
    /// Pressure and shear flow factors of a pair of surfaces over a series of separations.
    class FlowFactorsTask : public Task
    {
    public:
      explicit FlowFactorsTask(Parameters &parameters)
      {
        {
          const auto scope = parameters.section("Sheet surface");
          make_sheet       = read_surface(parameters);
        }
        {
          const auto scope = parameters.section("Tool surface");
          make_tool        = read_surface(parameters);
        }
        const auto scope = parameters.section("Flow factors");
        model            = read_flow_factors(parameters);
        read_factor_checks(parameters, model.get());
        separations = read_separations(parameters);
      }

      std::string
      describe() const override
      {
        return "Flow factors at " + std::to_string(separations.size()) + " separations, mean gap / Sq from "
               + units::number(separations.front()) + " to " + units::number(separations.back()) + ".";
      }

      void
      run(const RunContext &context) override
      {
        const HeightMap sheet = make_sheet(), tool = make_tool();
        if (sheet.size() == 0)
          throw InputError(
              describe_error("Flow factors need a rough sheet; a smooth tool is possible.", "Sheet surface/Model"));
        const double sq          = std::hypot(roughness(sheet).sq, tool.size() > 0 ? roughness(tool).sq : 0.);
        const auto   cut_heights = cut_heights_for_separations(sheet, tool, sq, separations);
        log::info("Sheet: " + sheet.description);
        log::info("Tool: " + (tool.size() > 0 ? tool.description : std::string("ideally smooth")));

        Progress   progress("Flow factors", 1.);
        const auto factors = [&] {
          const timing::Scope scope("flow_factors/compute");
          return model->compute(sheet, tool, sq, cut_heights, [&](const double done) { progress.update(done); });
        }();
        progress.finish();
        if (parallel::rank() == 0)
          flow_factors_table(factors, sq).save(context.file("flow_factors.csv"));
      }

    private:
      std::function<HeightMap()>       make_sheet, make_tool;
      std::unique_ptr<FlowFactorModel> model;
      std::vector<double>              separations;
    };
  } // namespace

  TRIBODRAW_REGISTER(Task, FlowFactorsTask, "flow factors",
                     "Pressure and shear flow factors of a sheet and a tool surface over a series of separations.", "")
} // namespace tribodraw
