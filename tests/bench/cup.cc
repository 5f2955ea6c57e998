// CPU time of deep drawing: NUMISHEET'93 square cup (quarter, constant friction 0.144, to 40 mm, 2,592 triangles), cross die
// of prm/cross_die.prm (quarter, Vegter and rate dependence, constant friction 0.10, to 58 mm), and time per Newton iteration
// and memory over the number of elements (cup, first 0.5 mm).
#include "bench.h"
#include "unit/forming/square_cup.h"

#include <tribodraw/base/log.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/base/timing.h>
#include <tribodraw/forming/constant_friction.h>
#include <tribodraw/forming/simulation.h>

#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

using namespace tribodraw;

namespace
{
  struct Counter : Observer
  {
    unsigned increments = 0, iterations = 0;
    double   penetration = 0;
    void     committed(const Simulation &, const IncrementRecord &r) override
    {
      ++increments;
      iterations += r.newton_iterations;
      penetration = std::max(penetration, r.max_penetration);
    }
  };

  struct Result
  {
    bench::Measurement used;
    unsigned           iterations;
  };

  Result
  draw(const std::string &title, const std::string &text, const std::vector<std::string> &changes, const double mu)
  {
    Parameters p  = Parameters::from_text(text, title, changes);
    const auto in = [&](const char *name, auto read) {
      const auto scope = p.section(name);
      return read(p);
    };
    const auto blank    = in("Blank", Blank::read);
    const auto material = std::make_shared<SheetMaterial>(in("Sheet material", SheetMaterial::read));
    const auto tools    = in("Tools", ToolSet::read);
    const auto process  = in("Process", Process::read);
    const auto settings = in("Solver", SolverSettings::read);
    bench::Timer timer;
    Simulation   simulation(blank, material, tools, process, settings, std::make_unique<ConstantFriction>(mu));
    const auto   count = std::make_shared<Counter>();
    simulation.add_observer(count);
    simulation.run();
    const Result result{timer.stop(), count->iterations};
    bench::print_row("cup", title, result.used);
    const auto &r = simulation.record();
    std::fprintf(stderr,
                 "%s: %u triangles, %u increments, %u iterations, %.1f ms per iteration, punch force %.1f kN, draw-in %.2f %.2f %.2f mm at %.1f mm, "
                 "penetration at most %.1f %% of the thickness, energy error %.2f %%\n",
                 title.c_str(), simulation.shell().n_elements(), count->increments, count->iterations, 1e3 * result.used.cpu_s / count->iterations,
                 1e-3 * r.punch_force, r.draw_in_x, r.draw_in_y, r.draw_in_diagonal, r.punch_travel, 100 * count->penetration / blank.thickness,
                 100 * r.energy_error());
    std::fprintf(stderr, "%s\n", timing::summary().c_str());
    return result;
  }

  std::string
  read(const std::string &file)
  {
    std::ifstream      stream(file);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
  }
} // namespace

/// Without arguments all cases; else those whose names begin with an argument: cup, cross, scaling.
int
main(int argc, char **argv)
{
  MPI_Init(&argc, &argv);
  const auto chosen = [&](const std::string &name) { return argc == 1 || std::find(argv + 1, argv + argc, name) != argv + argc; };
  {
    log::set_level(log::Level::quiet);
    if (chosen("cup"))
      draw("square cup 40 mm", square_cup, {}, 0.144);
    if (chosen("cross"))
      draw("cross die 58 mm", read(std::string(TRIBODRAW_SOURCE_DIR) + "/prm/cross_die.prm"), {"Blank/Element size = 3.6111 mm"}, 0.10);
    if (chosen("scaling"))
      {
        // 2,592, 10,368 and 41,472 triangles
        double   last_time = 0;
        unsigned last_n    = 0;
        for (const unsigned n : {36u, 72u, 144u})
          {
            const Result r    = draw("square cup 0.5 mm " + std::to_string(2 * n * n) + " triangles", square_cup,
                                     {"Blank/Element size = " + std::to_string(75. / n) + " mm", "Process/Punch travel = 0.5 mm"}, 0.144);
            const double time = r.used.cpu_s / r.iterations;
            if (last_n > 0)
              std::fprintf(stderr, "time per iteration grows with the number of triangles to the power %.2f\n", std::log(time / last_time) / std::log(n * n / (1. * last_n * last_n)));
            last_time = time;
            last_n    = n;
          }
      }
  }
  MPI_Finalize();
}
