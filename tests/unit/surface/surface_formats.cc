// Every variant of every format, written by the independent writer of format_samples, gives the same map.
#include "format_samples.h"
#include "temporary_folder.h"

#include <tribodraw/base/errors.h>
#include <tribodraw/base/files.h>
#include <tribodraw/surface/surface_reader.h>

#include <cmath>
#include <gtest/gtest.h>
#include <set>

using namespace tribodraw;
using namespace format_samples;

namespace
{
  class SurfaceFormats : public ::testing::Test
  {
  protected:
    const TemporaryFolder folder;

    HeightMap
    read(const std::string &content, const GivenScales &given = {}) const
    {
      // The name says nothing: formats are recognised by content.
      write_file(folder / "file.bin", content);
      return read_surface_file(folder / "file.bin", given);
    }

    std::string
    error_of(const std::string &content, const GivenScales &given = {}) const
    {
      try
        {
          read(content, given);
        }
      catch (const InputError &e)
        {
          return e.what();
        }
      return "accepted";
    }
  };

  // The digests of RFC 1321, A.5: the writer of the samples is right.
  TEST_F(SurfaceFormats, DigestOfTheSamplesIsThatOfTheStandard)
  {
    EXPECT_EQ(md5(""), "d41d8cd98f00b204e9800998ecf8427e");
    EXPECT_EQ(md5("abc"), "900150983cd24fb0d6963f7d28e17f72");
    EXPECT_EQ(md5("12345678901234567890123456789012345678901234567890123456789012345678901234567890"),
              "57edf4a22be3c955ac49da2e2107b67a");
  }

  TEST_F(SurfaceFormats, EveryVariantGivesTheSameMap)
  {
    const auto            samples = all_samples();
    std::set<std::string> formats;
    for (const Sample &sample : samples)
      {
        SCOPED_TRACE(sample.format + ", " + sample.variant);
        formats.insert(sample.format);
        HeightMap map;
        ASSERT_NO_THROW(map = read(sample.content, sample.given)) << error_of(sample.content, sample.given);
        ASSERT_EQ(map.nx, 5u);
        ASSERT_EQ(map.ny, 4u);
        // steps of SUR are 32-bit numbers
        EXPECT_NEAR(map.dx, sample.dx, 1e-7 * sample.dx);
        EXPECT_NEAR(map.dy, sample.dy, 1e-7 * sample.dy);
        for (std::size_t i = 0; i < sample.z.size(); ++i)
          if (std::isnan(sample.z[i]))
            EXPECT_TRUE(std::isnan(map.z[i])) << i;
          else
            EXPECT_NEAR(map.z[i], sample.z[i], sample.tolerance * 1e-3) << i;
      }
    EXPECT_EQ(formats.size(), 9u); // gsf, al3d, npy, sdf text and binary, sur, x3p, matrix, points
    RecordProperty("variants", static_cast<int>(samples.size()));
  }

  TEST_F(SurfaceFormats, ProvenanceIsKept)
  {
    const auto samples = sdf_samples();
    EXPECT_NE(read(samples[1].content).description.find("(SDF binary, test 040120100853), 5 x 4 pixels"),
              std::string::npos)
        << read(samples[1].content).description;
    EXPECT_NE(read(samples[1].content).description.find("2 points not measured"), std::string::npos);
  }

  TEST_F(SurfaceFormats, ScalesAreStatedOnce)
  {
    for (const Sample &sample : all_samples())
      {
        SCOPED_TRACE(sample.format + ", " + sample.variant);
        GivenScales other = sample.given;
        if (other.height_unit)
          other.height_unit.reset();
        else
          other.height_unit = 1e-3;
        EXPECT_NE(error_of(sample.content, other).find("`Height unit`"), std::string::npos);
        other = sample.given;
        if (other.pixel_size)
          other.pixel_size.reset();
        else
          other.pixel_size = std::array<double, 2>{ 1e-3, 1e-3 };
        EXPECT_NE(error_of(sample.content, other).find("`Pixel size`"), std::string::npos);
      }
  }
} // namespace
