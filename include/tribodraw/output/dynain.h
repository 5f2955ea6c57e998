#ifndef tribodraw_output_dynain_h
#define tribodraw_output_dynain_h

#include <tribodraw/shell/shell.h>

#include <filesystem>

namespace tribodraw
{
  /// The committed state of a sheet in the keyword format of LS-DYNA ("dynain"), from which springback, trimming or
  /// crash computations go on: *NODE, *ELEMENT_SHELL_THICKNESS, *INITIAL_STRESS_SHELL and *INITIAL_STRAIN_SHELL with
  /// the layers through the thickness. Units mm, N, MPa, s (tonne); the modelled part, cut at its planes of symmetry.
  /// @p title goes into a comment. Collective; the first rank writes.
  void write_dynain(const std::filesystem::path &file, const Shell &shell, const std::string &title);
} // namespace tribodraw

#endif
