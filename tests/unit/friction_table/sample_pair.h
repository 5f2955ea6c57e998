#ifndef tribodraw_tests_friction_table_sample_pair_h
#define tribodraw_tests_friction_table_sample_pair_h

#include <tribodraw/base/parameters.h>
#include <tribodraw/flattening/height_distribution.h>
#include <tribodraw/friction_table/builder.h>
#include <tribodraw/surface/surface.h>

#include <algorithm>
#include <cmath>

namespace tribodraw::test
{
  /// A map like the paper's bimodal sheet: EDT-like, z = tanh(2.2 (g + 0.35)) + 0.12 r, correlation lengths 45 and 9
  /// um, Sq 1.60 um (model.md 9, T21). 0.636831 is the standard normal distribution at 0.35.
  inline std::string
  bimodal_sheet(const unsigned int pixels, const unsigned int seed = 1)
  {
    return "set Model = generated\n"
           "subsection Generated\n"
           "  set Texture = bimodal\n  set Pixels = "
           + std::to_string(pixels)
           + "\n  set Pixel size = 3 um\n  set Sq = 1.6 um\n  set Seed = " + std::to_string(seed)
           + "\n  subsection Bimodal\n"
             "    set Crater correlation length = 45 um\n    set Plateau area fraction = 0.636831\n"
             "    set Edge steepness = 2.2\n    set Fine roughness ratio = 0.12\n    set Fine correlation length = 9 "
             "um\n"
             "  end\nend\n";
  }

  inline std::string
  ground_tool(const unsigned int pixels)
  {
    return "set Model = generated\n"
           "subsection Generated\n"
           "  set Texture = gaussian\n  set Pixels = "
           + std::to_string(pixels)
           + "\n  set Pixel size = 3 um\n  set Sq = 0.3 um\n  set Seed = 5\n"
             "  subsection Gaussian\n    set Correlation length = 12 um\n  end\nend\n";
  }

  inline HeightMap
  make_surface(const std::string &text)
  {
    Parameters parameters = Parameters::from_text(text);
    const auto make       = read_surface(parameters);
    parameters.finish();
    return make();
  }

  template <class Interface>
  std::shared_ptr<const Interface>
  make_model(const std::string &name)
  {
    Parameters parameters = Parameters::from_text("");
    return Registry<Interface>::entries().at(name).create(parameters);
  }

  /// From 200 MPa, saturating towards 330 MPa: like a soft deep drawing steel.
  struct SaturatingHardening : HardeningLaw
  {
    FlowStress
    flow_stress(const double strain, double) const override
    {
      return { 200. + 130. * (1. - std::exp(-8. * strain)), 0., 0. };
    }
  };

  /// Closed-form flow factors, so that tests of the table need no cell problem.
  struct ClosedFormFactors : FlowFactorModel
  {
    std::vector<FlowFactors>
    compute(const HeightMap &sheet, const HeightMap &tool, const double sq, const std::vector<double> &cut_heights,
            const std::function<void(double)> &progress) const override
    {
      HeightMap sum = sheet;
      for (std::size_t i = 0; i < tool.z.size(); ++i)
        sum.z[i] += tool.z[i];
      const HeightDistribution heights(sum);
      std::vector<FlowFactors> result;
      for (const double s : cut_heights)
        {
          FlowFactors f;
          f.cut_height = s;
          f.h_avg      = heights.mean_gap(s);
          f.phi_p      = { phi_p(f.h_avg / sq), 0.01, 0.01, 0.8 * phi_p(f.h_avg / sq) };
          f.phi_s      = { phi_s(f.h_avg / sq), 0., 0., 0.9 * phi_s(f.h_avg / sq) };
          result.push_back(f);
        }
      if (progress)
        progress(1.);
      return result;
    }
    std::string
    fingerprint() const override
    {
      return "closed form";
    }
    static double
    phi_p(const double h)
    {
      return 1. - 0.9 * std::exp(-0.56 * h);
    }
    static double
    phi_s(const double h)
    {
      return h * std::exp(-h);
    }
  };

  inline BoundaryFriction
  paper_boundary_friction()
  {
    Parameters parameters = Parameters::from_text(
        "set Model = power law\nsubsection Power law\n set c0 = 11.2 Pa^0.25\n set m = 0.75\nend\n");
    BoundaryFriction friction = BoundaryFriction::read(parameters);
    parameters.finish();
    return friction;
  }

  inline PairDescription
  sample_pair(const unsigned int pixels, const bool rough_tool = false)
  {
    PairDescription pair;
    pair.sheet = make_surface(bimodal_sheet(pixels));
    if (rough_tool)
      pair.tool = make_surface(ground_tool(pixels));
    pair.flattening        = Flattening(make_model<AsperityModel>("Wilson-Sheu"), 25e-3, 0.1,
                                        make_model<BulkStrainLaw>("Westeneng"));
    pair.hardening         = std::make_shared<SaturatingHardening>();
    pair.boundary_friction = paper_boundary_friction();
    pair.flow_factors      = std::make_shared<ClosedFormFactors>();
    pair.axes
        = { { 0.5, 1, 2, 4, 7, 12, 20, 35, 60, 100 }, { 0, 0.02, 0.05, 0.1, 0.2, 0.3, 0.45, 0.65, 0.9 }, 12, 256 };
    return pair;
  }
} // namespace tribodraw::test

#endif
