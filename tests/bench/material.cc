// CPU time of the material laws per call: what the shell pays at each of its material points. The counts are chosen for
// about a second each; per call: cpu_s times 1e6 / count = microseconds / count in millions.
#include "bench.h"
#include "unit/material/paper_material.h"

#include <tribodraw/material/point_batch.h>

#include <cmath>
#include <vector>

using namespace tribodraw;

namespace
{
  volatile double sink; // keeps the work alive

  void
  print(const std::string &name, const bench::Measurement &m, const double n_calls)
  {
    bench::print_row("material", name, m);
    std::fprintf(stderr, "%-60s %8.4f us per call\n", name.c_str(), 1e6 * m.cpu_s / n_calls);
  }

  std::vector<Vector3>
  directions(const int n)
  {
    std::mt19937         generator(1);
    std::vector<Vector3> result;
    for (int i = 0; i < n; ++i)
      result.push_back(paper::random_direction(generator));
    return result;
  }

  void
  yield_locus(const std::string &name)
  {
    const auto         locus    = paper::locus(name);
    const auto         stress   = directions(1000);
    const int          n_rounds = 2000;
    double             sum      = 0;
    const bench::Timer timer;
    for (int round = 0; round < n_rounds; ++round)
      for (const Vector3 &s : stress)
        {
          Vector3 n;
          Matrix3 H;
          sum += locus->evaluate(s, n, H) + H(0, 2) + n[1];
        }
    print(name + " evaluate", timer.stop(), 1e3 * n_rounds);
    const bench::Timer timer2;
    for (int round = 0; round < n_rounds; ++round)
      for (const Vector3 &s : stress)
        sum += locus->equivalent_stress(s);
    print(name + " equivalent stress", timer2.stop(), 1e3 * n_rounds);
    std::vector<MohrStress<Pack>> packs(250);
    for (std::size_t i = 0; i < stress.size(); ++i)
      {
        packs[i / 4].m[i % 4] = 0.5 * (stress[i][0] + stress[i][1]);
        packs[i / 4].a[i % 4] = 0.5 * (stress[i][0] - stress[i][1]);
        packs[i / 4].b[i % 4] = stress[i][2];
      }
    LocusDerivatives<Pack> result;
    const bench::Timer     timer3;
    for (int round = 0; round < n_rounds; ++round)
      for (const auto &four : packs)
        {
          locus->evaluate_pack(four, result);
          sum += result.e[0];
        }
    print(name + " evaluate, four at once", timer3.stop(), 1e3 * n_rounds);
    sink = sum;
  }

  /// C = exp(2 E) for the strain (E11, E22, 2 E12).
  Vector3
  cauchy_green(const Vector3 &strain)
  {
    const double mean = 0.5 * (strain[0] + strain[1]), d = 0.5 * (strain[0] - strain[1]), y = 0.5 * strain[2];
    const double r = std::sqrt(d * d + y * y), sinh = std::sinh(2 * r) / r, cosh = std::cosh(2 * r);
    return std::exp(2 * mean) * Vector3(cosh + sinh * d, cosh - sinh * d, sinh * y);
  }

  /// The same points as the shell evaluates them: 15 at a time, from C to stress and tangent in C.
  void
  batches(const SheetMaterial &sheet, const std::vector<Vector3> &C, const std::vector<PlasticState> &state,
          const std::string &name, const std::string &what)
  {
    const unsigned            n_points = 15, n_elements = static_cast<unsigned>(C.size()) / n_points;
    std::vector<PointBatch>   batch(n_elements);
    std::vector<PlasticState> next(C.size());
    for (unsigned e = 0; e < n_elements; ++e)
      {
        batch[e].n = n_points;
        for (unsigned i = 0; i < n_points; ++i)
          for (unsigned k = 0; k < 3; ++k)
            batch[e].C[k][i] = C[e * n_points + i][k];
      }
    PointOptions options;
    options.time_increment = 0.02;
    const int n_rounds     = 300;
    unsigned  slow         = 0;
    for (const bool tangent : { true, false })
      {
        options.tangent = tangent;
        const bench::Timer timer;
        for (int round = 0; round < n_rounds; ++round)
          for (unsigned e = 0; e < n_elements; ++e)
            {
              if (!evaluate(sheet, batch[e], &state[e * n_points], &next[e * n_points], options))
                std::fprintf(stderr, "%s: not converged\n", name.c_str());
              slow += batch[e].slow;
            }
        print(name + (tangent ? " element points with tangent " : " element points, stress only ") + what, timer.stop(),
              1. * n_rounds * n_elements * n_points);
      }
    if (slow > 0)
      std::fprintf(stderr, "%s: %u points went the slow way\n", name.c_str(), slow);
  }

  /// Points after 5 % strain take a further step of @p step in the same direction; 0: unload to half the stress.
  void
  update(const std::string &locus, const std::string &law, const double step, const std::string &what)
  {
    const auto                sheet     = paper::sheet(locus, law);
    const auto                direction = directions(1000);
    const std::size_t         n         = direction.size();
    std::vector<PlasticState> state(n);
    std::vector<Vector3>      strain(n), C(n);
    PlasticState              next;
    for (std::size_t i = 0; i < n; ++i)
      {
        for (int k = 1; k <= 5; ++k)
          {
            sheet.update(0.01 * k * direction[i], state[i], 0.02, next);
            state[i] = next;
          }
        strain[i] = step > 0 ? Vector3((0.05 + step) * direction[i])
                             : Vector3(0.5 * (0.05 * direction[i] + state[i].plastic_strain));
        C[i]      = cauchy_green(strain[i]);
      }
    const int          n_rounds  = 300;
    double             sum       = 0;
    unsigned           n_plastic = 0;
    const bench::Timer timer;
    for (int round = 0; round < n_rounds; ++round)
      for (std::size_t i = 0; i < n; ++i)
        {
          const auto u = sheet.update(strain[i], state[i], 0.02, next);
          sum += u.stress[0] + u.tangent(0, 0);
          n_plastic += u.plastic;
        }
    print(locus + " + " + law + " update " + what, timer.stop(), 1e3 * n_rounds);
    if (n_plastic != (step > 0 ? n * n_rounds : 0))
      std::fprintf(stderr, "%s: a mixture of elastic and plastic points\n", what.c_str());
    const bench::Timer timer2;
    for (int round = 0; round < n_rounds; ++round)
      for (std::size_t i = 0; i < n; ++i)
        sum += evaluate_in_cauchy_green(sheet, C[i], state[i], 0.02, next).tangent(0, 0);
    const auto single = timer2.stop();
    print(locus + " + " + law + " single point " + what, single, 1e3 * n_rounds);
    batches(sheet, C, state, locus + " + " + law, what);
    sink = sum;
  }
} // namespace

int
main()
{
  for (const char *name : { "von Mises", "Hill 1948", "Vegter", "Yld2000-2d" })
    yield_locus(name);
  for (const char *name : { "von Mises", "Hill 1948", "Vegter", "Yld2000-2d" })
    {
      update(name, "Bergstroem-van Liempt", 0.002, "small plastic step");
      update(name, "Bergstroem-van Liempt", 0.02, "large plastic step");
      update(name, "Bergstroem-van Liempt", 0, "elastic step");
    }
  update("Vegter", "Swift", 0.002, "small plastic step");
}
