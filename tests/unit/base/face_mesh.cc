// Finite-element meshes, written here from the formats' definitions.
#include <tribodraw/base/errors.h>
#include <tribodraw/base/face_mesh.h>

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <filesystem>
#include <fstream>
#include <unistd.h>

using namespace tribodraw;

namespace
{
  class Folder
  {
  public:
    Folder()
    {
      static int n = 0;
      path         = std::filesystem::temp_directory_path()
             / ("tribodraw_faces_" + std::to_string(::getpid()) + "_" + std::to_string(++n));
      std::filesystem::create_directories(path);
    }
    ~Folder() { std::filesystem::remove_all(path); }

    std::filesystem::path
    write(const std::string &name, const std::string &text) const
    {
      std::ofstream(path / name, std::ios::binary) << text;
      return path / name;
    }

  private:
    std::filesystem::path path;
  };

  FaceMesh
  read(const std::string &name, const std::string &text, const std::string &part = "")
  {
    const Folder folder;
    return read_face_mesh(folder.write(name, text), part);
  }

  std::string
  message(const std::string &name, const std::string &text, const std::string &part = "")
  {
    try
      {
        read(name, text, part);
      }
    catch (const InputError &e)
      {
        return e.what();
      }
    return "accepted";
  }

  /// Vector area: half of the sum of the cross products of the sides.
  Eigen::Vector3d
  area(const FaceMesh &mesh)
  {
    Eigen::Vector3d sum(0, 0, 0);
    for (const auto &t : mesh.triangles)
      sum += 0.5 * (mesh.nodes[t[1]] - mesh.nodes[t[0]]).cross(mesh.nodes[t[2]] - mesh.nodes[t[0]]);
    return sum;
  }

  std::string
  with(std::string text, const std::string &old_part, const std::string &new_part)
  {
    const auto at = text.find(old_part);
    EXPECT_NE(at, std::string::npos) << old_part;
    return text.replace(at, old_part.size(), new_part);
  }

  void
  expect_messages(const std::string &name, const std::string &good,
                  const std::vector<std::array<std::string, 3>> &mistakes)
  {
    ASSERT_EQ(message(name, good), "accepted");
    for (const auto &[old_part, new_part, expected] : mistakes)
      {
        const std::string text = message(name, with(good, old_part, new_part));
        EXPECT_NE(text.find(expected), std::string::npos) << new_part << ": " << text;
      }
  }

  /// A square 2 x 2 and a triangle on its right side, an instance of it turned by 90 degrees about the x axis, and
  /// another part; a beam and a mass, which have no area.
  const std::string abaqus
      = "*Heading\n** comment\n*Part, name=Sheet\n*Node\n 1, 0., 0., 0.\n 2, 2., 0., 0.\n 3, 2., 2., 0.\n"
        " 4, 0., 2.\n 5, 4., 0., 0.\n 9, 1D2, 1.E+02, 7-1\n*Element, type=S4R, elset=Square\n 10, 1, 2, 3, 4\n"
        "*Element, type=S3,\n elset=\"Right side\"\n 11, 2, 5, 3\n*Element, type=B31\n 12, 1, 9\n"
        "*Elset, elset=Both, generate\n 10, 11, 1\n*End Part\n"
        "*Part, name=Tool\n*Node\n 1, 0, 0, 0\n 2, 1, 0, 0\n 3, 0, 1, 0\n*Element, type=R3D3\n 1, 1, 2, 3\n*End Part\n"
        "*Assembly, name=Assembly\n*Instance, name=Sheet-1, part=Sheet\n*End Instance\n"
        "*Instance, name=Tool-1, part=Tool\n 0., 0., 5.\n 0., 0., 5., 1., 0., 5., 90.\n*End Instance\n"
        "*Elset, elset=Chosen, instance=Sheet-1\n 11,\n*End Assembly\n*Step\n*Static\n0.1, 1.\n*End Step\n";

  const std::string dyna
      = "$ before\n*KEYWORD\n*TITLE\nA model\n*PART\n$ heading\nThe sheet\n         3         1         1\n"
        "*SECTION_SHELL\n         1         2\n       0.8       0.8       0.8       0.8\n*NODE\n"
        "       1             0.0             0.0             0.0       0       0\n"
        "       2       2.0000000      0.0000E+00             0.0       0       0\n"
        "       3             2.0             2.0\n"
        "4,0.,2.,0.\n       5             4.0             0.0             0.0\n"
        "*ELEMENT_SHELL_THICKNESS\n      10       3       1       2       3       4\n"
        "             0.8             0.8             0.8             0.8\n"
        "*ELEMENT_SHELL\n      11       4       2       5       3       3\n"
        "*ELEMENT_MASS\n       1       1             1.0\n*END\nwhat follows is not read\n";
} // namespace

TEST(FaceMesh, AbaqusPartsAreReadAtTheirPlaces)
{
  // The square 4, the triangle 2; the tool's triangle 0.5, its normal z turned to -y.
  EXPECT_LT((area(read("a.inp", abaqus)) - Eigen::Vector3d(0, -0.5, 6)).norm(), 1e-14);
  EXPECT_LT((area(read("a.inp", abaqus, "sheet")) - Eigen::Vector3d(0, 0, 6)).norm(), 1e-14);
  EXPECT_LT((area(read("a.inp", abaqus, "Square")) - Eigen::Vector3d(0, 0, 4)).norm(), 1e-14);
  EXPECT_LT((area(read("a.inp", abaqus, "RIGHT SIDE")) - Eigen::Vector3d(0, 0, 2)).norm(), 1e-14);
  EXPECT_LT((area(read("a.inp", abaqus, "Both")) - Eigen::Vector3d(0, 0, 6)).norm(), 1e-14);
  EXPECT_LT((area(read("a.inp", abaqus, "Chosen")) - Eigen::Vector3d(0, 0, 2)).norm(), 1e-14);
  const FaceMesh tool = read("a.inp", abaqus, "Tool-1");
  EXPECT_LT((area(tool) - Eigen::Vector3d(0, -0.5, 0)).norm(), 1e-14);
  for (const auto &x : tool.nodes)
    EXPECT_NEAR(x.y(), 0, 1e-14); // turned about the axis through its shifted origin
  const FaceMesh square = read("a.inp", abaqus, "Square");
  EXPECT_EQ(square.nodes.size(), 4u);
  EXPECT_EQ(square.elements, (std::vector<std::int64_t>{ 10, 10 }));
}

TEST(FaceMesh, AbaqusWithoutPartsAndWithAnIncludedFile)
{
  const Folder folder;
  folder.write("nodes.inc", "*NODE\n1,0,0\n2,2,0\n3,2,2\n4,0,2\n");
  const auto     file = folder.write("b.inp", "*INCLUDE, INPUT=nodes.inc\n*ELEMENT, TYPE=R3D4, ELSET=DIE\n1,1,2,3,4\n");
  const FaceMesh mesh = read_face_mesh(file, "die");
  EXPECT_LT((area(mesh) - Eigen::Vector3d(0, 0, 4)).norm(), 1e-14);
  folder.write("nodes.inc", "*INCLUDE, INPUT=b.inp\n");
  try
    {
      read_face_mesh(file);
      ADD_FAILURE() << "files that include each other must be refused";
    }
  catch (const InputError &e)
    {
      EXPECT_NE(std::string(e.what()).find("too often"), std::string::npos) << e.what();
    }
}

TEST(FaceMesh, AbaqusMistakesAreNamed)
{
  expect_messages("a.inp", abaqus,
                  { { " 2, 2., 0., 0.", " 2, two, 0., 0.", "line 6" },
                    { " 2, 2., 0., 0.", " 1, 2., 0., 0.", "same number" },
                    { " 10, 1, 2, 3, 4", " 10, 1, 2, 3, 8", "element 10" },
                    { " 10, 1, 2, 3, 4", " 10, 1, 2, 3", "4 for S4R" },
                    { "type=S4R", "type=C3D8", "'C3D8'" },
                    { "type=S4R", "type=S8R", "'S8R'" },
                    { "part=Tool", "part=Tol", "'Tol'" },
                    { "1., 0., 5., 90.", "1., 0., 5.", "seven numbers" },
                    { "1., 0., 5., 90.", "0., 0., 5., 90.", "axis" },
                    { "*Elset, elset=Both", "*Elgen, elset=Both", "*ELGEN" },
                    { "*Node\n 1, 0., 0., 0.", "*Node, system=C\n 1, 0., 0., 0.", "Cartesian" },
                    { "10, 11, 1", "10, 99999999999, 1", "make no set" },
                    { "instance=Sheet-1", "instance=Sheet-2", "'Sheet-2'" } });
  const std::string wrong = message("a.inp", abaqus, "shet");
  EXPECT_NE(wrong.find("Did you mean 'Sheet'"), std::string::npos) << wrong;
  // With the part of the tool alone, what the other part is made of does not matter.
  EXPECT_EQ(message("a.inp", with(abaqus, "type=S4R", "type=C3D8"), "Tool"), "accepted");
}

TEST(FaceMesh, LsDynaFormats)
{
  EXPECT_LT((area(read("a.k", dyna)) - Eigen::Vector3d(0, 0, 6)).norm(), 1e-14);
  EXPECT_LT((area(read("a.key", dyna, "3")) - Eigen::Vector3d(0, 0, 4)).norm(), 1e-14);
  EXPECT_LT((area(read("a.dyn", dyna, "the SHEET")) - Eigen::Vector3d(0, 0, 4)).norm(), 1e-14);
  EXPECT_LT((area(read("a.k", dyna, "4")) - Eigen::Vector3d(0, 0, 2)).norm(), 1e-14);
  const auto columns = [](const std::vector<std::string> &fields, const unsigned first, const unsigned other) {
    std::string line;
    for (std::size_t k = 0; k < fields.size(); ++k)
      line += std::string((k == 0 ? first : other) - fields[k].size(), ' ') + fields[k];
    return line + "\n";
  };
  // The same triangle with numbers of 10 columns and with 20 columns everywhere, for the file or for a keyword.
  for (const bool wide : { false, true })
    for (const bool whole_file : { false, true })
      {
        const std::string sign = whole_file ? "" : wide ? " +" : " %";
        std::string text = whole_file ? std::string("*KEYWORD ") + (wide ? "LONG=Y" : "I10=Y") + "\n" : "*KEYWORD\n";
        text += "*NODE" + sign + "\n";
        const unsigned n = wide ? 20 : 10, x = wide ? 20 : 16;
        text += columns({ "1000000001", "0.", "0.", "0." }, n, x) + columns({ "1000000002", "2.", "0.", "0." }, n, x)
                + columns({ "1000000003", "2.", "2.", "-1.5" }, n, x);
        text += "*ELEMENT_SHELL" + sign + "\n"
                + columns({ "1", "1", "1000000001", "1000000002", "1000000003", "0" }, n, n);
        EXPECT_LT((area(read("a.k", text)) - Eigen::Vector3d(0, 1.5, 2)).norm(), 1e-14) << text;
      }
}

TEST(FaceMesh, LsDynaMistakesAreNamed)
{
  expect_messages(
      "a.k", dyna,
      { { "2.0000000 ", "2.00x0000 ", "line 14" },
        { "       3             2.0", "       2             2.0", "same number" },
        { "       2       5       3       3", "       2       6       3       3", "element 11" },
        { "*ELEMENT_SHELL\n", "*ELEMENT_SHELL_COMPOSITE\n", "SHELL_COMPOSITE" },
        { "*ELEMENT_MASS", "*ELEMENT_SOLID", "volume" },
        { "*TITLE", "*PARAMETER", "*PARAMETER" },
        { "*TITLE\nA model", "*INCLUDE\nnowhere.k", "nowhere.k" },
        { "             0.8             0.8             0.8             0.8\n*ELEMENT_SHELL\n", "*ELEMENT_SHELL\n",
          "second card" },
        { "       2       5       3       3", "       2       5       3       3       1", "second order" } });
  const std::string wrong = message("a.k", dyna, "5");
  EXPECT_NE(wrong.find("The sheet, 4"), std::string::npos) << wrong;
}

TEST(FaceMesh, LsDynaIncludedFile)
{
  const Folder folder;
  folder.write("tool nodes.k", "*NODE\n1,0,0,0\n2,2,0,0\n3,0,2,0\n*END\n");
  const auto file = folder.write("c.k", "*KEYWORD\n*INCLUDE\ntool +\nnodes.k\n*ELEMENT_SHELL\n1,1,1,2,3,0\n*END\n");
  EXPECT_NE(message("d.k", "*INCLUDE\nd.k\n").find("too often"), std::string::npos);
  // The name goes on behind its blank and plus sign.
  folder.write("toolnodes.k", "*NODE\n1,0,0,0\n2,2,0,0\n3,0,2,0\n*END\n");
  EXPECT_LT((area(read_face_mesh(file)) - Eigen::Vector3d(0, 0, 2)).norm(), 1e-14);
}

TEST(FaceMesh, GmshGroups)
{
  const std::string old_format = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n1 5 \"edge\"\n2 7 \"the "
                                 "sheet\"\n$EndPhysicalNames\n$Nodes\n5\n"
                                 "1 0 0 0\n2 2 0 0\n3 2 2 0\n4 0 2 0\n5 4 0 0\n$EndNodes\n$Elements\n3\n1 1 2 5 1 1 "
                                 "2\n2 3 2 7 1 1 2 3 4\n3 2 2 8 1 2 5 3\n"
                                 "$EndElements\n";
  const std::string new_format = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 7 \"the "
                                 "sheet\"\n$EndPhysicalNames\n$Entities\n1 1 2 0\n"
                                 "1 0 0 0 0\n1 0 0 0 2 0 0 0 0\n1 0 0 0 2 2 0 1 7 0\n2 0 0 0 2 2 0 1 8 "
                                 "0\n$EndEntities\n$Nodes\n1 5 1 5\n2 1 0 5\n1\n2\n3\n4\n5\n"
                                 "0 0 0\n2 0 0\n2 2 0\n0 2 0\n4 0 0\n$EndNodes\n$Elements\n2 2 1 2\n2 1 3 1\n1 1 2 3 "
                                 "4\n2 2 2 1\n2 2 5 3\n$EndElements\n";
  for (const auto &text : { old_format, new_format })
    {
      EXPECT_LT((area(read("a.msh", text)) - Eigen::Vector3d(0, 0, 6)).norm(), 1e-14);
      EXPECT_LT((area(read("a.msh", text, "the sheet")) - Eigen::Vector3d(0, 0, 4)).norm(), 1e-14);
      EXPECT_LT((area(read("a.msh", text, "7")) - Eigen::Vector3d(0, 0, 4)).norm(), 1e-14);
      EXPECT_LT((area(read("a.msh", text, "8")) - Eigen::Vector3d(0, 0, 2)).norm(), 1e-14);
      EXPECT_NE(message("a.msh", text, "sheet").find("the sheet, 8"), std::string::npos)
          << message("a.msh", text, "sheet");
    }
}

TEST(FaceMesh, UnknownFormatsAndEmptyFiles)
{
  EXPECT_TRUE(is_face_mesh("x/Die.INP"));
  EXPECT_FALSE(is_face_mesh("x/die.stl"));
  EXPECT_NE(message("a.nas", "").find(".inp"), std::string::npos);
  for (const char *name : { "a.inp", "a.k", "a.msh" })
    EXPECT_NE(message(name, "").find("no triangles"), std::string::npos);
  EXPECT_THROW(read_face_mesh("/nowhere/a.inp"), InputError);
}

TEST(FaceMesh, EveryShortenedFileIsReadOrRefused)
{
  // Whatever is cut off: a mesh or an InputError, and nothing else.
  for (const auto &[name, text] : { std::make_pair("a.inp", abaqus), std::make_pair("a.k", dyna) })
    {
      std::size_t refused = 0;
      for (std::size_t n = 0; n < text.size(); ++n)
        refused += message(name, text.substr(0, n)) != "accepted";
      EXPECT_GT(refused, text.size() / 3) << name; // before the first element is complete
    }
}
