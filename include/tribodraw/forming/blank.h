#ifndef tribodraw_forming_blank_h
#define tribodraw_forming_blank_h

#include <tribodraw/forming/edges.h>
#include <tribodraw/shell/blank_mesh.h>
#include <tribodraw/shell/shell.h>

#include <memory>
#include <string>
#include <vector>

namespace tribodraw
{
  class Parameters;

  /// The blank as described in section `Blank`.
  struct Blank
  {
    /// Which part of the sheet is modelled.
    enum class Symmetry
    {
      quarter, ///< x >= 0, y >= 0
      half_x,  ///< x >= 0
      half_y,  ///< y >= 0
      whole
    };

    Symmetry               symmetry = Symmetry::quarter;
    double                 length = 0, width = 0; ///< of the full blank along x (rolling direction) and y [mm]
    double                 thickness          = 0;
    double                 element_size       = 0;
    unsigned               n_thickness_points = 5;
    Shell::ThicknessPoints thickness_rule     = Shell::ThicknessPoints::gauss;

    std::string                      shape = "rectangle";
    std::vector<Eigen::Vector2d>     outline;    ///< of the modelled part, for a polygon
    std::vector<SizeField::Zone>     zones;      ///< of smaller elements
    std::shared_ptr<const BlankMesh> given_mesh; ///< from a file
    BlankEdges                       edges;

    static Blank read(Parameters &parameters);
    /// True if the plane x = 0 (axis 0) or y = 0 (axis 1) is one of symmetry.
    bool      mirrored(unsigned axis) const;
    BlankMesh mesh() const;
  };
} // namespace tribodraw

#endif
