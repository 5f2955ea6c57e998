#include <tribodraw/base/parallel.h>
#include <tribodraw/base/suggest.h>

#include <gtest/gtest.h>

#include <atomic>

using namespace tribodraw;

TEST(Parallel, SumsAndBroadcasts)
{
  const unsigned      n = parallel::size(), r = parallel::rank();
  std::vector<double> v{1., static_cast<double>(r)};
  parallel::sum(v);
  EXPECT_EQ(v[0], n);
  EXPECT_EQ(v[1], n * (n - 1) / 2.);
  EXPECT_EQ(parallel::max(r), n - 1);
  EXPECT_EQ(parallel::min(r), 0);
  EXPECT_TRUE(parallel::any(r == n - 1));
  EXPECT_FALSE(parallel::any(false));
  std::string text = r == 0 ? "hello" : "";
  parallel::broadcast(text);
  EXPECT_EQ(text, "hello");
  std::vector<double> w(r == 0 ? 3 : 0, 7.);
  parallel::broadcast(w);
  EXPECT_EQ(w, std::vector<double>(3, 7.));
}

TEST(Parallel, RangeIsCoveredOnce)
{
  std::vector<std::atomic<int>> seen(1000);
  parallel::for_range(seen.size(), 10, [&](std::size_t a, std::size_t b) {
    for (std::size_t i = a; i < b; ++i)
      ++seen[i];
  });
  for (const auto &s : seen)
    EXPECT_EQ(s, 1);
}

TEST(Suggest, NearestWord)
{
  EXPECT_EQ(nearest("Viscositty", {"Density", "Viscosity", "Amount"}), "Viscosity");
  EXPECT_EQ(nearest("viscosity", {"Density", "Viscosity"}), "Viscosity");
  EXPECT_EQ(nearest("xyz", {"Density", "Viscosity"}), "");
}
