#include <tribodraw/base/errors.h>
#include <tribodraw/base/face_mesh.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/base/units.h>
#include <tribodraw/forming/blank.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace tribodraw
{
  namespace
  {
    using Eigen::Vector2d;

    // The shapes of a blank, as they stand in `Blank/Shape`.
    const char *const rectangle = "rectangle", *const circle = "circle", *const polygon = "polygon", *const mesh_file = "mesh file";
    // The parts of it that can be modelled, in the order of Blank::Symmetry.
    const std::vector<std::string> symmetries = {"quarter", "half x", "half y", "whole"};
    const std::vector<std::string> rules      = {"Gauss", "Lobatto", "halves"}; // in the order of Shell::ThicknessPoints

    template <class Enumeration>
    Enumeration chosen_of(const std::vector<std::string> &names, const std::string &name)
    {
      const auto found = std::find(names.begin(), names.end(), name);
      return static_cast<Enumeration>(found == names.end() ? 0 : found - names.begin());
    }

    /// An entry that has a meaning for one shape only.
    template <class Read>
    void for_shape(Parameters &p, const bool chosen, const std::string &entry, const Read &read)
    {
      if (chosen || p.documentation_mode())
        read();
      else
        p.mark_unselected(entry);
    }

    /// Coordinates in the modelled part: none is negative across a plane of symmetry.
    void check_side(Parameters &p, const Blank &blank, const std::string &entry, const Vector2d &x)
    {
      for (unsigned axis = 0; axis < 2; ++axis)
        if (blank.mirrored(axis) && x[axis] < 0)
          return p.problem(entry, "a coordinate lies beyond the plane of symmetry.", std::string(axis == 0 ? "x" : "y") + " >= 0");
    }

    void read_polygon(Parameters &p, Blank &blank)
    {
      const auto corners = p.quantity_list("Outline", "mm", Range::between(-1e5, 1e5),
                                           "Polygon: corners x1, y1, x2, y2, ... of the modelled part, counter-clockwise; planes of symmetry close it: a "
                                           "quarter goes from the x axis to the y axis, a half from the plane of symmetry to the plane of symmetry.");
      if (p.documentation_mode() || corners.empty())
        return;
      if (corners.size() % 2 != 0 || corners.size() < 4)
        return p.problem("Outline", "the list does not hold pairs of coordinates.", "at least two pairs");
      for (std::size_t i = 0; i < corners.size(); i += 2)
        blank.outline.emplace_back(corners[i], corners[i + 1]);
      for (const auto &x : blank.outline)
        check_side(p, blank, "Outline", x);
      const Vector2d &first = blank.outline.front(), &last = blank.outline.back();
      if (blank.symmetry == Blank::Symmetry::quarter)
        {
          if (first[1] != 0 || last[0] != 0)
            return p.problem("Outline", "the outline of a quarter must begin on the x axis (y = 0) and end on the y axis (x = 0).");
          if (first[0] <= 0 || last[1] <= 0)
            return p.problem("Outline", "the outline must not begin or end in the origin.");
          blank.outline.emplace_back(0., 0.);
        }
      else if (blank.symmetry != Blank::Symmetry::whole)
        {
          const unsigned axis = blank.symmetry == Blank::Symmetry::half_x ? 0 : 1;
          if (first[axis] != 0 || last[axis] != 0)
            return p.problem("Outline", std::string("the outline of a half must begin and end on the plane of symmetry, ") + (axis == 0 ? "x = 0." : "y = 0."));
        }
      Vector2d low = first, high = first;
      for (const auto &x : blank.outline)
        low = low.cwiseMin(x), high = high.cwiseMax(x);
      blank.length = 2 * std::max(high[0], -low[0]);
      blank.width  = 2 * std::max(high[1], -low[1]);
    }

    void read_zones(Parameters &p, Blank &blank)
    {
      const auto boxes = p.quantity_list("Fine zones", "mm", Range::between(-1e5, 1e5),
                                         "Rectangles x1, x2, y1, y2, ... of the modelled part that get smaller elements, for example where the sheet will pass a "
                                         "small radius; 0: none. From a zone on the size grows by 0.3 per distance.",
                                         Default{"0 mm", "one size everywhere"});
      const auto sizes = p.quantity_list("Fine zone sizes", "mm", Range::between(0, 50), "Element size in each of the fine zones.",
                                         Default{"0 mm", "no zones"});
      if (p.documentation_mode() || (boxes.size() == 1 && boxes[0] == 0))
        return;
      if (boxes.size() != 4 * sizes.size())
        return p.problem("Fine zones", "each zone needs four coordinates and one size.");
      for (std::size_t k = 0; k < sizes.size(); ++k)
        {
          const double *b = &boxes[4 * k];
          check_side(p, blank, "Fine zones", {b[1], b[3]});
          if (!(b[0] < b[1] && b[2] < b[3]))
            p.problem("Fine zones", "the coordinates of zone " + std::to_string(k + 1) + " are not in order.", "x1 < x2 and y1 < y2");
          else if (!(sizes[k] > 0 && sizes[k] < blank.element_size))
            p.problem("Fine zone sizes", "the size of zone " + std::to_string(k + 1) + " is not smaller than the element size.");
          else
            blank.zones.push_back({{b[0], b[2]}, {b[1], b[3]}, sizes[k]});
        }
    }

    /// The symmetry that the marks of a mesh stand for.
    Blank::Symmetry symmetry_of(const BlankMesh &mesh)
    {
      const auto any = [](const std::vector<bool> &marks) { return std::find(marks.begin(), marks.end(), true) != marks.end(); };
      if (any(mesh.on_x_plane))
        return any(mesh.on_y_plane) ? Blank::Symmetry::quarter : Blank::Symmetry::half_x;
      return any(mesh.on_y_plane) ? Blank::Symmetry::half_y : Blank::Symmetry::whole;
    }

    /// Size of the elements of a mesh in the sense of `Element size`: the side of squares that are cut in two, of the largest
    /// triangle.
    double side_of_squares(const BlankMesh &mesh)
    {
      double largest = 0;
      for (const auto &t : mesh.triangles)
        largest = std::max(largest, (mesh.nodes[t[1]] - mesh.nodes[t[0]]).cross(mesh.nodes[t[2]] - mesh.nodes[t[0]]).norm());
      return std::sqrt(largest);
    }

    /// A mesh file is read at once, so that its mistakes are reported with all others.
    void read_mesh_file(Parameters &p, Blank &blank)
    {
      const auto   file = p.input_file("Mesh file", std::string("Mesh file: the modelled part of the blank; boundary sides on x = 0 and y = 0 are planes of symmetry. Formats: ") + face_mesh_formats + ".");
      const double unit = p.quantity("Mesh unit", "mm", Range::positive(), "Mesh file: length of one unit of the file.",
                                     Default{"1 mm", "the unit of this program"});
      const auto part = p.text("Mesh part", "Mesh file: the part that is the blank: name or number of a physical group (Gmsh), name of a part, an instance or an "
                                            "element set (Abaqus), number or title of a part (LS-DYNA).",
                               Default{"", "the file holds nothing but the blank"});
      if (p.documentation_mode() || file.empty() || !(unit > 0))
        return;
      try
        {
          auto       mesh  = std::make_shared<BlankMesh>(read_blank_mesh(file, unit, part));
          const auto found = symmetry_of(*mesh);
          if (found != blank.symmetry)
            return p.problem("Mesh file", "the mesh has the planes of symmetry of '" + symmetries[static_cast<int>(found)] + "', not of '" +
                                            symmetries[static_cast<int>(blank.symmetry)] + "' as 'Blank/Symmetry' says.");
          for (const auto &x : mesh->nodes)
            {
              blank.length = std::max(blank.length, 2 * std::abs(x[0]));
              blank.width  = std::max(blank.width, 2 * std::abs(x[1]));
            }
          blank.element_size = side_of_squares(*mesh);
          blank.given_mesh   = mesh;
        }
      catch (const InputError &e)
        {
          p.problem("Mesh file", e.what());
        }
    }

    void read_thickness_rule(Parameters &p, Blank &blank)
    {
      blank.n_thickness_points =
        static_cast<unsigned>(p.integer("Thickness points", Range::between(3, 11), "Points of integration through the thickness.",
                                        Default{"5", "bending moments after yielding are then right to one per cent"}));
      blank.thickness_rule =
        chosen_of<Shell::ThicknessPoints>(rules, p.choice("Thickness rule", rules,
                                                          "Gauss: most exact for its number of points; Lobatto: with points on the surfaces, where bending "
                                                          "yields first; halves: Gauss points in each half (an even number), most exact for springback.",
                                                          Default{"Gauss", "more exact at the same cost"}));
      if (blank.thickness_rule == Shell::ThicknessPoints::halves && blank.n_thickness_points % 2 != 0)
        p.problem("Thickness points", "the rule 'halves' needs the same number of points in each half.", "an even number");
    }

    /// A rectangle of squares cut in two, moved so that it is centred along the axes without a plane of symmetry.
    BlankMesh rectangle_of_squares(const Blank &blank)
    {
      Vector2d side(blank.length, blank.width), shift(0, 0);
      for (unsigned axis = 0; axis < 2; ++axis)
        if (blank.mirrored(axis))
          side[axis] *= 0.5;
        else
          shift[axis] = -0.5 * side[axis];
      const auto n    = [&](const unsigned axis) { return std::max(2u, static_cast<unsigned>(std::lround(side[axis] / blank.element_size))); };
      BlankMesh  mesh = make_quarter_rectangle(side[0], side[1], n(0), n(1));
      for (auto &x : mesh.nodes)
        x.head<2>() += shift;
      return mesh;
    }

    /// Corners of a rectangle or points of a circle around the modelled part, counter-clockwise.
    std::vector<Vector2d> outline_of(const Blank &blank, const SizeField &size)
    {
      const double a = 0.5 * blank.length, b = 0.5 * blank.width;
      const double left = blank.mirrored(0) ? 0 : -a, low = blank.mirrored(1) ? 0 : -b;
      if (blank.shape == rectangle)
        return {{left, low}, {a, low}, {a, b}, {left, b}};
      const double from = blank.mirrored(1) ? 0 : -0.5 * M_PI, to = blank.mirrored(0) ? 0.5 * M_PI : blank.mirrored(1) ? M_PI : 1.5 * M_PI;
      auto         points = circular_arc(Vector2d::Zero(), a, from, to, size);
      // sin and cos leave a trace at the ends of the arc, where the planes of symmetry must be met exactly
      for (auto *x : {&points.front(), &points.back()})
        for (unsigned axis = 0; axis < 2; ++axis)
          if (blank.mirrored(axis) && std::abs((*x)[axis]) < 1e-9 * a)
            (*x)[axis] = 0;
      if (blank.symmetry == Blank::Symmetry::quarter)
        points.emplace_back(0., 0.);
      else if (blank.symmetry == Blank::Symmetry::whole)
        points.pop_back();
      return points;
    }
  } // namespace

  bool
  Blank::mirrored(const unsigned axis) const
  {
    return symmetry == Symmetry::quarter || symmetry == (axis == 0 ? Symmetry::half_x : Symmetry::half_y);
  }

  Blank
  Blank::read(Parameters &p)
  {
    Blank blank;
    blank.shape = p.choice("Shape", {rectangle, circle, polygon, mesh_file}, "Shape of the blank.", Default{rectangle, "the usual cut"});
    blank.symmetry =
      chosen_of<Symmetry>(symmetries, p.choice("Symmetry", symmetries,
                                               "Modelled part: quarter (x >= 0, y >= 0), half x (x >= 0), half y (y >= 0) or the whole blank. Figures are of the full part.",
                                               Default{"quarter", "the usual parts have two planes of symmetry, and a quarter costs a quarter"}));
    for_shape(p, blank.shape == rectangle, "Length", [&] {
      blank.length = p.quantity("Length", "mm", Range::positive().usual(10, 5000), "Rectangle: length of the blank along x, the rolling direction (full part).");
    });
    for_shape(p, blank.shape == rectangle, "Width", [&] {
      blank.width = p.quantity("Width", "mm", Range::positive().usual(1, 5000), "Rectangle: width of the blank along y (full part).");
    });
    for_shape(p, blank.shape == circle, "Diameter", [&] {
      const double diameter = p.quantity("Diameter", "mm", Range::positive().usual(10, 5000), "Circle: diameter of the blank.");
      if (blank.shape == circle)
        blank.length = blank.width = diameter;
    });
    for_shape(p, blank.shape == polygon, "Outline", [&] { read_polygon(p, blank); });
    blank.thickness = p.quantity("Thickness", "mm", Range::positive().usual(0.1, 5), "Initial thickness.");
    for_shape(p, blank.shape != mesh_file, "Element size", [&] {
      blank.element_size = p.quantity("Element size", "mm", Range::positive().usual(0.2, 50), "Edge length of the squares that are cut into two triangles (rectangle without fine zones) or of the triangles.");
    });
    if (blank.shape != mesh_file || p.documentation_mode())
      read_zones(p, blank);
    else
      for (const char *entry : {"Fine zones", "Fine zone sizes"})
        p.mark_unselected(entry);
    if (blank.shape == mesh_file || p.documentation_mode())
      read_mesh_file(p, blank);
    else
      for (const char *entry : {"Mesh file", "Mesh unit", "Mesh part"})
        p.mark_unselected(entry);
    read_thickness_rule(p, blank);
    blank.edges = BlankEdges::read(p, blank.shape == rectangle, {blank.mirrored(0), blank.mirrored(1)});
    if (!p.has_problems() && !blank.given_mesh && blank.element_size > 0.5 * std::min(blank.length, blank.width))
      p.problem("Element size", "the blank would have no two elements across.",
                "at most " + units::format(0.5 * std::min(blank.length, blank.width), "mm"));
    if (!p.has_problems() && blank.length * blank.width / (blank.element_size * blank.element_size) > 4e6)
      p.problem("Element size", "the blank would have more than two million elements.");
    return blank;
  }

  BlankMesh
  Blank::mesh() const
  {
    if (given_mesh)
      return *given_mesh;
    SizeField size;
    size.size      = element_size;
    size.zones     = zones;
    BlankMesh mesh = shape == rectangle && zones.empty() ? rectangle_of_squares(*this)
                                                         : make_outline_mesh(shape == polygon ? outline : outline_of(*this, size), size, true);
    // The generators know quarters: what lies on an axis that is no plane of symmetry is an ordinary node.
    if (!mirrored(0))
      mesh.on_x_plane.assign(mesh.nodes.size(), false);
    if (!mirrored(1))
      mesh.on_y_plane.assign(mesh.nodes.size(), false);
    mesh.symmetry_factor = (mirrored(0) ? 2 : 1) * (mirrored(1) ? 2 : 1);
    mesh.mark_outer_edge();
    return mesh;
  }
} // namespace tribodraw
