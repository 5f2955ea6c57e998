#ifndef tribodraw_tools_outline_reader_h
#define tribodraw_tools_outline_reader_h

#include <tribodraw/tools/drawing_tools.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tribodraw
{
  class Parameters;

  /// How an outline is written in a parameter file.
  struct OutlineFormat
  {
    struct Entry
    {
      std::string name;
      std::string documentation;
      double      example; ///< [mm], of a valid outline; stands in while the file's own values cannot be read
    };
    std::vector<Entry>                                                   entries;
    std::function<std::unique_ptr<Outline>(const std::vector<double> &)> make; ///< from the values, in this order
    double                                                               example_edge_radius;
  };

  OutlineFormat circle_format();
  OutlineFormat strip_format();
  OutlineFormat rounded_rectangle_format();
  OutlineFormat cross_format();

  /// Entry `Outline` and the subsection named like the choice with the entries of its format.
  std::unique_ptr<Outline> read_outline(Parameters &parameters);

  /// Entries of the format, `Clearance` and `Edge radius`. The opening is the outline moved outwards by the clearance,
  /// so that punch and die are written with the same numbers; with a clearance of zero the entries are those of the
  /// opening itself.
  DrawingDie read_die(Parameters &parameters, const OutlineFormat &format);

  /// Entries of the format and `Edge radius`.
  DrawingPunch read_punch(Parameters &parameters, const OutlineFormat &format);
} // namespace tribodraw

#endif
