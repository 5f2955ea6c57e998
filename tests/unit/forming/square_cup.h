#ifndef tribodraw_tests_unit_forming_square_cup_h
#define tribodraw_tests_unit_forming_square_cup_h

#include "unit/forming/steel.h"

/// NUMISHEET'93 square cup in mild steel: tools, blank, Hill 1948 and Swift constants of the benchmark; speed of our own.
inline const std::string square_cup = R"(
subsection Blank
  set Length = 150 mm
  set Width = 150 mm
  set Thickness = 0.78 mm
  set Element size = 2.0833333 mm
end
subsection Sheet material
  set Yield locus = Hill 1948
  subsection Hill 1948
    set R0 = 1.79
    set R45 = 1.51
    set R90 = 2.27
  end)" + mild_steel + R"(end
subsection Tools
  subsection Die
    set Model = square die
    subsection Square die
      set Width in x = 74 mm
      set Width in y = 74 mm
      set Corner radius = 12 mm
      set Clearance = 0 mm
      set Edge radius = 5 mm
    end
  end
  subsection Punch
    set Model = square punch
    subsection Square punch
      set Width in x = 70 mm
      set Width in y = 70 mm
      set Corner radius = 10 mm
      set Edge radius = 8 mm
    end
  end
end
subsection Process
  set Punch travel = 40 mm
  set Punch speed = 10 mm/s
  set Blank holder force = 19.6 kN
end
)";

#endif
