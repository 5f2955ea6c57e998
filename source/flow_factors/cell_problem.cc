#include <tribodraw/base/errors.h>
#include <tribodraw/base/log.h>
#include <tribodraw/base/parallel.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/base/timing.h>
#include <tribodraw/base/units.h>
#include <tribodraw/flow_factors/cell_bounds.h>
#include <tribodraw/flow_factors/cell_flow.h>
#include <tribodraw/flow_factors/cell_problem.h>
#include <tribodraw/flow_factors/quarter_maps.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <functional>
#include <mutex>

namespace tribodraw
{
  namespace
  {
    CellFlow::Window
    averaging_window(const CellGrid &grid)
    {
      CellFlow::Window window{ { { 0, 0 } }, { { grid.nx, grid.ny } } };
      if (!grid.periodic)
        for (int axis = 0; axis < 2; ++axis)
          {
            // The central 0.8 L of Eq. 5, to whole pixels
            window.first[axis] = static_cast<std::size_t>(std::lround(0.1 * static_cast<double>(grid.n(axis))));
            window.last[axis]  = grid.n(axis) - window.first[axis];
          }
      return window;
    }

    double
    mean_carried(const CellGrid &grid, const CellGap &gap, const CellFlow::Window &window)
    {
      double sum = 0;
      for (std::size_t iy = window.first[1]; iy < window.last[1]; ++iy)
        for (std::size_t ix = window.first[0]; ix < window.last[0]; ++ix)
          sum += gap.carried[iy * grid.nx + ix];
      return sum / static_cast<double>((window.last[0] - window.first[0]) * (window.last[1] - window.first[1]));
    }

    // What the flow that one drive causes adds to the results.
    class Evaluation
    {
    public:
      Evaluation(const CellGrid &grid_in, const CellGap &gap_in, const double sq_reference, FlowFactors &result_in)
          : grid(grid_in), gap(gap_in), window(averaging_window(grid_in)),
            over_sq(sq_reference > 0 ? 1 / sq_reference : 0.), result(result_in)
      {
        result.h_avg            = gap.mean_gap;
        result.contact_fraction = gap.contact_fraction;
        const double carried    = over_sq * mean_carried(grid, gap, window);
        result.phi_p            = { { 0, 0, 0, 0 } };
        result.phi_s            = { { carried, 0, 0, carried } };
      }

      // Column drive.axis of one tensor
      void
      add(const CellFlow &flow, const CellFlow::Drive &drive, const CellFlow::Solution &solution)
      {
        for (int i = 0; i < 2; ++i)
          if (grid.periodic || i == drive.axis) // side walls without flow determine the diagonal only
            {
              const double flux = flow.mean_flux(solution, i, window);
              if (drive.shear)
                result.phi_s[2 * i + drive.axis] -= over_sq * gap.mean_gap * flux;
              else
                result.phi_p[2 * i + drive.axis] = 0 - flux; // 0 -: no negative zero
            }
        result.flux_error = std::max(result.flux_error, flow.imbalance(solution, drive));
        result.residual   = std::max(result.residual, solution.residual);
        result.iterations = std::max(result.iterations, solution.iterations);
      }

    private:
      const CellGrid        &grid;
      const CellGap         &gap;
      const CellFlow::Window window;
      const double           over_sq;
      FlowFactors           &result;
    };

    // Solve for all drives and hand each over. Of large maps one at a time: the memory for one is enough.
    void
    solve_each(const CellGrid &grid, const CellFlow &flow, const std::vector<CellFlow::Drive> &drives,
               const std::function<void(const CellFlow::Drive &, const CellFlow::Solution &)> &use)
    {
      constexpr std::size_t large = 4000000;
      const std::size_t     step  = grid.size() > large ? 1 : drives.size();
      for (std::size_t first = 0; first < drives.size(); first += step)
        {
          const std::vector<CellFlow::Drive> group(drives.begin() + static_cast<std::ptrdiff_t>(first),
                                                   drives.begin() + static_cast<std::ptrdiff_t>(first + step));
          const auto                         solutions = flow.solve(group);
          for (std::size_t i = 0; i < group.size(); ++i)
            use(group[i], solutions[i]);
        }
    }

    void
    check_quality(const FlowFactors &result)
    {
      constexpr double limit = 1e-8;
      if (!(result.flux_error <= limit))
        throw ConvergenceError(
            describe_error("The flux through the sections of a local Reynolds cell is not the same",
                           "flow factors at cut height " + units::format(result.cut_height, "um"),
                           units::number(result.flux_error), "at most " + units::number(limit),
                           "Raise 'Closed gap' so that channels of vanishing height count as closed."));
    }
  } // namespace

  FlowFactors
  solve_cell_problem(const CellGrid &grid, const CellGap &gap, const CellSettings &settings, const double sq_reference)
  {
    FlowFactors      result;
    Evaluation       evaluation(grid, gap, sq_reference, result);
    std::vector<int> axes{ 0, 1 };
    // periodic: one matrix for both directions
    for (const int driven_axis : grid.periodic ? std::vector<int>{ 0 } : axes)
      {
        std::unique_ptr<CellBounding> bounding;
        if (settings.error_bounds)
          bounding = std::make_unique<CellBounding>(grid, gap, driven_axis);
        {
          const CellFlow               flow(grid, gap, settings.discretisation, driven_axis);
          std::vector<CellFlow::Drive> drives;
          for (const int axis : grid.periodic ? axes : std::vector<int>{ driven_axis })
            for (const bool shear : { false, true })
              if (!flow.blocked())
                drives.push_back({ axis, shear });
          solve_each(grid, flow, drives, [&](const CellFlow::Drive &drive, const CellFlow::Solution &solution) {
            evaluation.add(flow, drive, solution);
            if (bounding && drive.shear)
              bounding->add_shear_flow(drive.axis, solution.pressure, solution.upper_flux);
            else if (bounding)
              bounding->add_pressure_flow(drive.axis, solution.pressure, solution.upper_flux);
          });
        }
        if (bounding)
          bounding->finish(result, sq_reference);
      }
    return result;
  }

  namespace
  {
    class CellProblem : public FlowFactorModel
    {
    public:
      explicit CellProblem(Parameters &parameters)
          : closed_gap(parameters.quantity(
              "Closed gap", "", Range::between(0, 0.1),
              "Gap, in multiples of the reference Sq, up to which a pixel lets no lubricant through.",
              Default{ "3e-4", "0.5 nm, the least film in the paper, against a roughness of 1.6 um" }))
      {
      }

      std::vector<FlowFactors> compute(const HeightMap &sheet, const HeightMap &tool, double sq_reference,
                                       const std::vector<double>         &cut_heights,
                                       const std::function<void(double)> &progress) const override;

      std::string
      fingerprint() const override
      {
        return std::string("cell problem 1; boundary conditions ")
               + (settings.boundary_conditions == CellBoundaryConditions::paper ? "paper" : "periodic")
               + "; discretisation " + (settings.discretisation == CellDiscretisation::paper ? "paper" : "mean gap")
               + "; closed gap " + units::number(closed_gap);
      }

      bool
      use_cell_settings(const CellSettings &given) override
      {
        settings = given;
        return true;
      }

      bool
      use_checks(const FactorChecks &checks) override
      {
        settings.error_bounds = checks.error_bounds;
        settings.quarter_maps = checks.quarter_maps;
        return true;
      }

    private:
      CellSettings settings;
      double       closed_gap;

      void check_maps(const HeightMap &sheet, const HeightMap &tool) const;
    };

    void
    CellProblem::check_maps(const HeightMap &sheet, const HeightMap &tool) const
    {
      const auto size = [](const HeightMap &m) { return std::to_string(m.nx) + " x " + std::to_string(m.ny); };
      if (!tool.z.empty() && (tool.nx != sheet.nx || tool.ny != sheet.ny))
        throw InputError(describe_error("The maps of sheet and tool have different grids", "flow factors",
                                        "sheet " + size(sheet) + ", tool " + size(tool) + " pixels",
                                        "the same number of pixels"));
      const bool periodic_maps = sheet.periodic && (tool.z.empty() || tool.periodic);
      if (settings.boundary_conditions == CellBoundaryConditions::periodic && !periodic_maps)
        log::info("Flow factors: the map is repeated periodically although its opposite sides do not match; the jump "
                  "disturbs a seam of about one correlation length.");
      if (settings.boundary_conditions == CellBoundaryConditions::paper && (sheet.nx < 10 || sheet.ny < 10))
        throw InputError(describe_error("The map is too small for an average over its central part",
                                        "flow factors, boundary conditions 'paper'", size(sheet) + " pixels",
                                        "at least 10 x 10"));
    }

    // Separations are independent: rank r takes r, r + size, ...; the threads of a rank fetch theirs one by one, as
    // the first ones (little contact) take much longer than the last. Each is computed whole by one thread, so
    // the result does not depend on the distribution.
    class Distribution
    {
    public:
      Distribution(const std::size_t n_tasks, const std::size_t n_pixels, std::function<void(double)> progress_in)
          : progress(std::move(progress_in))
      {
        for (std::size_t i = parallel::rank(); i < n_tasks; i += parallel::size())
          mine.push_back(i);
        // A solution takes some 1000 bytes a pixel: of large maps one at a time.
        constexpr std::size_t large = 1000000;
        workers                     = n_pixels < large ? std::min<std::size_t>(parallel::n_threads(), mine.size()) : 1;
      }

      void
      run(const std::function<void(std::size_t)> &task)
      {
        parallel::for_range(workers, 1, [&](const std::size_t, const std::size_t) { work(task); });
        if (failure)
          parallel::any(true);
        else if (parallel::any(false))
          throw ConvergenceError("Flow factors failed on another rank; see its message.");
        if (failure)
          std::rethrow_exception(failure);
      }

    private:
      std::vector<std::size_t>    mine;
      std::size_t                 workers = 1;
      std::atomic<std::size_t>    next{ 0 };
      std::size_t                 n_done = 0;
      std::mutex                  mutex;
      std::exception_ptr          failure;
      std::function<void(double)> progress;

      void
      work(const std::function<void(std::size_t)> &task)
      {
        for (std::size_t k = next++; k < mine.size(); k = next++)
          try
            {
              task(mine[k]);
              const std::lock_guard<std::mutex> lock(mutex);
              ++n_done;
              if (progress)
                progress(static_cast<double>(n_done) / static_cast<double>(mine.size()));
            }
          catch (...)
            {
              const std::lock_guard<std::mutex> lock(mutex);
              if (!failure)
                failure = std::current_exception();
              next = mine.size();
            }
      }
    };

    std::vector<FlowFactors>
    CellProblem::compute(const HeightMap &sheet, const HeightMap &tool, const double sq_reference,
                         const std::vector<double> &cut_heights, const std::function<void(double)> &progress) const
    {
      const timing::Scope timer("flow_factors/cell problem");
      check_maps(sheet, tool);
      const bool     periodic = settings.boundary_conditions == CellBoundaryConditions::periodic;
      const CellGrid grid     = make_cell_grid(sheet.nx, sheet.ny, sheet.dx, sheet.dy, periodic);

      const std::size_t   n_numbers = FlowFactors::n_numbers();
      std::vector<double> packed(n_numbers * cut_heights.size(), 0.);
      Distribution        distribution(cut_heights.size(), grid.size(), progress);
      distribution.run([&](const std::size_t i) {
        const CellGap gap    = make_cell_gap(sheet, tool, cut_heights[i], closed_gap * sq_reference);
        FlowFactors   result = solve_cell_problem(grid, gap, settings, sq_reference);
        result.cut_height    = cut_heights[i];
        check_quality(result);
        if (settings.quarter_maps)
          add_quarter_maps(result, sheet, tool, settings, closed_gap * sq_reference, sq_reference);
        const std::vector<double> numbers = result.numbers();
        std::copy(numbers.begin(), numbers.end(), &packed[n_numbers * i]);
      });
      parallel::sum(packed);

      std::vector<FlowFactors> results;
      for (std::size_t i = 0; i < cut_heights.size(); ++i)
        results.push_back(FlowFactors::from_numbers(&packed[n_numbers * i]));
      return results;
    }
  } // namespace

  TRIBODRAW_REGISTER(
      FlowFactorModel, CellProblem, "cell problem",
      "Local Reynolds equation solved on the measured gap by finite volumes, contact removed from the flow",
      "Shisode et al., J. Mater. Process. Technol. 2021, Eqs. 3-12 and Appendix A; periodic cells: "
      "homogenisation of the Reynolds equation")
} // namespace tribodraw
