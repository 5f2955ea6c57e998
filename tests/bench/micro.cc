// Local Reynolds cells: flow factors of generated surfaces against CHOLMOD on the same equations, growth with the size of
// the map, and a whole curve.
#include "bench.h"

#include <tribodraw/base/parallel.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/flattening/height_distribution.h>
#include <tribodraw/flow_factors/cell_flow.h>
#include <tribodraw/flow_factors/flow_factors.h>
#include <tribodraw/surface/surface.h>

#include <cholmod.h>
#include <dlfcn.h>
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

using namespace tribodraw;

namespace
{
  constexpr double closed_gap = 3e-4; // of Sq, the default of the program

  // The surfaces of the shipped parameter files, with any number of pixels of 3 um.
  HeightMap
  gaussian(const std::size_t n)
  {
    Parameters p
        = Parameters::from_text("set Model = generated\nsubsection Generated\nset Pixels = " + std::to_string(n)
                                + "\nset Pixel size = 3 um\nset Sq = 1.56 um\nset Seed = 1\nset Texture = gaussian\n"
                                  "subsection Gaussian\nset Correlation length = 24 um\nend\nend\n");
    return read_surface(p)();
  }

  HeightMap
  bimodal(const std::size_t n)
  {
    Parameters p = Parameters::from_text(
        "set Model = generated\nsubsection Generated\nset Pixels = " + std::to_string(n)
        + "\nset Pixel size = 3 um\nset Sq = 1.6 um\nset Seed = 1\nset Texture = bimodal\nsubsection Bimodal\n"
          "set Crater correlation length = 45 um\nset Plateau area fraction = 0.637\nset Edge steepness = 2.2\n"
          "set Fine roughness ratio = 0.12\nset Fine correlation length = 9 um\nend\nend\n");
    return read_surface(p)();
  }

  struct Result
  {
    double   phi_p = 0, shear_flux = 0, residual = 0, imbalance = 0;
    unsigned iterations = 0;
  };

  // Pressure and shear in x, from the gap to the means; the default discretisation.
  Result
  own(const CellGrid &grid, const CellGap &gap, const bool one_by_one)
  {
    const CellFlow               flow(grid, gap, CellDiscretisation::mean_gap, 0);
    const CellFlow::Window       all{{{0, 0}}, {{grid.nx, grid.ny}}};
    Result                       result;
    std::vector<CellFlow::Drive> drives{{0, false}, {0, true}};
    const auto                   use = [&](const CellFlow::Drive &drive, const CellFlow::Solution &s) {
      (drive.shear ? result.shear_flux : result.phi_p) = std::abs(flow.mean_flux(s, 0, all));
      result.residual                                  = std::max(result.residual, s.residual);
      result.imbalance                                 = std::max(result.imbalance, flow.imbalance(s, drive));
      result.iterations                                = std::max(result.iterations, s.iterations);
    };
    if (one_by_one)
      for (const CellFlow::Drive &drive : drives)
        use(drive, flow.solve({drive})[0]);
    else
      {
        const auto solutions = flow.solve(drives);
        for (std::size_t i = 0; i < drives.size(); ++i)
          use(drives[i], solutions[i]);
      }
    return result;
  }

  // The same equations for CHOLMOD. Assembly is not part of the measured time.
  class Cholmod
  {
  public:
    Cholmod(const CellGrid &grid_in, const CellGap &gap_in)
        : grid(grid_in), gap(gap_in), unknown(CellConnectivity(grid_in, gap_in).conducting_regions(0))
    {
      int next = 0;
      for (int &u : unknown)
        {
          const int region = u;
          if (region < 0)
            continue;
          if (region == static_cast<int>(floating.size()))
            floating.push_back(next);
          u = next++;
        }
      n = static_cast<std::size_t>(next);
      cholmod_start(&common);
      common.supernodal         = CHOLMOD_SUPERNODAL;
      common.nmethods           = 1;
      common.method[0].ordering = CHOLMOD_AMD; // faster in total than METIS and than trying both
      common.postorder          = 1;
      assemble();
    }
    ~Cholmod()
    {
      cholmod_free_sparse(&matrix, &common);
      cholmod_free_dense(&rhs, &common);
      cholmod_free_dense(&x, &common);
      cholmod_finish(&common);
    }
    Cholmod(const Cholmod &)            = delete;
    Cholmod &operator=(const Cholmod &) = delete;

    void solve()
    {
      cholmod_free_dense(&x, &common);
      cholmod_factor *factor = cholmod_analyze(matrix, &common);
      cholmod_factorize(matrix, factor, &common);
      if (common.status != CHOLMOD_OK)
        throw std::runtime_error("CHOLMOD failed");
      x = cholmod_solve(CHOLMOD_A, factor, rhs, &common);
      cholmod_free_factor(&factor, &common);
    }

    Result result() const
    {
      Result        r;
      const double *p = static_cast<const double *>(x->x), *s = p + n;
      each_face([&](const int a, const int b, const bool along_x, const double k, const double c) {
        r.phi_p += along_x ? k * (1 + p[b] - p[a]) : 0.;
        r.shear_flux += along_x ? c - k * (s[b] - s[a]) : 0.;
      });
      r.phi_p /= static_cast<double>(grid.size());
      r.shear_flux /= static_cast<double>(grid.size());
      return r;
    }

  private:
    const CellGrid   &grid;
    const CellGap    &gap;
    std::vector<int>  unknown, floating;
    std::size_t       n = 0;
    cholmod_common    common{};
    cholmod_sparse   *matrix = nullptr;
    cholmod_dense    *rhs = nullptr, *x = nullptr;

    // Faces of a periodic map of square pixels, pixel size 1: conductance and carried thickness.
    template <class Use>
    void each_face(const Use &use) const
    {
      for (std::size_t iy = 0; iy < grid.ny; ++iy)
        for (std::size_t ix = 0; ix < grid.nx; ++ix)
          for (const bool along_x : {true, false})
            {
              const std::size_t a = iy * grid.nx + ix, b = along_x ? iy * grid.nx + (ix + 1) % grid.nx
                                                                   : (iy + 1) % grid.ny * grid.nx + ix;
              if (unknown[a] < 0 || unknown[b] < 0)
                continue;
              const double h = 0.5 * (gap.gap[a] + gap.gap[b]) / gap.mean_gap;
              use(unknown[a], unknown[b], along_x, h * h * h, 0.5 * (gap.carried[a] + gap.carried[b]) / gap.mean_gap);
            }
    }

    void assemble()
    {
      cholmod_triplet *t = cholmod_allocate_triplet(n, n, 3 * n, -1, CHOLMOD_REAL, &common);
      int             *row = static_cast<int *>(t->i), *column = static_cast<int *>(t->j);
      double          *value = static_cast<double *>(t->x);
      rhs                    = cholmod_zeros(n, 2, CHOLMOD_REAL, &common);
      double             *p = static_cast<double *>(rhs->x), *s = p + n;
      std::vector<double> diagonal(n, 0.);
      const auto          add = [&](const int i, const int j, const double v) {
        row[t->nnz]      = std::max(i, j);
        column[t->nnz]   = std::min(i, j);
        value[t->nnz++] = v;
      };
      each_face([&](const int a, const int b, const bool along_x, const double k, const double c) {
        add(a, b, -k);
        diagonal[static_cast<std::size_t>(a)] += k;
        diagonal[static_cast<std::size_t>(b)] += k;
        if (along_x)
          {
            p[a] += k;
            p[b] -= k;
            s[a] -= c;
            s[b] += c;
          }
      });
      for (const int i : floating)
        diagonal[static_cast<std::size_t>(i)] *= 2;
      for (std::size_t i = 0; i < n; ++i)
        add(static_cast<int>(i), static_cast<int>(i), diagonal[i]);
      matrix = cholmod_triplet_to_sparse(t, 0, &common);
      cholmod_free_triplet(&t, &common);
    }
  };

  bench::Measurement
  smaller(const bench::Measurement &a, const bench::Measurement &b)
  {
    return {std::min(a.cpu_s, b.cpu_s), std::min(a.wall_s, b.wall_s), std::max(a.peak_mb, b.peak_mb)};
  }

  template <class Work>
  bench::Measurement
  measure(const Work &work)
  {
    const bench::Timer timer;
    work();
    return timer.stop();
  }

  void
  check(const std::string &name, const Result &mine, const Result *reference)
  {
    std::fprintf(stderr, "%s: phi_p_xx %.9g, %u iterations, residual %.1e, flux balance %.1e\n", name.c_str(),
                 mine.phi_p, mine.iterations, mine.residual, mine.imbalance);
    if (mine.residual > 1e-10 || mine.imbalance > 1e-10)
      throw std::runtime_error(name + ": residual or flux balance above 1e-10");
    if (reference && (std::abs(mine.phi_p - reference->phi_p) > 1e-9
                      || std::abs(mine.shear_flux - reference->shear_flux) > 1e-9))
      throw std::runtime_error(name + ": CHOLMOD finds other flow factors");
  }

  // Both problems of one direction; own solution and CHOLMOD in turn, the least time of each.
  void
  against_cholmod(const std::string &surface, const HeightMap &map, const std::vector<double> &separations,
                  const int repetitions)
  {
    const CellGrid           grid = make_cell_grid(map.nx, map.ny, map.dx, map.dy, true);
    const HeightDistribution heights(map);
    for (const double separation : separations)
      {
        const double      s = heights.cut_height_for_mean_gap(separation * heights.sq());
        const CellGap     gap = make_cell_gap(map, {}, s, closed_gap * heights.sq());
        const std::string name = surface + " " + std::to_string(map.nx) + "x" + std::to_string(map.ny) + " h_avg/Sq "
                                 + std::to_string(separation).substr(0, 3);
        bench::Measurement mine{1e9, 1e9, 0}, theirs = mine;
        Result             result;
        Cholmod            cholmod(grid, gap);
        for (int i = 0; i < repetitions; ++i)
          {
            mine   = smaller(mine, measure([&] { result = own(grid, gap, false); }));
            theirs = smaller(theirs, measure([&] { cholmod.solve(); }));
            mine   = smaller(mine, measure([&] { result = own(grid, gap, false); }));
          }
        const Result reference = cholmod.result();
        check(name, result, &reference);
        std::fprintf(stderr, "  memory: own %.0f MB, CHOLMOD %.0f MB\n", mine.peak_mb, theirs.peak_mb);
        bench::print_row("micro", name, mine, bench::Reference{"CHOLMOD", theirs.cpu_s});
      }
  }

  // Time and memory of large maps against the time a pixel takes at 666 x 666.
  void
  growth()
  {
    double cpu_of_a_pixel = 0;
    for (const std::size_t n : {666, 1332, 2664, 5328})
      {
        const HeightMap map    = gaussian(n);
        const CellGrid  grid   = make_cell_grid(map.nx, map.ny, map.dx, map.dy, true);
        const double    pixels = static_cast<double>(grid.size());
        double          s = 0, sq = 0;
        {
          const HeightDistribution heights(map);
          sq = heights.sq();
          s  = heights.cut_height_for_mean_gap(sq);
        }
        Result             result;
        bench::Measurement m{1e9, 1e9, 0};
        for (int i = 0; i < (n < 2000 ? 3 : 1); ++i)
          m = smaller(m, measure([&] {
                        const CellGap gap = make_cell_gap(map, {}, s, closed_gap * sq);
                        result            = own(grid, gap, true);
                      }));
        if (cpu_of_a_pixel == 0)
          cpu_of_a_pixel = m.cpu_s / pixels;
        const std::string name = "growth " + std::to_string(n) + "x" + std::to_string(n);
        check(name, result, nullptr);
        std::fprintf(stderr, "  %.0f bytes a pixel, height map and gap included\n", m.peak_mb * 1e6 / pixels);
        bench::print_row("micro", name, m, bench::Reference{"pixels times 666x666", cpu_of_a_pixel * pixels});
      }
  }

  void
  whole_curve()
  {
    const HeightMap          map = gaussian(666);
    const HeightDistribution heights(map);
    Parameters               p     = Parameters::from_text("");
    const auto               model = read_flow_factors(p);
    std::vector<double>      separations;
    for (int i = 0; i < 20; ++i) // 6 to 0.3
      separations.push_back(6 * std::pow(0.05, i / 19.));
    const auto cuts = cut_heights_for_separations(map, {}, heights.sq(), separations);
    const auto m    = measure([&] { model->compute(map, {}, heights.sq(), cuts, {}); });
    bench::print_row("micro", "curve of 20 separations, full tensors, 666x666", m);
  }

  void
  use_one_blas_thread()
  {
    if (!dlsym(RTLD_DEFAULT, "openblas_set_num_threads"))
      std::fprintf(stderr, "CHOLMOD does not run with OpenBLAS here; the reference is slower than it could be.\n");
    parallel::use_one_blas_thread();
  }
} // namespace

// Arguments: any of cholmod, growth, curve; default: all.
int
main(int argc, char **argv)
{
  MPI_Init(&argc, &argv);
  use_one_blas_thread();
  const auto wanted = [&](const std::string &part) {
    return argc == 1 || std::any_of(argv + 1, argv + argc, [&](const char *a) { return a == part; });
  };
  try
    {
      if (wanted("cholmod"))
        {
          against_cholmod("gaussian", gaussian(666), {6, 2, 1, 0.8, 0.5}, 3);
          against_cholmod("bimodal", bimodal(666), {6, 2, 1, 0.8}, 2);
          against_cholmod("gaussian", gaussian(1332), {6, 2, 1, 0.8, 0.5}, 1);
        }
      if (wanted("curve"))
        whole_curve();
      if (wanted("growth"))
        growth();
    }
  catch (const std::exception &e)
    {
      std::fprintf(stderr, "bench_micro: %s\n", e.what());
      MPI_Abort(MPI_COMM_WORLD, 1);
    }
  MPI_Finalize();
}
