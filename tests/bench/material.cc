// CPU time of the material laws per call: what the shell pays at each of its material points. The counts are chosen for
// about a second each; per call: cpu_s times 1e6 / count = microseconds / count in millions.
#include "bench.h"
#include "unit/material/paper_material.h"

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
    print(locus + " + " + law + " Cauchy-Green " + what, timer2.stop(), 1e3 * n_rounds);
    sink = sum;
  }
} // namespace

int
main()
{
  for (const char *name : { "von Mises", "Hill 1948", "Vegter" })
    yield_locus(name);
  for (const char *name : { "von Mises", "Hill 1948", "Vegter" })
    {
      update(name, "Bergstroem-van Liempt", 0.002, "small plastic step");
      update(name, "Bergstroem-van Liempt", 0.02, "large plastic step");
      update(name, "Bergstroem-van Liempt", 0, "elastic step");
    }
  update("Vegter", "Swift", 0.002, "small plastic step");
}
