// Damaged input of every kind: it is read, or it is refused with an InputError. No other exception, no crash, no hang, and no
// memory beyond a bound.
#include "fuzz/mutator.h"
#include "fuzz/parsers.h"

#include <tribodraw/base/errors.h>
#include <tribodraw/base/files.h>
#include <tribodraw/base/log.h>

#include <gtest/gtest.h>

#include <sys/resource.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>

using namespace tribodraw;

namespace
{
  /// Of each parser; slow checkers such as valgrind take fewer (environment TRIBODRAW_MUTANTS).
  int
  mutants_of_a_parser()
  {
    const char *asked = std::getenv("TRIBODRAW_MUTANTS");
    return asked ? std::max(1, std::atoi(asked)) : 400;
  }

#if defined(__SANITIZE_ADDRESS__)
  constexpr bool counts_memory = false; // the sanitizer reserves address space of its own
#else
  constexpr bool counts_memory = true;
#endif

  /// The address space may grow by so much while a parser reads.
  constexpr std::size_t allowance = 512u << 20;

  std::size_t
  address_space()
  {
    std::ifstream statm("/proc/self/statm");
    std::size_t   pages = 0;
    statm >> pages;
    return pages * 4096;
  }

  class MemoryLimit
  {
  public:
    MemoryLimit()
    {
      getrlimit(RLIMIT_AS, &before);
      rlimit limit = before;
      if (counts_memory)
        limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, address_space() + allowance);
      setrlimit(RLIMIT_AS, &limit);
    }
    ~MemoryLimit() { setrlimit(RLIMIT_AS, &before); }

  private:
    rlimit before{};
  };

  enum class Outcome { read, refused };

  Outcome
  feed(const FuzzedParser &parser, const std::string &content)
  {
    try
      {
        parser.read(content);
        return Outcome::read;
      }
    catch (const InputError &e)
      {
        EXPECT_GT(std::string(e.what()).size(), 20u) << parser.name << ": a message that explains nothing: " << e.what();
        return Outcome::refused;
      }
    catch (const std::exception &e)
      {
        ADD_FAILURE() << parser.name << ": '" << e.what() << "' with the content:\n" << content.substr(0, 2000);
        return Outcome::refused;
      }
  }
} // namespace

TEST(Fuzz, SeedsAreRead)
{
  log::set_level(log::Level::quiet);
  for (const auto &parser : fuzzed_parsers())
    for (const auto &seed : parser.seeds)
      EXPECT_EQ(feed(parser, seed), Outcome::read) << parser.name;
}

TEST(Fuzz, MutantsAreReadOrRefused)
{
  log::set_level(log::Level::quiet);
  int total = 0;
  for (const auto &parser : fuzzed_parsers())
    {
      std::map<Outcome, int> count;
      Mutator                mutator(20261122);
      const MemoryLimit      limit;
      for (int k = 0; k < mutants_of_a_parser() && !::testing::Test::HasFailure(); ++k)
        ++count[feed(parser, mutator.mutant(parser.seeds[k % parser.seeds.size()], parser.is_text))];
      total += mutants_of_a_parser();
      std::printf("%-18s %d mutants: %d refused, %d read\n", parser.name.c_str(), mutants_of_a_parser(), count[Outcome::refused],
                  count[Outcome::read]);
      EXPECT_GT(count[Outcome::refused], 0) << parser.name << ": no mutant was refused, so nothing was tested";
    }
  EXPECT_GE(total, 17 * mutants_of_a_parser()); // 6800, of which the surfaces alone are 400
}

// Inputs that once did harm, and what the fuzzer found interesting: corpus/<parser with _ for blanks>/*.
TEST(Fuzz, KeptInputsAreReadOrRefused)
{
  log::set_level(log::Level::quiet);
  for (const auto &parser : fuzzed_parsers())
    {
      std::string name = parser.name;
      std::replace(name.begin(), name.end(), ' ', '_');
      const std::filesystem::path folder = TRIBODRAW_SOURCE_DIR "/tests/fuzz/corpus/" + name;
      const MemoryLimit           limit;
      if (std::filesystem::exists(folder))
        for (const auto &entry : std::filesystem::directory_iterator(folder))
          {
            SCOPED_TRACE(entry.path().string());
            feed(parser, read_file(entry.path()));
          }
    }
}
