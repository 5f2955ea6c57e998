#include <tribodraw/base/errors.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/base/units.h>
#include <tribodraw/forming/simulation.h>
#include <tribodraw/tools/drawing_tools.h>

#include <algorithm>
#include <cmath>

namespace tribodraw
{
  Process
  Process::read(Parameters &p)
  {
    Process process;
    process.punch_travel       = p.quantity("Punch travel", "mm", Range::positive().usual(0.1, 500), "Travel of the punch from first touch.");
    process.punch_speed        = p.quantity("Punch speed", "mm/s", Range::positive().usual(0.01, 5000), "Constant speed of the punch.");
    process.blank_holder_force = p.quantity("Blank holder force", "kN", Range::positive().usual(0.1, 5000), "Force on the blank holder, full part.");
    return process;
  }

  namespace
  {
    // The shapes of a blank, as they stand in `Blank/Shape`.
    const char *const rectangle = "rectangle", *const circle = "circle", *const polygon = "polygon", *const mesh_file = "mesh file";

    /// An entry that has a meaning for one shape only.
    template <class Read>
    void for_shape(Parameters &p, const bool chosen, const std::string &entry, const Read &read)
    {
      if (chosen || p.documentation_mode())
        read();
      else
        p.mark_unselected(entry);
    }

    void read_polygon(Parameters &p, Blank &blank)
    {
      const auto corners = p.quantity_list("Outline", "mm", Range::between(0, 1e5),
                                           "Polygon: corners x1, y1, x2, y2, ... of the quarter of the blank, counter-clockwise, from the first on the x axis "
                                           "to the last on the y axis; the planes of symmetry close it.");
      if (p.documentation_mode() || corners.empty())
        return;
      if (corners.size() % 2 != 0 || corners.size() < 4)
        return p.problem("Outline", "the list does not hold pairs of coordinates.", "at least two pairs");
      for (std::size_t i = 0; i < corners.size(); i += 2)
        blank.outline.emplace_back(corners[i], corners[i + 1]);
      if (blank.outline.front()[1] != 0 || blank.outline.back()[0] != 0)
        return p.problem("Outline", "the outline must begin on the x axis (y = 0) and end on the y axis (x = 0).");
      if (blank.outline.front()[0] <= 0 || blank.outline.back()[1] <= 0)
        return p.problem("Outline", "the outline must not begin or end in the origin.");
      blank.length = 2 * blank.outline.front()[0];
      blank.width  = 2 * blank.outline.back()[1];
      blank.outline.emplace_back(0., 0.);
    }

    void read_zones(Parameters &p, Blank &blank)
    {
      const auto boxes = p.quantity_list("Fine zones", "mm", Range::between(0, 1e5),
                                         "Rectangles x1, x2, y1, y2, ... of the quarter that get smaller elements, for example where the sheet will pass a small radius; "
                                         "0: none. From a zone on the size grows by 0.3 per distance.",
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
          if (!(b[0] < b[1] && b[2] < b[3]))
            p.problem("Fine zones", "the coordinates of zone " + std::to_string(k + 1) + " are not in order.", "x1 < x2 and y1 < y2");
          else if (!(sizes[k] > 0 && sizes[k] < blank.element_size))
            p.problem("Fine zone sizes", "the size of zone " + std::to_string(k + 1) + " is not smaller than the element size.");
          else
            blank.zones.push_back({{b[0], b[2]}, {b[1], b[3]}, sizes[k]});
        }
    }

    /// A mesh file is read at once, so that its mistakes are reported with all others.
    void read_mesh_file(Parameters &p, Blank &blank)
    {
      const auto   file = p.input_file("Mesh file", "Mesh file: a Gmsh file (2.2 or 4.1, ASCII) of the quarter x >= 0, y >= 0.");
      const double unit = p.quantity("Mesh unit", "mm", Range::positive(), "Mesh file: length of one unit of the file.",
                                     Default{"1 mm", "the unit of this program"});
      if (p.documentation_mode() || file.empty() || !(unit > 0))
        return;
      try
        {
          auto mesh = std::make_shared<BlankMesh>(read_gmsh(file, unit));
          if (mesh->symmetry_factor != 4)
            return p.problem("Mesh file", "the mesh is not a quarter.", "x >= 0, y >= 0, with sides on both planes of symmetry");
          for (std::size_t i = 0; i < mesh->nodes.size(); ++i)
            {
              if (mesh->on_y_plane[i])
                blank.length = std::max(blank.length, 2 * mesh->nodes[i].x());
              if (mesh->on_x_plane[i])
                blank.width = std::max(blank.width, 2 * mesh->nodes[i].y());
            }
          blank.element_size = mesh->largest_edge();
          blank.given_mesh   = mesh;
        }
      catch (const InputError &e)
        {
          p.problem("Mesh file", e.what());
        }
    }
  } // namespace

  Blank
  Blank::read(Parameters &p)
  {
    Blank blank;
    blank.shape = p.choice("Shape", {rectangle, circle, polygon, mesh_file}, "Shape of the blank. A quarter is modelled.",
                           Default{rectangle, "the usual cut"});
    for_shape(p, blank.shape == rectangle, "Length", [&] {
      blank.length = p.quantity("Length", "mm", Range::positive().usual(10, 5000), "Rectangle: length of the blank along x, the rolling direction (full part; a quarter is modelled).");
    });
    for_shape(p, blank.shape == rectangle, "Width", [&] {
      blank.width = p.quantity("Width", "mm", Range::positive().usual(10, 5000), "Rectangle: width of the blank along y.");
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
      for (const char *entry : {"Mesh file", "Mesh unit"})
        p.mark_unselected(entry);
    blank.n_thickness_points =
      static_cast<unsigned>(p.integer("Thickness points", Range::between(3, 11), "Points of integration through the thickness.",
                                      Default{"5", "bending moments after yielding are then right to one per cent"}));
    blank.lobatto = p.choice("Thickness rule", {"Gauss", "Lobatto"}, "Gauss: most exact for its number of points; Lobatto: with points on the surfaces, where bending yields first.",
                             Default{"Gauss", "more exact at the same cost"}) == "Lobatto";
    if (!p.has_problems() && !blank.given_mesh && blank.element_size > 0.25 * std::min(blank.length, blank.width))
      p.problem("Element size", "the blank would have fewer than two elements along a side of its quarter.",
                "at most " + units::format(0.25 * std::min(blank.length, blank.width), "mm"));
    if (!p.has_problems() && blank.length * blank.width / (blank.element_size * blank.element_size) > 4e6)
      p.problem("Element size", "the quarter would have more than two million elements.");
    return blank;
  }

  BlankMesh
  Blank::quarter_mesh() const
  {
    if (given_mesh)
      return *given_mesh;
    SizeField size;
    size.size  = element_size;
    size.zones = zones;
    if (shape == circle)
      return make_disc(0.5 * length, size, true);
    if (shape == polygon)
      return make_outline_mesh(outline, size, true);
    if (!zones.empty())
      return make_outline_mesh({{0, 0}, {0.5 * length, 0}, {0.5 * length, 0.5 * width}, {0, 0.5 * width}}, size, true);
    const auto n = [&](const double side) { return std::max(2u, static_cast<unsigned>(std::lround(0.5 * side / element_size))); };
    return make_quarter_rectangle(0.5 * length, 0.5 * width, n(length), n(width));
  }

  ToolSet
  ToolSet::read(Parameters &p)
  {
    ToolSet tools;
    {
      const auto scope = p.section("Die");
      tools.die        = p.model<ToolGeometry>("Model", "Shape of the die; its flange surface lies below the blank.");
    }
    {
      const auto scope = p.section("Punch");
      tools.punch      = p.model<ToolGeometry>("Model", "Shape of the punch; it moves down from above.");
    }
    // The blank holder is a plate with the die's opening and edge, turned upside down.
    tools.blank_holder = tools.die;
    return tools;
  }

  void
  check_process(Parameters &p, const Blank &blank, const ToolSet &tools)
  {
    if (p.has_problems() || p.documentation_mode() || !tools.die || !tools.punch)
      return;
    // The blank must cover the opening at both ends of its axes, or the die does not hold it.
    const double half[2] = {0.5 * blank.length, 0.5 * blank.width};
    for (int axis = 0; axis < 2; ++axis)
      {
        Eigen::Vector3d end = Eigen::Vector3d::Zero();
        end[axis]           = half[axis];
        if (tools.die->distance(end).distance > 1e-9) // at the height of the flange
          p.problem(axis == 0 ? "Blank/Length" : "Blank/Width", "the blank does not reach over the rounded edge of the die.");
      }
    const double extent = std::max(half[0], half[1]), gap = plan_clearance(*tools.die, *tools.punch, extent, 0.25);
    if (gap < blank.thickness)
      p.problem("Tools",
                gap < 0 ? "the punch does not fit into the die: they overlap by " + units::format(-gap, "mm") + " in plan."
                        : "the gap between punch and die is " + units::format(gap, "mm") + ", less than the sheet is thick.",
                "more than " + units::format(blank.thickness, "mm"), "Raise 'Tools/Die/.../Clearance'.");
    const double radius = std::min(tools.die->smallest_radius(), tools.punch->smallest_radius());
    if (blank.element_size > radius)
      p.problem("Blank/Element size", "the mesh is too coarse for the smallest radius of the tools, " + units::format(radius, "mm") + ".",
                "at most " + units::format(radius, "mm"), "Half the radius or less gives smooth forces.");
    else if (blank.element_size > 0.5 * radius)
      p.warning("'Blank/Element size' is more than half the smallest radius of the tools (" + units::format(radius, "mm") + "): expect ripples in the punch force.");
  }

  std::vector<ContactTool>
  ToolSet::place(const double thickness) const
  {
    std::vector<ContactTool> tools(3);
    const double             half = 0.5 * thickness;
    tools[die_index]              = {"Die", die, {0, 0, -half}, Face::die_side};
    tools[punch_index]            = {"Punch", punch, {0, 0, half}, Face::punch_side};
    tools[holder_index]           = {"Blank holder", blank_holder, {0, 0, half}, Face::punch_side, true, 0};
    return tools;
  }
} // namespace tribodraw
