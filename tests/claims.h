#ifndef tribodraw_tests_claims_h
#define tribodraw_tests_claims_h

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>

/// Assertions that also stand on the page of measured verification: what is claimed, against what, the figure reached
/// and what is allowed, also if it fails. They go into the XML file that ctest asks every unit test for, as properties
/// of the test; doc/verification_table makes the page of all these files.
namespace tribodraw::claims
{
  /// `stretch 0.3`: names of claims in loops.
  inline std::string
  with(const std::string &name, const double value)
  {
    std::ostringstream text;
    text << name << ' ' << value;
    return text.str();
  }

  inline ::testing::AssertionResult
  put_down(const std::string &what, const std::string &against, const double reached, const std::string &wanted,
           const bool holds)
  {
    static unsigned    count = 0; // names of properties are unique within a test
    std::ostringstream row;
    row.precision(8);
    row << what << '\t' << against << '\t' << reached << '\t' << wanted << '\t' << (holds ? "holds" : "fails");
    ::testing::Test::RecordProperty("claim_" + std::to_string(count++), row.str());
    if (holds)
      return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << what << ": " << reached << ", wanted: " << wanted << " (" << against << ")";
  }

  /// |reached - expected| <= tolerance. @param against where the expected value comes from
  inline ::testing::AssertionResult
  agrees(const std::string &what, const std::string &against, const double reached, const double expected,
         const double tolerance)
  {
    std::ostringstream wanted;
    wanted.precision(8);
    wanted << expected << " ± ";
    wanted.precision(2);
    wanted << tolerance;
    return put_down(what, against, reached, wanted.str(), std::abs(reached - expected) <= tolerance);
  }

  /// |reached| <= limit, for errors.
  inline ::testing::AssertionResult
  below(const std::string &what, const std::string &against, const double reached, const double limit)
  {
    std::ostringstream wanted;
    wanted << "below " << limit;
    return put_down(what, against, reached, wanted.str(), std::abs(reached) <= limit);
  }

  /// reached >= limit, for orders of convergence.
  inline ::testing::AssertionResult
  at_least(const std::string &what, const std::string &against, const double reached, const double limit)
  {
    std::ostringstream wanted;
    wanted << "at least " << limit;
    return put_down(what, against, reached, wanted.str(), reached >= limit);
  }
} // namespace tribodraw::claims

#endif
