#include <tribodraw/application/task.h>
#include <tribodraw/base/csv.h>
#include <tribodraw/base/errors.h>
#include <tribodraw/base/log.h>
#include <tribodraw/base/parallel.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/base/timing.h>
#include <tribodraw/base/units.h>
#include <tribodraw/surface/roughness.h>
#include <tribodraw/surface/surface.h>
#include <tribodraw/surface/surface_writer.h>

#include <functional>

namespace tribodraw
{
  namespace
  {
    /// Make or read one height map and say what it is like.
    class SurfaceTask : public Task
    {
    public:
      explicit SurfaceTask(Parameters &parameters)
      {
        const auto scope = parameters.section("Sheet surface");
        make             = read_surface(parameters);
      }

      std::string
      describe() const override
      {
        return "Height map of the sheet, its roughness and height distribution.";
      }

      void
      run(const RunContext &context) override
      {
        const HeightMap map = make();
        if (map.size() == 0)
          throw InputError(
              describe_error("An ideally smooth surface has no roughness to measure.", "Sheet surface/Model"));
        const Roughness values = roughness(map);
        if (parallel::rank() != 0)
          return;
        log::info("Surface: " + map.description);
        log::info("Sa " + units::format(values.sa, "um") + ", Sq " + units::format(values.sq, "um") + ", Ssk "
                  + units::number(values.ssk) + ", Sku " + units::number(values.sku));
        const timing::Scope scope("surface/write");
        write_parameters(map, values, context.file("surface.csv"));
        write_distribution(map, context);
        write_gsf(map, context.file("surface.gsf"));
      }

    private:
      static void
      write_parameters(const HeightMap &map, const Roughness &values, const std::filesystem::path &file)
      {
        CsvTable table({ "parameter", "value", "unit" });
        for (const RoughnessRow &row : roughness_rows(map, values))
          table.add_row({ row.parameter, row.value, row.unit });
        table.save(file);
      }

      static void
      write_distribution(const HeightMap &map, const RunContext &context)
      {
        const HeightHistogram histogram = height_histogram(map);
        CsvTable              heights({ "height_um", "density_per_um" });
        for (std::size_t i = 0; i < histogram.density.size(); ++i)
          heights.add_row({ 0.5 * (histogram.edges[i] + histogram.edges[i + 1]), histogram.density[i] });
        heights.save(context.file("height_distribution.csv"));

        const AbbottCurve curve = abbott_curve(map);
        CsvTable          abbott({ "material_ratio", "height_um" });
        for (std::size_t i = 0; i < curve.height.size(); ++i)
          abbott.add_row({ curve.material_ratio[i], curve.height[i] });
        abbott.save(context.file("abbott_curve.csv"));
      }

      std::function<HeightMap()> make;
    };
  } // namespace

  TRIBODRAW_REGISTER(
      Task, SurfaceTask, "surface",
      "Read or generate a height map, level it, and give its roughness, height distribution and picture.", "")
} // namespace tribodraw
