// Damaged files: each is rejected with a message that names file, place and reason, or it is read as a plausible map.
#include "format_samples.h"
#include "guarded_read.h"

#include "fuzz/mutator.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <random>

using namespace tribodraw;
using namespace format_samples;

namespace
{
  constexpr int mutants_of_a_format = 1500; // 250 are asked for

  struct Statistics
  {
    int         mutants = 0, rejected = 0, unchanged = 0, plausible = 0;
    std::size_t peak_above_file = 0;
  };

  bool
  is_plausible(const HeightMap &map)
  {
    double lowest = 1e300, highest = -1e300;
    for (const double z : map.z)
      if (std::isinf(z))
        return false;
      else if (!std::isnan(z))
        {
          lowest  = std::min(lowest, z);
          highest = std::max(highest, z);
        }
    const double extent = std::max(map.dx * static_cast<double>(map.nx), map.dy * static_cast<double>(map.ny));
    return map.nx >= 2 && map.ny >= 2 && map.z.size() == map.nx * map.ny && std::isfinite(extent) && map.dx > 0.
           && map.dy > 0. && highest > lowest && highest - lowest <= extent && n_missing(map) < map.size();
  }

  /// A message says where: line, byte, point or part of an archive, unless the reason concerns the whole file.
  bool
  names_place_and_reason(const std::string &message)
  {
    if (message.find("tribodraw_guarded_") == std::string::npos || message.size() < 60)
      return false;
    for (const char *place : { ", line ", ", byte ", "column ", "main.xml", "bindata", "md5checksum" })
      if (message.find(place) != std::string::npos)
        return true;
    for (const char *whole : { "all points of the surface are missing",
                               "all heights of the surface are equal",
                               "the heights span",
                               "does not state the",
                               "at least 2 x 2 points",
                               "is empty",
                               "`Pixel size` is given",
                               "`Height unit` is given",
                               "not ended by a zero byte",
                               "does not have the proportions",
                               "the format of the surface file is unknown",
                               "is missing",
                               "than its header says",
                               "the pixel size is not positive",
                               "the unit of the heights is not positive",
                               "a pixel is more than",
                               "states both pixel size",
                               "less than a quarter of the regular grid",
                               "zip archive",
                               "no description" })
      if (message.find(whole) != std::string::npos)
        return true;
    return false;
  }

  bool
  same_map(const HeightMap &map, const Sample &sample)
  {
    if (map.nx != 5 || map.ny != 4)
      return false;
    for (std::size_t i = 0; i < sample.z.size(); ++i)
      if (std::isnan(map.z[i]) != std::isnan(sample.z[i]) || std::abs(map.z[i] - sample.z[i]) > sample.tolerance * 1e-3)
        return false;
    return true;
  }

  /// @return what is wrong with how a mutant was treated, or nothing.
  std::string
  judge(const std::string &mutant, const Sample &sample, Statistics &statistics)
  {
    const auto outcome = guarded_read::read(mutant, sample.given);
    ++statistics.mutants;
    if (!outcome.failure.empty())
      return outcome.failure;
    if (outcome.map)
      {
        ++(same_map(*outcome.map, sample) ? statistics.unchanged : statistics.plausible);
        return is_plausible(*outcome.map) ? "" : "accepted, but not plausible: " + outcome.map->description;
      }
    ++statistics.rejected;
    const std::size_t above    = outcome.peak - std::min(outcome.peak, mutant.size());
    statistics.peak_above_file = std::max(statistics.peak_above_file, above);
    if (above > guarded_read::allowance)
      return "too much memory: " + std::to_string(above);
    if (outcome.message.find("alloc") != std::string::npos)
      return "out of memory: " + outcome.message;
    return names_place_and_reason(outcome.message) ? "" : "no place or reason: " + outcome.message;
  }

  std::map<std::string, std::vector<Sample>>
  samples_by_format()
  {
    std::map<std::string, std::vector<Sample>> result;
    for (const Sample &sample : all_samples())
      result[sample.format].push_back(sample);
    return result;
  }

  std::string
  as_text(const std::string &content)
  {
    std::string text;
    for (const char c : content.substr(0, 3000))
      if (c == '\n' || (c >= ' ' && c < 0x7F))
        text += c;
      else
        text += "\\x" + std::string(1, "0123456789ABCDEF"[(c >> 4) & 15]) + "0123456789ABCDEF"[c & 15];
    return text;
  }

  void
  report(const std::string &format, const Statistics &s)
  {
    std::printf(
        "%-12s %6d mutants: %6d rejected, %5d read unchanged, %5d read as another plausible map, peak %zu bytes "
        "above the file\n",
        format.c_str(), s.mutants, s.rejected, s.unchanged, s.plausible, s.peak_above_file);
  }

  /// Collects what is wrong while the warnings of the readers are caught.
  class Findings
  {
  public:
    Findings() { ::testing::internal::CaptureStdout(); }
    ~Findings()
    {
      ::testing::internal::GetCapturedStdout();
      for (const std::string &text : texts)
        ADD_FAILURE() << text;
    }

    void
    add(const std::string &wrong, const std::string &mutant)
    {
      if (!wrong.empty() && texts.size() < 20)
        texts.push_back(wrong + "\nmutant: " + mutant);
    }

  private:
    std::vector<std::string> texts;
  };
} // namespace

TEST(SurfaceMutations, EveryMutantIsRejectedCleanlyOrPlausible)
{
  for (const auto &[format, samples] : samples_by_format())
    {
      Statistics statistics;
      Mutator    mutator(20260101);
      const bool is_text = format == "matrix" || format == "points" || format == "sdf text" || format == "gsf";
      {
        Findings findings;
        for (int i = 0; i < mutants_of_a_format; ++i)
          {
            const Sample     &sample = samples[i % samples.size()];
            const std::string mutant = mutator.mutant(sample.content, is_text);
            findings.add(judge(mutant, sample, statistics),
                         format + ", " + sample.variant + ", " + std::to_string(i) + ":\n" + as_text(mutant));
          }
      }
      report(format, statistics);
      EXPECT_GE(statistics.mutants, 250);
      EXPECT_GT(statistics.rejected, statistics.mutants / 4) << format;
    }
}

// The checksums of the archive hide what is inside: damage the parts before they are packed.
TEST(SurfaceMutations, MutantsInsideArchives)
{
  Statistics statistics;
  Mutator    mutator(20260102);
  {
    Findings findings;
    for (int i = 0; i < mutants_of_a_format; ++i)
      {
        const std::string type = std::string(1, "ILFD"[i % 4]);
        std::string       main = x3p_main(type, "bindata/data.bin", ""), data = x3p_data(type, false);
        (i % 3 == 0 ? data : main) = mutator.mutant(i % 3 == 0 ? data : main, i % 3 != 0);
        const std::string mutant   = zip({ { "main.xml", main }, { "bindata/data.bin", data } });
        Sample            sample{ "x3p", "inside", mutant, {}, expected(false) };
        sample.tolerance = 1e-7;
        findings.add(judge(mutant, sample, statistics), std::to_string(i) + ":\n" + main + as_text(data));
      }
  }
  report("x3p inside", statistics);
}

// A truncated file is rejected, or nothing of the map was lost with its end (trailers, line ends of comments).
// Where a file is a list of lines without a count, the loss of whole lines at the end cannot be seen.
TEST(SurfaceMutations, TruncationAtEveryByte)
{
  for (const auto &[format, samples] : samples_by_format())
    {
      Statistics statistics;
      const bool is_list = format == "matrix" || format == "points";
      {
        Findings findings;
        for (std::size_t k = 0; k < samples.size(); k += std::max<std::size_t>(1, samples.size() / 6))
          for (std::size_t n = 0; n < samples[k].content.size(); ++n)
            {
              const std::string mutant = samples[k].content.substr(0, n);
              const int         others = statistics.plausible;
              std::string       wrong  = judge(mutant, samples[k], statistics);
              if (statistics.plausible > others && !(is_list && mutant.back() == '\n'))
                wrong = "a truncated file is read as another map";
              findings.add(wrong, format + ", " + samples[k].variant + ", " + std::to_string(n) + " bytes");
            }
      }
      report(format, statistics);
    }
}
