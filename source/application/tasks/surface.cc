#include <tribodraw/application/task.h>
#include <tribodraw/base/csv.h>
#include <tribodraw/base/errors.h>
#include <tribodraw/base/log.h>
#include <tribodraw/base/parallel.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/base/timing.h>
#include <tribodraw/base/units.h>
#include <tribodraw/surface/evaluation.h>
#include <tribodraw/surface/roughness.h>
#include <tribodraw/surface/surface.h>
#include <tribodraw/surface/surface_writer.h>

#include <cstdio>
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
        {
          const auto scope = parameters.section("Sheet surface");
          make             = read_surface(parameters);
          settings         = read_evaluation(parameters);
        }
        const auto scope = parameters.section("Output");
        if (parameters.has("Surface format"))
          format = parameters.choice("Surface format", surface_format_names(),
                                     "Format in which the processed map is written as surface_map.* in addition to "
                                     "surface.gsf. If absent, surface.gsf is all.");
      }

      std::string
      describe() const override
      {
        return "Height map of the sheet, its roughness and height distribution.";
      }

      void
      run(const RunContext &context) override
      {
        Progress        progress("Evaluation of the surface", 1.);
        const HeightMap map = make();
        if (map.size() == 0)
          throw InputError(
              describe_error("An ideally smooth surface has no roughness to measure.", "Sheet surface/Model"));
        progress.update(0.3, "made and processed");
        if (parallel::rank() != 0)
          return;
        log::info("Surface: " + map.description);
        const Evaluation evaluation = [&] {
          const timing::Scope scope("surface/evaluate");
          return evaluate_surface(map, settings);
        }();
        progress.update(0.9, "evaluated");
        report(evaluation);
        const timing::Scope scope("surface/write");
        write_parameters(evaluation, context.file("surface.csv"));
        write_distribution(map, context);
        write_voids(evaluation.voids, context.file("closed_voids.csv"));
        write_gsf(map, context.file("surface.gsf"));
        if (!format.empty())
          write_surface_file(map, context.file("surface_map." + format.substr(0, 3)), format);
        progress.finish();
      }

    private:
      static void
      report(const Evaluation &evaluation)
      {
        std::string line;
        for (const char *name : { "Sa", "Sq", "Ssk", "Sku", "Sal", "Str", "Spk", "Sk", "Svk", "Vcl", "Ra", "RPc" })
          for (const ParameterRow &row : evaluation.rows)
            if (row.parameter == name)
              {
                char value[32];
                std::snprintf(value, sizeof value, "%.4g", row.value);
                line += (line.empty() ? "" : ", ") + row.parameter + " " + value
                        + (row.unit == "1" ? "" : " " + row.unit);
              }
        log::info(line);
        for (const std::string &note : evaluation.notes)
          log::info("Note: " + note + ".");
      }

      static void
      write_parameters(const Evaluation &evaluation, const std::filesystem::path &file)
      {
        CsvTable table({ "parameter", "value", "unit" });
        for (const ParameterRow &row : evaluation.rows)
          table.add_row({ row.parameter, row.value, row.unit });
        table.save(file);
      }

      static void
      write_voids(const std::vector<VoidState> &states, const std::filesystem::path &file)
      {
        const double um = units::factor("um");
        CsvTable     table({ "contact_fraction", "height_um", "void_volume_um", "closed_void_volume_um",
                             "closed_void_area_fraction" });
        for (const VoidState &s : states)
          table.add_row({ s.contact_fraction, s.height / um, s.volume / um, s.closed_volume / um, s.closed_area });
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
      EvaluationSettings         settings;
      std::string                format; ///< empty: surface.gsf only
    };
  } // namespace

  TRIBODRAW_REGISTER(
      Task, SurfaceTask, "surface",
      "Read or generate a height map, process it, and give its parameters, height distribution and pictures.", "")
} // namespace tribodraw
