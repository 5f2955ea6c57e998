#ifndef tribodraw_tests_unit_material_paper_material_h
#define tribodraw_tests_unit_material_paper_material_h

#include <tribodraw/base/parameters.h>
#include <tribodraw/material/hardening_law.h>
#include <tribodraw/material/sheet_material.h>
#include <tribodraw/material/yield_locus.h>

#include <memory>
#include <random>
#include <string>

/// DC04 with the data of Shisode et al. (2021), Tables 2 and 3, and other laws for comparison.
namespace paper
{
  inline const std::string vegter              = "set R values              = 1.92667, 1.49433, 2.21133\n"
                                                 "set Uniaxial factors      = 1, 1.0310, 0.9885\n"
                                                 "set Plane strain factors  = 1.248, 1.2401, 1.265\n"
                                                 "set Plane strain ratios   = 0.599354, 0.587015, 0.608288\n"
                                                 "set Shear factors         = 0.543471, 0.56135, 0.5398\n"
                                                 "set Equibiaxial factor    = 1.132\n"
                                                 "set Equibiaxial ratio     = 0.8988\n";
  inline const std::string vegter_interpolated = vegter + "set Hinge points = interpolated\n";
  inline const std::string hill                = "set R0 = 1.79\nset R45 = 1.51\nset R90 = 2.27\n";

  inline const std::string bergstroem_van_liempt = "set Initial stress     = 114.8 MPa\n"
                                                   "set Stress increment   = 250.34 MPa\n"
                                                   "set Linear hardening   = 0.25\n"
                                                   "set Remobilisation     = 8.1014\n"
                                                   "set Hardening exponent = 0.75\n"
                                                   "set Initial strain     = 0.005\n"
                                                   "set Dynamic stress     = 600 MPa\n"
                                                   "set Dynamic exponent   = 2.2\n"
                                                   "set Limit strain rate  = 1e8 1/s\n"
                                                   "set Temperature        = 300 K\n"
                                                   "set Activation energy  = 0.8 eV\n"
                                                   "set Boltzmann constant = 8.617e-5 eV/K\n";
  inline const std::string swift                 = "set Strength coefficient = 565.32 MPa\n"
                                                   "set Initial strain = 0.007117\n"
                                                   "set Hardening exponent = 0.2589\n";

  /// AA2090-T3 (Barlat et al. 2003); AA6016-T4 (Habraken et al. 2022, Swift; Voce of another laboratory).
  inline const std::string aluminium
      = "set Exponent = 8\nset Coefficients = given\nset Alpha = 0.4865, 1.3783, 0.7536, "
        "1.0246, 1.0363, 0.9036, 1.2321, 1.4858\n";
  inline const std::string voce
      = "set Initial stress = 140.2 MPa\nset Saturation stress = 330.2 MPa\nset Saturation rate = 12.4\n";
  inline const std::string swift_voce = "set Weight of Swift = 0.4\nset Strength coefficient = 498.8 MPa\n"
                                        "set Initial strain = 0.0089\nset Hardening exponent = 0.285\n"
                                        + voce;

  template <class Interface>
  std::unique_ptr<Interface>
  make(const std::string &name, const std::string &text)
  {
    auto parameters = tribodraw::Parameters::from_text(text);
    auto result     = tribodraw::Registry<Interface>::entries().at(name).create(parameters);
    parameters.finish();
    return result;
  }

  inline std::shared_ptr<const tribodraw::YieldLocus>
  locus(const std::string &name)
  {
    using tribodraw::YieldLocus;
    if (name == "Vegter")
      return make<YieldLocus>("Vegter", vegter);
    if (name == "Vegter interpolated")
      return make<YieldLocus>("Vegter", vegter_interpolated);
    if (name == "Hill 1948")
      return make<YieldLocus>("Hill 1948", hill);
    if (name == "Yld2000-2d")
      return make<YieldLocus>("Yld2000-2d", aluminium);
    return make<YieldLocus>("von Mises", "");
  }

  inline std::shared_ptr<const tribodraw::HardeningLaw>
  hardening(const std::string &name)
  {
    using tribodraw::HardeningLaw;
    if (name == "Swift")
      return make<HardeningLaw>("Swift", swift);
    if (name == "Voce")
      return make<HardeningLaw>("Voce", voce);
    if (name == "Swift-Voce")
      return make<HardeningLaw>("Swift-Voce", swift_voce);
    return make<HardeningLaw>("Bergstroem-van Liempt", bergstroem_van_liempt);
  }

  inline tribodraw::SheetMaterial
  sheet(const std::string &locus_name, const std::string &hardening_name)
  {
    return { 210e3, 0.3, locus(locus_name), hardening(hardening_name) };
  }

  /// A stress of length one in a random direction of (sxx, syy, sxy).
  template <class Generator>
  tribodraw::Vector3
  random_direction(Generator &generator)
  {
    std::normal_distribution<double> normal;
    const double                     a = normal(generator), b = normal(generator), c = normal(generator);
    return tribodraw::Vector3(a, b, c).normalized();
  }
} // namespace paper

#endif
