#include "temporary_folder.h"

#include <tribodraw/base/errors.h>
#include <tribodraw/base/files.h>
#include <tribodraw/output/vtu.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <zlib.h>

using namespace tribodraw;

namespace
{
  SurfaceFields
  two_triangles()
  {
    SurfaceFields fields;
    fields.points       = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0.5 }, { 0, 1, 0 } };
    fields.triangles    = { { { 0, 1, 2 } }, { { 0, 2, 3 } } };
    fields.node_scalars = { { "friction_coefficient_die", { 0.1, 0.2, NAN, 0.4 } } };
    fields.node_vectors = { { "displacement", { { 0, 0, 0 }, { 1, 2, 3 }, { 4, 5, 6 }, { 7, 8, 9 } } } };
    fields.cell_scalars = { { "thickness", { 0.82, 0.8 } } };
    fields.units        = { { "thickness", "mm" } };
    fields.time         = 0.25;
    return fields;
  }

  /// Numbers of a compressed DataArray (VTK file formats: base64 of four UInt32 - blocks, block size, last block size,
  /// compressed size - followed by base64 of the zlib stream).
  std::vector<float>
  data_array(const std::string &vtu, const std::string &name)
  {
    auto begin = vtu.find("Name=\"" + name + "\"");
    EXPECT_NE(begin, std::string::npos) << name;
    begin                      = vtu.find('>', begin) + 1;
    std::string       base64   = vtu.substr(begin, vtu.find('<', begin) - begin);
    const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const auto        decode   = [&](const std::string &text) {
      std::string bytes;
      unsigned    bits = 0, n = 0;
      for (const char c : text)
        if (const auto at = alphabet.find(c); at != std::string::npos)
          {
            bits = 64 * bits + static_cast<unsigned>(at);
            n += 6;
            if (n >= 8)
              {
                n -= 8;
                bytes += static_cast<char>((bits >> n) & 255);
              }
          }
      return bytes;
    };
    base64.erase(0, base64.find_first_not_of(" \n"));
    const std::string header = decode(base64.substr(0, 24)),
                      body   = decode(base64.substr(24)); // 16 bytes are 24 characters
    unsigned sizes[4];
    std::memcpy(sizes, header.data(), sizeof sizes);
    std::vector<float> values(sizes[1] / sizeof(float));
    uLongf             length = sizes[1];
    EXPECT_EQ(uncompress(reinterpret_cast<Bytef *>(values.data()), &length,
                         reinterpret_cast<const Bytef *>(body.data()), body.size()),
              Z_OK);
    return values;
  }
} // namespace

TEST(Vtu, fields_read_back)
{
  const TemporaryFolder folder;
  write_vtu(folder / "step.vtu", two_triangles());
  EXPECT_EQ(TemporaryFolder::parse_xml({ folder / "step.vtu" }), 0);
  const std::string vtu = read_file(folder / "step.vtu");

  // Three points a triangle, in the order of its nodes 0 1 2 and 0 2 3.
  const auto friction = data_array(vtu, "friction_coefficient_die");
  ASSERT_EQ(friction.size(), 6u);
  EXPECT_EQ(friction[1], 0.2f);
  EXPECT_TRUE(std::isnan(friction[2])); // not in contact
  EXPECT_EQ(friction[5], 0.4f);
  const auto displacement = data_array(vtu, "displacement");
  ASSERT_EQ(displacement.size(), 18u);
  EXPECT_EQ(displacement[3], 1.f);  // node 1, x
  EXPECT_EQ(displacement[17], 9.f); // node 3, z
  EXPECT_EQ(data_array(vtu, "thickness"), (std::vector<float>{ 0.82f, 0.82f, 0.82f, 0.8f, 0.8f, 0.8f }));
  EXPECT_NE(vtu.find("units=\"mm\""), std::string::npos);
  EXPECT_NE(vtu.find("TIME"), std::string::npos);
}

TEST(Vtu, same_fields_give_the_same_bytes)
{
  const TemporaryFolder folder;
  write_vtu(folder / "a.vtu", two_triangles());
  write_vtu(folder / "b.vtu", two_triangles());
  EXPECT_EQ(read_file(folder / "a.vtu"), read_file(folder / "b.vtu"));
}

TEST(Vtu, a_field_of_wrong_length_is_named)
{
  const TemporaryFolder folder;
  SurfaceFields         fields = two_triangles();
  fields.cell_scalars["eps_p"] = { 1. };
  try
    {
      write_vtu(folder / "step.vtu", fields);
      FAIL() << "no error";
    }
  catch (const InputError &error)
    {
      EXPECT_NE(std::string(error.what()).find("'eps_p'"), std::string::npos) << error.what();
    }
  EXPECT_FALSE(std::filesystem::exists(folder / "step.vtu"));
}

TEST(Pvd, collection_is_valid_xml_with_all_steps_in_order)
{
  const TemporaryFolder folder;
  PvdCollection         steps;
  steps.add(0, "solution-00000.vtu");
  steps.add(0.1, "solution-00001.vtu");
  steps.save(folder / "solution.pvd");
  EXPECT_EQ(TemporaryFolder::parse_xml({ folder / "solution.pvd" }), 0);
  const std::string text  = read_file(folder / "solution.pvd");
  const auto        first = text.find("timestep=\"0\""), second = text.find("timestep=\"0.1\"");
  EXPECT_LT(first, second);
  EXPECT_LT(second, text.size());
  EXPECT_LT(text.find("solution-00001.vtu", second), text.size());
}
