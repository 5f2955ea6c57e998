#include <tribodraw/base/errors.h>
#include <tribodraw/base/own_process.h>

#include <gtest/gtest.h>

#include <csignal>
#include <stdexcept>

using namespace tribodraw;

namespace
{
  /// The message of the InputError that @p work leads to.
  std::string
  problem_of(const std::function<std::string()> &work, const ProcessLimits &limits = {})
  {
    try
      {
        in_own_process(work, "broken", limits);
      }
    catch (const InputError &e)
      {
        return e.what();
      }
    return "";
  }
} // namespace

TEST(OwnProcess, ReturnsWhatTheWorkReturns)
{
  const std::string long_text(3'000'000, '\0'); // more than a pipe holds
  EXPECT_EQ(in_own_process([&] { return long_text; }, "broken", {}), long_text);
  EXPECT_EQ(in_own_process([] { return ""; }, "broken", {}), "");
  int here = 1;
  in_own_process([&] { return std::to_string(here = 2); }, "broken", {});
  EXPECT_EQ(here, 1); // a copy of the process
}

TEST(OwnProcess, InputErrorsComeThrough)
{
  EXPECT_EQ(problem_of([]() -> std::string { throw InputError("no such column"); }), "no such column");
  EXPECT_EQ(problem_of([]() -> std::string { throw std::runtime_error("odd"); }), "broken (odd)");
}

TEST(OwnProcess, CrashHangAndGreedAreReported)
{
  const auto crash = []() -> std::string {
    std::raise(SIGSEGV);
    return "";
  };
  const auto hang = []() -> std::string {
    for (volatile int i = 0;; i = 1 - i)
      continue;
  };
  EXPECT_EQ(problem_of(crash), "broken (signal " + std::to_string(SIGSEGV) + ")");
  EXPECT_EQ(problem_of(hang, { 1u << 30, 1 }), "broken (it found no end)");
  EXPECT_NE(problem_of([] { return std::string(400u << 20, 'a'); }, { 100u << 20, 30 }), "");
}
