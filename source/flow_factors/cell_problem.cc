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
#include <mutex>

namespace tribodraw
{
  namespace
  {
    // Pressure and shear flow for one direction of driving; writes column `axis` of both tensors.
    class ColumnOfTensors
    {
    public:
      ColumnOfTensors(const CellFlow &flow_in, const CellFlow::Window &window_in, const int axis_in)
          : flow(flow_in), window(window_in), axis(axis_in), pressure(flow.pressure_flow(axis)),
            shear(flow.shear_flow(axis))
      {
      }

      // Component i of the flux that a unit mean pressure gradient (or unit speed of sliding) along `axis` causes.
      double
      pressure_factor(const int i) const
      {
        return 0 - flow.mean_flux(pressure, i, window); // 0 -: no negative zero
      }
      double
      shear_flux(const int i) const
      {
        return flow.mean_flux(shear, i, window);
      }

      void
      add_to(CellBounding &bounding) const
      {
        bounding.add_pressure_flow(axis, pressure.pressure, pressure.upper_flux);
        bounding.add_shear_flow(axis, shear.pressure, shear.upper_flux);
      }

      void
      record_quality(FlowFactors &result) const
      {
        // Just above percolation the flux is tiny and its relative error without meaning: below 1e-4 of the smooth
        // flux errors count absolutely.
        const double through = std::max(std::abs(result.phi_p[3 * axis]), 1e-4);
        const double mismatch
            = std::max(flow.section_mismatch(pressure, axis) / through, flow.section_mismatch(shear, axis));
        result.flux_error = std::max(result.flux_error, mismatch);
        result.residual   = std::max({ result.residual, pressure.residual, shear.residual });
        result.iterations = std::max({ result.iterations, pressure.iterations, shear.iterations });
      }

    private:
      const CellFlow         &flow;
      const CellFlow::Window &window;
      const int               axis;
      CellFlow::Solution      pressure, shear;
    };

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
    FlowFactors result;
    result.h_avg            = gap.mean_gap;
    result.contact_fraction = gap.contact_fraction;
    result.phi_p            = { { 0, 0, 0, 0 } };
    const auto   window     = averaging_window(grid);
    const double carried    = mean_carried(grid, gap, window);
    const auto   over_sq    = [sq_reference](const double x) { return sq_reference > 0 ? x / sq_reference : 0.; };
    result.phi_s            = { { over_sq(carried), 0, 0, over_sq(carried) } };

    std::unique_ptr<CellFlow>     flow;
    std::unique_ptr<CellBounding> bounding;
    for (int axis = 0; axis < 2; ++axis)
      {
        if (settings.error_bounds && (axis == 0 || !grid.periodic))
          bounding = std::make_unique<CellBounding>(grid, gap, axis);
        // periodic: one matrix for both directions
        if (axis == 0 || !grid.periodic)
          {
            flow.reset();
            flow = std::make_unique<CellFlow>(grid, gap, settings.discretisation, axis);
          }
        if (!flow->blocked())
          {
            const ColumnOfTensors column(*flow, window, axis);
            for (int i = 0; i < 2; ++i)
              if (grid.periodic || i == axis) // side walls without flow determine the diagonal only
                {
                  result.phi_p[2 * i + axis] = column.pressure_factor(i);
                  result.phi_s[2 * i + axis] -= over_sq(gap.mean_gap * column.shear_flux(i));
                }
            column.record_quality(result);
            if (bounding)
              column.add_to(*bounding);
          }
        if (bounding && (axis == 1 || !grid.periodic))
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
