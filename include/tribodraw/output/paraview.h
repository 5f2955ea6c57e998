#ifndef tribodraw_output_paraview_h
#define tribodraw_output_paraview_h

#include <filesystem>
#include <string>
#include <vector>

namespace tribodraw
{
  /// A field as ParaView shows it.
  struct ParaviewView
  {
    enum class From
    {
      inside_above, ///< over the inner edges of a modelled quarter: into the part
      outside_below,
      above
    };
    std::string title; ///< of the colour bar, with the unit: `Lubricant pressure, die side / MPa`
    std::string field; ///< name in the VTU files; of a vector its length
    From        from = From::inside_above;
  };

  /// Write `view.py`, a Python state of ParaView (5.9 or later; File > Load State): `solution.pvd` of the same folder,
  /// one view a field with a perceptually uniform colour scale over all steps, fields without a value grey, and the
  /// tools of `tools.pvd`, if there is one, transparent. Paths are relative to the script. `pvpython view.py
  /// picture.png` draws without a window.
  void write_paraview_state(const std::filesystem::path &folder, const std::vector<ParaviewView> &views);
} // namespace tribodraw

#endif
