#ifndef tribodraw_tests_surface_guarded_read_h
#define tribodraw_tests_surface_guarded_read_h

#include <tribodraw/surface/surface_reader.h>

#include <optional>
#include <string>

/// Reading with limited and counted memory. The program that contains this file counts every `new`, unless it is
/// sanitized: sanitizers have their own.
namespace guarded_read
{
  constexpr std::size_t allowance = 64u << 20; ///< above the size of the file, before a file is rejected

  struct Outcome
  {
    std::optional<tribodraw::HeightMap> map;      ///< if the file was read
    std::string                         message;  ///< of the InputError if not
    std::string                         failure;  ///< why neither happened: another exception
    std::size_t                         peak = 0; ///< bytes of `new` at the same time, the content of the file included
  };

  /// Write @p content to a file and read it, with an address space that can grow by the size of the file and the
  /// allowance only (not in sanitized programs, whose address space is not theirs).
  Outcome read(const std::string &content, const tribodraw::GivenScales &given = {});
} // namespace guarded_read

#endif
