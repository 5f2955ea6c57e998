// Files of triangles: what is read, and what is said of what cannot be read.
#include "triangle_samples.h"

#include <tribodraw/base/errors.h>
#include <tribodraw/base/files.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/base/units.h>
#include <tribodraw/tools/smooth_surface.h>

#include <gtest/gtest.h>

using namespace tribodraw;
using Eigen::Vector3d;
using triangle_samples::File;

namespace
{
  std::string
  refusal(const std::string &content, const std::string &extension = ".stl", const double unit = 1)
  {
    const File file(content, extension);
    try
      {
        SmoothSurface(read_triangles(file.path, unit), {});
      }
    catch (const InputError &e)
      {
        return e.what();
      }
    return "no error";
  }

  void
  expect(const std::string &message, const std::string &part)
  {
    EXPECT_NE(message.find(part), std::string::npos) << part << " in\n" << message;
  }

  std::unique_ptr<ToolGeometry>
  read(const std::string &entries)
  {
    Parameters parameters
        = Parameters::from_text("set Model = triangle surface\nsubsection Triangle surface\n" + entries + "end\n");
    auto tool = parameters.model<ToolGeometry>("Model", "Shape of the tool.");
    parameters.finish();
    return tool;
  }

  std::string
  message(const std::string &entries)
  {
    try
      {
        read(entries);
      }
    catch (const InputError &e)
      {
        return e.what();
      }
    return "no error";
  }
} // namespace

TEST(TriangleFiles, AllFormatsGiveTheSameSurface)
{
  const TriangleMesh mesh = triangle_samples::punch();
  const File ascii(triangle_samples::ascii_stl(mesh), ".stl"), binary(triangle_samples::binary_stl(mesh), ".STL");
  const File obj(triangle_samples::obj(mesh, false), ".obj");
  const SmoothSurface reference(mesh, {});
  for (const File *file : { &ascii, &binary, &obj })
    {
      const TriangleMesh read = read_triangles(file->path, 1);
      EXPECT_EQ(read.triangles.size(), mesh.triangles.size());
      EXPECT_EQ(read.vertices.size(), mesh.vertices.size());
      const SmoothSurface surface(read, {});
      for (const Vector3d &x : { Vector3d(3, 4, -2), Vector3d(20, 5, 1), Vector3d(0, 26, 12) })
        EXPECT_NEAR(surface.distance(x).distance, reference.distance(x).distance, 1e-4); // single precision, six digits
    }
}

TEST(TriangleFiles, HeadersOfBinaryFilesMayBeginWithSolid)
{
  std::string content = triangle_samples::binary_stl(triangle_samples::punch());
  content.replace(0, 12, "solid punch\n");
  const File file(content, ".stl");
  EXPECT_EQ(read_triangles(file.path, 1).triangles.size(), triangle_samples::punch().triangles.size());
}

TEST(TriangleFiles, ObjWithQuadranglesNormalsAndIndicesFromTheEnd)
{
  const File         file("# a ridge\nvn 0 0 1\nv 0 0 0\nv 10 0 0\nv 10 20 0 1.0\nv 0 20 0\nv 20 0 0\nv 20 20 0\n"
                                  "g face\ns 1\nf 1//1 2//1 3//1 4//1\nf -5//-1 -2//-1 -1//-1 3//1\n",
                          ".obj");
  const TriangleMesh mesh = read_triangles(file.path, 10); // a file in cm
  EXPECT_EQ(mesh.triangles.size(), 4u);
  EXPECT_EQ(mesh.normals.size(), 4u);
  const SmoothSurface surface(mesh, {});
  EXPECT_NEAR(surface.distance({ 150, 120, 7 }).distance, 7, 1e-12);
  EXPECT_NEAR(surface.extent().sizes()[0], 200, 1e-9);
}

TEST(TriangleFiles, CollapsedTrianglesAreLeftOut)
{
  const std::string sliver  = "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 0 0\nvertex 1 0 0\nendloop\n"
                              "endfacet\n";
  std::string       content = triangle_samples::ascii_stl(triangle_samples::punch());
  content.insert(content.find("facet"), sliver);
  const File file(content, ".stl");
  EXPECT_EQ(read_triangles(file.path, 1).triangles.size(), triangle_samples::punch().triangles.size());
}

TEST(TriangleFiles, WhatCannotBeReadIsExplained)
{
  const TriangleMesh mesh   = triangle_samples::punch();
  const std::string  binary = triangle_samples::binary_stl(mesh), ascii = triangle_samples::ascii_stl(mesh);
  expect(refusal(binary.substr(0, binary.size() - 20)), "truncated");
  std::string hostile = binary;
  hostile.replace(80, 4, "\xff\xff\xff\xff");
  expect(refusal(hostile), "214748364834 bytes"); // 84 + 50 (2^32 - 1)
  std::string not_finite = binary;
  not_finite.replace(84 + 12, 4, std::string("\0\0\xc0\x7f", 4));
  expect(refusal(not_finite), "triangle 1");
  expect(refusal(ascii.substr(0, ascii.size() / 2)), "line ");
  expect(refusal(ascii.substr(0, ascii.rfind("endsolid"))), "truncated");
  expect(refusal("solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 zero\n"), "line 4");
  expect(refusal("solid x\nendsolid x\n"), "no triangles");
  expect(refusal(""), "neither STL nor OBJ");
  expect(refusal("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), "must end in .obj");
  expect(refusal("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", ".obj"), "a corner does not exist");
  expect(refusal("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 2 2 0\nf 1 2 3 4 5\n", ".obj"), "3 or 4 corners");
  expect(refusal("v 0 0 0\nv 10 0 0\nv 0 10 0\nf 1 1 2\n", ".obj"), "collapsed");
  expect(refusal("v 0 0 1e30\nv 10 0 1e30\nv 0 10 1e30\nf 1 2 3\n", ".obj"), "far away from its origin");
}

TEST(TriangleFiles, AWrongUnitIsNoticed)
{
  const TriangleMesh mesh = triangle_samples::punch(); // 60 mm wide
  expect(refusal(triangle_samples::ascii_stl(mesh), ".stl", 1e-3), "0.06 x 0.06");
  expect(refusal(triangle_samples::ascii_stl(mesh), ".stl", 1e3), "`Unit`");
}

TEST(TriangleFiles, Entries)
{
  const File        file(triangle_samples::ascii_stl(triangle_samples::punch()), ".stl");
  const std::string path = "set File = " + file.path.string() + "\n";
  const auto        tool = read(path + "set Unit = 1 mm\n");
  // Under the flat face, which the smoothing leaves flat to a thousandth of a millimetre beside these coarse edges.
  EXPECT_NEAR(tool->distance({ 2, 3, -5 }).distance, 5, 1e-3);
  EXPECT_NEAR(read(path + "set Unit = 1 cm\n")->distance({ 20, 30, -50 }).distance, 50, 1e-2);
  EXPECT_NEAR(read(path + "set Unit = 1 mm\nset Normals = into the tool\n")->distance({ 2, 3, -5 }).distance, -5, 1e-3);
  expect(message(path), "Unit");
  expect(message("set File = nothing.stl\nset Unit = 1 mm\n"), "does not exist");
  expect(message(path + "set Unit = 1 mm\nset Feature angle = 5 deg\n"), "sharp edges");
  expect(message(path + "set Unit = 1 mm\nset Symmetry = x = 0\n"), "does not end at a plane of symmetry");
}

TEST(TriangleFiles, AMeshOfFiniteElementsIsTheSameTool)
{
  const TriangleMesh punch = triangle_samples::punch();
  std::string        text  = "*KEYWORD\n*PART\nPunch\n         2\n*NODE\n";
  for (std::size_t i = 0; i < punch.vertices.size(); ++i)
    {
      const Vector3d &x = punch.vertices[i];
      text += std::to_string(i + 1) + "," + units::number(x[0]) + "," + units::number(x[1]) + "," + units::number(x[2]) + "\n";
    }
  text += "*ELEMENT_SHELL\n";
  for (std::size_t t = 0; t < punch.triangles.size(); ++t)
    {
      const auto &v = punch.triangles[t];
      text += std::to_string(t + 1) + ",2," + std::to_string(v[0] + 1) + "," + std::to_string(v[1] + 1) + "," + std::to_string(v[2] + 1)
              + "," + std::to_string(v[2] + 1) + "\n";
    }
  const File         file(text, ".k");
  const TriangleMesh read = read_triangles(file.path, 1, "Punch");
  EXPECT_EQ(read.triangles.size(), punch.triangles.size());
  const SmoothSurface one(punch, {}), other(read, {});
  for (const double x : { 0., 10., 25., 28., 31. })
    EXPECT_NEAR(one.distance({ x, 2, -1 }).distance, other.distance({ x, 2, -1 }).distance, 1e-9);
  const std::string wrong = message("set File = " + file.path.string() + "\nset Unit = 1 mm\nset Part = Die\n");
  EXPECT_NE(wrong.find("no such part"), std::string::npos) << wrong;
}
