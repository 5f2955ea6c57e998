// Damaged files: each is rejected with a message that names file, place and reason, or it is read as a plausible map.
#include "format_samples.h"
#include "guarded_read.h"

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

  class Mutator
  {
  public:
    explicit Mutator(std::uint64_t seed) : engine(seed) {}

    std::size_t
    below(std::size_t n)
    {
      return n == 0 ? 0 : engine() % n;
    }

    std::string
    mutant(std::string text, bool is_text)
    {
      const std::size_t n_changes = 1 + below(3);
      for (std::size_t i = 0; i < n_changes; ++i)
        change(text, is_text && below(2) == 0 ? 8 + below(2) : below(8));
      return text;
    }

  private:
    void
    change(std::string &text, std::size_t kind)
    {
      const std::size_t at = below(text.size()), length = 1 + below(16);
      switch (kind)
        {
        case 0: // one bit
          if (!text.empty())
            text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
          break;
        case 1: // one byte
          if (!text.empty())
            text[at] = static_cast<char>(below(256));
          break;
        case 2:
          text.erase(at, length);
          break;
        case 3:
          text.insert(at, text.substr(below(text.size()), length));
          break;
        case 4:
          text.resize(at);
          break;
        case 5:
          overwrite(text, at, extreme_number());
          break;
        case 6:
          swap_bytes(text, at);
          break;
        case 7: // a run of one byte: erased flash memory, holes of sparse files
          std::fill_n(text.begin() + at, std::min(text.size() - at, 4 * length), below(2) == 0 ? '\0' : '\xFF');
          break;
        case 8:
          replace_token(text, at);
          break;
        case 9: // a line is lost or doubled
          {
            const std::size_t begin = text.rfind('\n', at) + 1;
            const std::size_t end   = std::min(text.find('\n', begin), text.size());
            if (below(2) == 0)
              text.erase(begin, end - begin);
            else
              text.insert(begin, text.substr(begin, end - begin));
            break;
          }
        }
    }

    std::string
    extreme_number()
    {
      Bytes bytes;
      switch (below(10))
        {
        case 0:
          return bytes.little<std::uint16_t>(0xFFFF).text;
        case 1:
          return bytes.little<std::uint32_t>(0x7FFFFFFF).text;
        case 2:
          return bytes.little<std::int32_t>(-1).text;
        case 3:
          return bytes.little<std::uint32_t>(0).text;
        case 4:
          return bytes.little(std::nan("")).text;
        case 5:
          return bytes.little(std::numeric_limits<double>::infinity()).text;
        case 6:
          return bytes.little(-1e-6).text;
        case 7:
          return bytes.little(std::numeric_limits<float>::quiet_NaN()).text;
        case 8:
          return bytes.little(-std::numeric_limits<float>::infinity()).text;
        default:
          return bytes.little(1e-310).text;
        }
    }

    static void
    overwrite(std::string &text, std::size_t at, const std::string &bytes)
    {
      for (std::size_t i = 0; i < bytes.size() && at + i < text.size(); ++i)
        text[at + i] = bytes[i];
    }

    /// Other byte order: of one number or of everything from here on.
    void
    swap_bytes(std::string &text, std::size_t at)
    {
      const std::size_t width = std::size_t(2) << below(3), n = below(2) == 0 ? 1 : text.size();
      for (std::size_t i = 0; i < n && at + (i + 1) * width <= text.size(); ++i)
        std::reverse(text.begin() + static_cast<std::ptrdiff_t>(at + i * width),
                     text.begin() + static_cast<std::ptrdiff_t>(at + (i + 1) * width));
    }

    void
    replace_token(std::string &text, std::size_t at)
    {
      static const char *const tokens[]
          = { "0",          "-1",     "nan",        "inf", "-inf", "1e999", "1e308", "1e-300", "99999999999999999999",
              "4294967296", "BAD",    "2147483647", "",    "1,5",  "V",     "x",     "m",      "=",
              "*",          "<Datum>" };
      const char *const blanks = " \t\r\n;,=<>";
      const std::size_t begin  = text.find_first_not_of(blanks, at);
      if (begin == std::string::npos)
        return;
      const std::size_t end = std::min(text.find_first_of(blanks, begin), text.size());
      text.replace(begin, end - begin, tokens[below(sizeof(tokens) / sizeof(tokens[0]))]);
    }

    std::mt19937_64 engine;
  };

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
