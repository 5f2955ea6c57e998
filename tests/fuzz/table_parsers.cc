// Parsers of tables and meshes: each reader stands in a few source files, small enough to be built for a fuzzer of
// their own.
#include "fuzz/hdf5_seeds.h"
#include "fuzz/parsers.h"
#include "fuzz/scratch_file.h"

#include <tribodraw/base/face_mesh.h>
#include <tribodraw/fluid/amount_map.h>
#include <tribodraw/friction_table/coefficient_table.h>
#include <tribodraw/friction_table/friction_table.h>
#include <tribodraw/output/measured_table.h>
#include <tribodraw/shell/blank_mesh.h>

using namespace tribodraw;

namespace
{
  std::string
  sample_coefficients()
  {
    CoefficientTable table;
    table.pressures = { 1, 10, 100 };
    table.speeds    = { 10, 100 };
    table.strains   = { 0, 0.2 };
    for (int i = 0; i < 12; ++i)
      table.values.push_back(0.05 + 0.01 * i);
    return table.to_json().dump();
  }

  /// A small friction table that passes its checks.
  std::string
  sample_friction_table()
  {
    const Axis p{ { 1, 100 }, AxisScale::logarithmic }, eps{ { 0, 0.5 }, AxisScale::linear },
        s{ { 1e-3, 2e-3 }, AxisScale::linear };
    const Table<2> cut({ p, eps }, { 2e-3, 1.8e-3, 1.2e-3, 1e-3 });
    FrictionTable  table;
    auto          &c   = table.curves;
    c.cut_height       = s.points;
    c.contact_fraction = { 0.5, 0.1 };
    c.h_avg            = { 5e-4, 1.5e-3 };
    c.phi_p_xx = c.phi_p_yy = { 0.5, 0.9 };
    c.phi_s_xx = c.phi_s_yy = { 0.3, 0.2 };
    c.phi_p_xy = c.phi_p_yx = c.phi_s_xy = c.phi_s_yx = { 0, 0 };
    table.cut_height_normal = table.cut_height_monotone = cut;
    table.strain_load_per_descent                       = Table<3>({ p, eps, s }, std::vector<double>(8, 1e4));
    table.boundary_layer_shear                          = Table<1>({ p }, { 1, 20 });
    table.shear_strength                                = Table<1>({ eps }, { 100, 200 });
    table.ploughing_coefficient                         = Table<2>({ p, eps }, std::vector<double>(4, 0.01));
    table.sq                                            = 1e-3;
    table.initial_cut_height                            = 3e-3;
    return table.to_json().dump();
  }

  std::vector<FuzzedParser>
  make_parsers()
  {
    const std::string csv = "time_s,punch_travel_mm,punch_force_n\n0,0,0\n0.5,1e-3,2.25e4\n1,2,3\r\n";
    const std::string mesh
        = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n6\n1 0 0 0.5\n2 1 0 0.5\n3 2 0 0.5\n4 0 1 0.5\n5 1 1 0.5\n6 2 "
          "1 0.5\n"
          "$EndNodes\n$Elements\n3\n1 15 2 0 1 1\n2 3 2 7 1 1 2 5 4\n3 2 2 7 1 2 3 6\n$EndElements\n";
    const std::string new_mesh = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 4 1 4\n2 1 0 4\n1\n2\n3\n4\n0 0 0\n1 "
                                 "0 0\n0 1 0\n1 1 0\n$EndNodes\n"
                                 "$Elements\n1 2 1 2\n2 1 2 2\n1 1 2 3\n2 2 4 3\n$EndElements\n";
    const std::string abaqus
        = "*HEADING\n** a blank\n*PART, NAME=Blank\n*NODE\n1, 0., 0.\n2, 1., 0.\n3, 1., 1.\n4, 0., 1.\n*ELEMENT, "
          "TYPE=S4R,\n"
          "ELSET=All\n1, 1, 2, 3, 4\n*ELEMENT, TYPE=S3\n2, 1, 2, 3\n*ELSET, ELSET=B, GENERATE\n1, 2, 1\n*END PART\n"
          "*ASSEMBLY, NAME=A\n*INSTANCE, NAME=Blank-1, PART=Blank\n0., 0., 5.\n0., 0., 0., 0., 0., 1., 90.\n"
          "*END INSTANCE\n*ELSET, ELSET=C, INSTANCE=Blank-1\n1, 2\n*END ASSEMBLY\n";
    const std::string ls_dyna = "*KEYWORD\n$ a blank\n*PART\nblank\n         7         1\n*NODE\n"
                                "       1             0.0             0.0             0.0       0       0\n"
                                "       2             1.0             0.0             0.0\n3,1.0,1.0,0.0\n4,0,1.+0,0\n"
                                "*ELEMENT_SHELL_THICKNESS\n       1       7       1       2       3       4\n"
                                "             0.8             0.8             0.8             0.8\n*ELEMENT_SHELL\n    "
                                "   2       7       1       2       3       3\n*END\n";
    return {
      { "measured table",
        true,
        [](const std::string &text) { read_measured_table(ScratchFile(text).path().string()); },
        { csv } },
      { "hdf5 table", false,
        [](const std::string &content) { read_measured_table(ScratchFile(content, ".h5").path().string()); },
        hdf5_seeds() },
      { "friction table",
        true,
        [](const std::string &text) { FrictionTable::read(ScratchFile(text).path()); },
        { sample_friction_table() } },
      { "coefficient table",
        true,
        [](const std::string &text) { CoefficientTable::read(ScratchFile(text).path()); },
        { sample_coefficients() } },
      { "gmsh",
        true,
        [](const std::string &text) { read_blank_mesh(ScratchFile(text, ".msh").path()); },
        { mesh, new_mesh } },
      { "abaqus", true, [](const std::string &text) { read_face_mesh(ScratchFile(text, ".inp").path()); }, { abaqus } },
      { "ls dyna", true, [](const std::string &text) { read_face_mesh(ScratchFile(text, ".k").path()); }, { ls_dyna } },
      { "amount map",
        true,
        [](const std::string &text) { AmountMap::read(ScratchFile(text).path()).asymmetry(); },
        { "x_mm,y_mm,amount_g_per_m2\n0,0,1\n0,9,2\n9,0,1\n9,9,0\n",
          "x_mm,amount_punch_g_per_m2,amount_die_g_per_m2\n-5,1,1.5\n5,2,2.5\n" } },
    };
  }
} // namespace

const std::vector<FuzzedParser> &
table_parsers()
{
  static const std::vector<FuzzedParser> parsers = make_parsers();
  return parsers;
}
