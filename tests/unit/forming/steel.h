#ifndef tribodraw_tests_unit_forming_steel_h
#define tribodraw_tests_unit_forming_steel_h

#include <string>

/// Mild steel of the NUMISHEET'93 square cup: entries of a section `Sheet material` but for the yield locus.
inline const std::string mild_steel = R"(
  set Young's modulus = 206 GPa
  set Poisson's ratio = 0.3
  set Hardening = Swift
  subsection Swift
    set Strength coefficient = 565.32 MPa
    set Initial strain = 0.007117
    set Hardening exponent = 0.2589
  end
)";

/// The same without anisotropy, as a whole section.
inline const std::string isotropic_steel
    = "subsection Sheet material\n  set Yield locus = von Mises" + mild_steel + "end\n";

#endif
