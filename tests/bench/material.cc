// CPU time of the material laws per call: what the shell pays at each of its material points. The counts are chosen for
// about a second each; per call: cpu_s times 1e6 / count = microseconds / count in millions.
#include "bench.h"
#include "unit/material/paper_material.h"

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

  /// Points after 5 % plastic strain take a further step of @p step (negative: back into the elastic range).
  void
  update(const std::string &locus, const std::string &law, const double step, const std::string &what)
  {
    const auto                sheet     = paper::sheet(locus, law);
    const auto                direction = directions(1000);
    std::vector<PlasticState> state(direction.size());
    PlasticState              next;
    for (std::size_t i = 0; i < direction.size(); ++i)
      for (int k = 1; k <= 5; ++k)
        {
          sheet.update(0.01 * k * direction[i], state[i], 0.02, next);
          state[i] = next;
        }
    const int          n_rounds  = 300;
    double             sum       = 0;
    unsigned           n_plastic = 0;
    const bench::Timer timer;
    for (int round = 0; round < n_rounds; ++round)
      for (std::size_t i = 0; i < direction.size(); ++i)
        {
          const auto u = sheet.update((0.05 + step) * direction[i], state[i], 0.02, next);
          sum += u.stress[0] + u.tangent(0, 0);
          n_plastic += u.plastic;
        }
    print(locus + " + " + law + " update " + what, timer.stop(), 1e3 * n_rounds);
    std::fprintf(stderr, "%60s %8.1f %% plastic\n", "", 0.1 * n_plastic / n_rounds);
    const bench::Timer timer2;
    for (int round = 0; round < n_rounds; ++round)
      for (std::size_t i = 0; i < direction.size(); ++i)
        {
          const Vector3 e = (0.05 + step) * direction[i];
          const Vector3 C(1 + 2 * e[0], 1 + 2 * e[1], e[2]);
          sum += evaluate_in_cauchy_green(sheet, C, state[i], 0.02, next).tangent(0, 0);
        }
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
      update(name, "Bergstroem-van Liempt", -0.0005, "elastic step");
    }
  update("Vegter", "Swift", 0.002, "small plastic step");
}
