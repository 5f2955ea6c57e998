#include "fuzz/hdf5_seeds.h"
#include "fuzz/parsers.h"
#include "fuzz/scratch_file.h"
#include "unit/friction_table/sample_pair.h"

#include <tribodraw/application/program.h>
#include <tribodraw/base/face_mesh.h>
#include <tribodraw/base/files.h>
#include <tribodraw/fluid/amount_map.h>
#include <tribodraw/friction_table/coefficient_table.h>
#include <tribodraw/friction_table/friction_table.h>
#include <tribodraw/output/measured_table.h>
#include <tribodraw/shell/blank_mesh.h>

#include <algorithm>
#include <filesystem>

using namespace tribodraw;
namespace fs = std::filesystem;

namespace
{
  std::vector<std::string>
  shipped_parameter_files()
  {
    std::vector<fs::path> files;
    for (const auto &entry : fs::directory_iterator(TRIBODRAW_SOURCE_DIR "/prm"))
      if (entry.path().extension() == ".prm")
        files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::vector<std::string> contents;
    for (const auto &file : files)
      contents.push_back(read_file(file));
    return contents;
  }

  void
  read_parameters(const std::string &text)
  {
    Parameters parameters = Parameters::from_text(text);
    const auto task       = create_task(parameters);
    parameters.finish();
    if (task)
      task->describe();
  }

  std::string
  sample_coefficients()
  {
    CoefficientTable table;
    table.pressures  = { 1, 10, 100 };
    table.speeds    = { 10, 100 };
    table.strains    = { 0, 0.2 };
    for (int i = 0; i < 12; ++i)
      table.values.push_back(0.05 + 0.01 * i);
    return table.to_json().dump();
  }

  std::vector<FuzzedParser>
  make_parsers()
  {
    const std::string csv = "time_s,punch_travel_mm,punch_force_n\n0,0,0\n0.5,1e-3,2.25e4\n1,2,3\r\n";
    const std::string mesh
        = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n6\n1 0 0 0.5\n2 1 0 0.5\n3 2 0 0.5\n4 0 1 0.5\n5 1 1 0.5\n6 2 1 0.5\n"
          "$EndNodes\n$Elements\n3\n1 15 2 0 1 1\n2 3 2 7 1 1 2 5 4\n3 2 2 7 1 2 3 6\n$EndElements\n";
    const std::string new_mesh
        = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 4 1 4\n2 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n$EndNodes\n"
          "$Elements\n1 2 1 2\n2 1 2 2\n1 1 2 3\n2 2 4 3\n$EndElements\n";
    const std::string abaqus
        = "*HEADING\n** a blank\n*PART, NAME=Blank\n*NODE\n1, 0., 0.\n2, 1., 0.\n3, 1., 1.\n4, 0., 1.\n*ELEMENT, TYPE=S4R,\n"
          "ELSET=All\n1, 1, 2, 3, 4\n*ELEMENT, TYPE=S3\n2, 1, 2, 3\n*ELSET, ELSET=B, GENERATE\n1, 2, 1\n*END PART\n"
          "*ASSEMBLY, NAME=A\n*INSTANCE, NAME=Blank-1, PART=Blank\n0., 0., 5.\n0., 0., 0., 0., 0., 1., 90.\n"
          "*END INSTANCE\n*ELSET, ELSET=C, INSTANCE=Blank-1\n1, 2\n*END ASSEMBLY\n";
    const std::string ls_dyna
        = "*KEYWORD\n$ a blank\n*PART\nblank\n         7         1\n*NODE\n"
          "       1             0.0             0.0             0.0       0       0\n"
          "       2             1.0             0.0             0.0\n3,1.0,1.0,0.0\n4,0,1.+0,0\n"
          "*ELEMENT_SHELL_THICKNESS\n       1       7       1       2       3       4\n"
          "             0.8             0.8             0.8             0.8\n*ELEMENT_SHELL\n       2       7       1       2       3       3\n*END\n";
    return {
      { "parameters", true, read_parameters, shipped_parameter_files() },
      { "measured table", true, [](const std::string &text) { read_measured_table(ScratchFile(text).path().string()); }, { csv } },
      { "hdf5 table", false, [](const std::string &content) { read_measured_table(ScratchFile(content, ".h5").path().string()); },
        hdf5_seeds() },
      { "friction table", true, [](const std::string &text) { FrictionTable::read(ScratchFile(text).path()); },
        { build_friction_table(test::sample_pair(64, true)).to_json().dump() } },
      { "coefficient table", true, [](const std::string &text) { CoefficientTable::read(ScratchFile(text).path()); },
        { sample_coefficients() } },
      { "gmsh", true, [](const std::string &text) { read_blank_mesh(ScratchFile(text, ".msh").path()); }, { mesh, new_mesh } },
      { "abaqus", true, [](const std::string &text) { read_face_mesh(ScratchFile(text, ".inp").path()); }, { abaqus } },
      { "ls dyna", true, [](const std::string &text) { read_face_mesh(ScratchFile(text, ".k").path()); }, { ls_dyna } },
      { "amount map", true, [](const std::string &text) { AmountMap::read(ScratchFile(text).path()).asymmetry(); },
        { "x_mm,y_mm,amount_g_per_m2\n0,0,1\n0,9,2\n9,0,1\n9,9,0\n",
          "x_mm,amount_punch_g_per_m2,amount_die_g_per_m2\n-5,1,1.5\n5,2,2.5\n" } },
    };
  }
} // namespace

const std::vector<FuzzedParser> &
fuzzed_parsers()
{
  static const std::vector<FuzzedParser> parsers = [] {
    std::vector<FuzzedParser> all = file_parsers(), program = make_parsers();
    all.insert(all.end(), program.begin(), program.end());
    return all;
  }();
  return parsers;
}
