#include <tribodraw/application/task.h>
#include <tribodraw/base/csv.h>
#include <tribodraw/base/log.h>
#include <tribodraw/base/parallel.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/base/timing.h>
#include <tribodraw/base/units.h>
#include <tribodraw/lubrication/prescribed_film.h>
#include <tribodraw/output/paraview.h>
#include <tribodraw/output/vtu.h>

#include <cstdio>

namespace tribodraw
{
  namespace
  {
    /// The average Reynolds equation on a prescribed gap.
    class FilmTask : public Task
    {
    public:
      explicit FilmTask(Parameters &parameters) : film(parameters) {}

      std::string
      describe() const override
      {
        return film.describe();
      }

      void
      run(const RunContext &context) override
      {
        const auto result = [&] {
          const timing::Scope scope("lubrication/film");
          Progress            progress("Film", 1.);
          const auto          result_of_run
              = film.solve([&](const PrescribedFilm::Pass &pass, const PrescribedFilm::Result &state) {
                  report(pass, progress);
                  // Before the gaps of the fall are solved: an interrupted run can be opened.
                  if (pass.gap == 0 && pass.settled && parallel::rank() == 0)
                    write_fields(state, context);
                });
          progress.finish();
          return result_of_run;
        }();
        log::info("Load " + units::format(result.load, "N") + ", greatest pressure "
                  + units::format(result.max_pressure, "MPa") + " at x = " + units::format(result.x_max, "mm"));
        if (parallel::rank() != 0)
          return;
        film.table(result).save(context.file("results.csv"));
        write_mesh(result, context);
      }

    private:
      /// One line a solution.
      static void
      report(const PrescribedFilm::Pass &pass, Progress &progress)
      {
        const double done = (pass.gap + (pass.settled ? 1. : 0.)) / pass.n_gaps;
        char         text[200];
        std::snprintf(text, sizeof text,
                      "%5.1f %%  gap %u of %u, least %.4g um  pass %u  active set its %u  change %.0e  ", 100 * done,
                      pass.gap + 1, pass.n_gaps, pass.least_gap / units::factor("um"), pass.number,
                      pass.active_set_iterations, pass.change);
        log::step(text + progress.times(done));
        progress.update(done);
      }

      static std::vector<double>
      film_in_um(const PrescribedFilm::Result &result)
      {
        std::vector<double> film = result.film;
        for (double &h : film)
          h /= units::factor("um");
        return film;
      }

      static void
      write_fields(const PrescribedFilm::Result &result, const RunContext &context)
      {
        SurfaceFields fields;
        fields.points       = result.nodes;
        fields.triangles    = result.triangles;
        fields.node_scalars = { { "lubricant_pressure", result.pressure },
                                { "film_thickness", film_in_um(result) },
                                { "film_fraction", result.fill } };
        fields.units        = { { "lubricant_pressure", "MPa" }, { "film_thickness", "um" } };
        write_vtu(context.file("solution-00000.vtu"), fields);
        write_paraview_state(
            context.output_folder,
            { { "Lubricant pressure / MPa", "lubricant_pressure", ParaviewView::From::above },
              { "Film thickness / µm", "film_thickness", ParaviewView::From::above },
              { "Share of the gap filled with lubricant", "film_fraction", ParaviewView::From::above } });
        PvdCollection steps;
        steps.add(0, "solution-00000.vtu");
        steps.save(context.file("solution.pvd"));
      }

      /// The files from which the maps are drawn.
      static void
      write_mesh(const PrescribedFilm::Result &result, const RunContext &context)
      {
        const auto film = film_in_um(result);
        CsvTable   nodes(
              { "node", "x_mm", "y_mm", "z_mm", "lubricant_pressure_mpa", "film_thickness_um", "film_fraction" });
        for (std::size_t i = 0; i < result.nodes.size(); ++i)
          nodes.add_row({ static_cast<long>(i), result.nodes[i][0], result.nodes[i][1], result.nodes[i][2],
                          result.pressure[i], film[i], result.fill[i] });
        nodes.save(context.file("nodes_final.csv"));
        CsvTable elements({ "element", "n1", "n2", "n3" });
        for (std::size_t e = 0; e < result.triangles.size(); ++e)
          {
            const auto &t = result.triangles[e];
            elements.add_row(
                { static_cast<long>(e), static_cast<long>(t[0]), static_cast<long>(t[1]), static_cast<long>(t[2]) });
          }
        elements.save(context.file("elements_final.csv"));
      }

      PrescribedFilm film;
    };
  } // namespace

  TRIBODRAW_REGISTER(Task, FilmTask, "film",
                     "The average Reynolds equation on a prescribed gap, such as a slider bearing.",
                     "N. Patir, H. S. Cheng, J. Lubr. Technol. 1978")
} // namespace tribodraw
