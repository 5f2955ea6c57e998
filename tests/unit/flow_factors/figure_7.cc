// What the paper shows in Fig. 7, on reduced maps of the two shipped parameter files.
#include "maps.h"

#include <tribodraw/base/parallel.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/surface/roughness.h>
#include <tribodraw/surface/surface.h>

#include <gtest/gtest.h>

#include <algorithm>

using namespace tribodraw;

namespace
{
  const std::vector<double> separations{ 6, 4, 3, 2, 1.5, 1.25, 1, .8 };

  // Components xx of both factors with the settings of the file, on 256 x 256 instead of 666 x 666 pixels.
  std::vector<FlowFactors>
  factors_of(const std::string &file)
  {
    Parameters p     = Parameters::from_file(std::string(TRIBODRAW_SOURCE_DIR) + "/prm/" + file,
                                             { "Sheet surface/Generated/Pixels = 256" });
    const auto sheet = [&] {
      const auto scope = p.section("Sheet surface");
      return read_surface(p)();
    }();
    const auto   scope = p.section("Flow factors");
    const auto   model = read_flow_factors(p);
    const double sq    = roughness(sheet).sq;
    return model->compute(sheet, {}, sq, cut_heights_for_separations(sheet, {}, sq, separations), {});
  }
}

TEST(Figure7, behaviour_of_both_surfaces)
{
  const auto gaussian = factors_of("flow_factors_gaussian.prm"), bimodal = factors_of("flow_factors_bimodal.prm");
  const auto at = [](const std::vector<FlowFactors> &f, const double separation) {
    return f[static_cast<std::size_t>(std::find(separations.begin(), separations.end(), separation)
                                      - separations.begin())];
  };
  for (const auto *f : { &gaussian, &bimodal })
    {
      // the pressure factor falls all the way, from nearly 1
      EXPECT_GT((*f)[0].phi_p[0], .93);
      for (std::size_t i = 1; i < f->size(); ++i)
        EXPECT_LT((*f)[i].phi_p[0], (*f)[i - 1].phi_p[0]);
      // the shear factor rises, has one maximum inside the range, and falls
      const auto peak = std::max_element(f->begin(), f->end(),
                                         [](const auto &a, const auto &b) { return a.phi_s[0] < b.phi_s[0]; });
      EXPECT_NE(peak, f->begin());
      EXPECT_NE(peak, f->end() - 1);
      for (auto i = f->begin(); i != peak; ++i)
        EXPECT_LT(i->phi_s[0], (i + 1)->phi_s[0]);
      for (auto i = peak; i + 1 != f->end(); ++i)
        EXPECT_GT(i->phi_s[0], (i + 1)->phi_s[0]);
    }
  // Below h_avg/Sq = 3 the pressure factor of the bimodal surface falls more sharply; above they hardly differ.
  const auto drop = [&](const std::vector<FlowFactors> &f, const double from, const double to) {
    return at(f, from).phi_p[0] - at(f, to).phi_p[0];
  };
  EXPECT_GT(drop(bimodal, 3, 1), 1.2 * drop(gaussian, 3, 1));
  EXPECT_GT(drop(bimodal, 2, 1), 1.2 * drop(gaussian, 2, 1));
  EXPECT_LT(at(bimodal, 1).phi_p[0], at(gaussian, 1).phi_p[0]);
  EXPECT_NEAR(at(bimodal, 6).phi_p[0], at(gaussian, 6).phi_p[0], .03);
}
