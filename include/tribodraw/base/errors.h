#ifndef tribodraw_base_errors_h
#define tribodraw_base_errors_h

#include <stdexcept>
#include <string>

namespace tribodraw
{
  /// Exit codes of the program: every way a run can end.
  namespace exit_code
  {
    constexpr int success       = 0;
    constexpr int internal      = 1;
    constexpr int wrong_input   = 2;
    constexpr int not_converged = 3;
  } // namespace exit_code

  /// Wrong input by the user (file, parameter, option). The program prints the
  /// text once, without a stack trace, and ends with exit code 2.
  class InputError : public std::runtime_error
  {
  public:
    /// Control characters of a damaged file in @p text are written as \xNN.
    explicit InputError(const std::string &text);
  };

  /// A solver that met its iteration limit or a state that cannot be solved.
  /// The program writes the last state and ends with exit code 3.
  class ConvergenceError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /// Compose the message of an error in the house's order: what happened -
  /// where - the value - what is allowed - what to try. Empty parts are left out.
  std::string
  describe_error(const std::string &what,
                 const std::string &where,
                 const std::string &value   = "",
                 const std::string &allowed = "",
                 const std::string &hint    = "");
} // namespace tribodraw

#endif
