#include "temporary_folder.h"

#include <tribodraw/base/files.h>
#include <tribodraw/output/paraview.h>

#include <gtest/gtest.h>

#include <cstdlib>

using namespace tribodraw;

// That ParaView draws it is tested with ParaView itself where it is installed (tests/report/paraview.py).
TEST(Paraview, StateHoldsTheViewsAndNoPlaceOnThisMachine)
{
  const TemporaryFolder folder;
  write_paraview_state(folder / "", { { "Thinning", "thinning", ParaviewView::From::above },
                                      { "Lubricant pressure, die side / MPa", "lubricant_pressure_die",
                                        ParaviewView::From::outside_below } });
  const std::string text = read_file(folder / "view.py");
  EXPECT_NE(text.find("    ('Thinning', 'thinning', [0, 0, 1]),\n"), std::string::npos);
  EXPECT_NE(text.find("    ('Lubricant pressure, die side / MPa', 'lubricant_pressure_die', ["), std::string::npos);
  EXPECT_EQ(text.find(std::filesystem::path(folder / "").parent_path().string()), std::string::npos);
  const std::string command
      = "python3 -c 'import ast, sys; ast.parse(open(sys.argv[1]).read())' " + (folder / "view.py").string();
  EXPECT_EQ(std::system(command.c_str()), 0) << "not Python";
}
