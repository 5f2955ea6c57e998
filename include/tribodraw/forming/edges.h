#ifndef tribodraw_forming_edges_h
#define tribodraw_forming_edges_h

#include <tribodraw/shell/loads.h>
#include <tribodraw/tools/time_table.h>

#include <array>
#include <optional>
#include <string>

namespace tribodraw
{
  class Parameters;

  /// What holds the edges of the blank besides the tools, as described in section `Blank/Edges`.
  struct BlankEdges
  {
    enum class Condition
    {
      free,
      hinged,   ///< no displacement
      clamped,  ///< no displacement and no rotation
      mirrored, ///< a plane of symmetry: plane strain across a narrow strip
      pulled    ///< clamped in a grip that moves outwards, or pulled with a force at a constant height
    };
    struct Edge
    {
      Condition                condition = Condition::free;
      std::optional<TimeTable> motion; ///< outwards [mm] over process time [s]
      std::optional<TimeTable> force;  ///< outwards on the edge of the full part [N]
    };
    /// Straight edges of a rectangle, by their outward directions.
    enum Side { x, minus_x, y, minus_y };

    Condition           outer = Condition::free; ///< of the whole outer edge
    std::array<Edge, 4> side;                    ///< of a rectangle

    /// @param straight the blank is a rectangle; @param mirrored planes of symmetry x = 0, y = 0
    static BlankEdges read(Parameters &parameters, bool straight, const std::array<bool, 2> &mirrored);
    /// Axis (0, 1) and sign of an outward direction.
    static unsigned axis(unsigned s) { return s < y ? 0 : 1; }
    static double   sign(unsigned s) { return s == x || s == y ? 1 : -1; }
    bool            any() const;
    /// Nodes on a straight edge of the undeformed blank.
    static NodeSet nodes(const BlankMesh &mesh, unsigned s);
    /// Largest way of a pulled edge [mm].
    double largest_motion() const;
  };
} // namespace tribodraw

#endif
