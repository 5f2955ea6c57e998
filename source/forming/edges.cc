#include <tribodraw/base/parameters.h>
#include <tribodraw/forming/edges.h>

#include <algorithm>
#include <cmath>

namespace tribodraw
{
  namespace
  {
    const std::vector<std::string>   conditions = {"free", "hinged", "clamped", "plane of symmetry", "pulled"}; // in the order of Condition
    const std::array<std::string, 4> sides      = {{"Edge x", "Edge -x", "Edge y", "Edge -y"}};

    BlankEdges::Condition read_condition(Parameters &p, const std::string &entry, const std::vector<std::string> &allowed, const std::string &documentation)
    {
      const std::string name = p.choice(entry, allowed, documentation, Default{"free", "the tools hold the blank"});
      return static_cast<BlankEdges::Condition>(std::max<long>(0, std::find(conditions.begin(), conditions.end(), name) - conditions.begin()));
    }

    void read_side(Parameters &p, const unsigned s, BlankEdges::Edge &edge)
    {
      edge.condition = read_condition(p, sides[s], conditions,
                                      "The straight edge of a rectangle towards " + sides[s].substr(5) +
                                        ": free; hinged: no displacement; clamped: no displacement and no rotation; plane of symmetry: plane strain across a narrow strip; "
                                        "pulled: held in a grip that moves outwards.");
      const std::string motion = sides[s] + " motion", force = sides[s] + " force";
      const bool        pulled = edge.condition == BlankEdges::Condition::pulled;
      if (pulled && p.has(motion) == p.has(force) && !p.documentation_mode())
        p.problem(sides[s], "a pulled edge needs either a motion or a force.", "'" + motion + "' or '" + force + "'");
      for (const auto *entry : {&motion, &force})
        if (!p.documentation_mode() && !(pulled && p.has(*entry)))
          p.mark_unselected(*entry);
      if (p.documentation_mode() || (pulled && p.has(motion)))
        edge.motion = Motion::read(p, motion, "Displacement of the grip outwards, from the start of the drawing on.");
      if (p.documentation_mode() || (pulled && p.has(force)))
        edge.force = read_force_table(p, force, "Force on the edge of the full part outwards, from the start of the drawing on; the grip then keeps its height and lets the edge turn and contract.");
    }
  } // namespace

  BlankEdges
  BlankEdges::read(Parameters &p, const bool straight, const std::array<bool, 2> &mirrored)
  {
    BlankEdges edges;
    const auto scope = p.section("Edges");
    edges.outer      = read_condition(p, "Outer edge", {"free", "hinged", "clamped"}, "The whole outer edge of the blank: free; hinged: no displacement; clamped: no displacement and no rotation.");
    for (unsigned s = 0; s < sides.size(); ++s)
      if (p.documentation_mode() || (straight && !(sign(s) < 0 && mirrored[axis(s)])))
        read_side(p, s, edges.side[s]);
      else if (p.has(sides[s]))
        p.problem(sides[s], "there is no such straight edge.", "", straight ? "The plane of symmetry is in its place." : "Only a rectangle has them.");
    return edges;
  }

  bool
  BlankEdges::any() const
  {
    return outer != Condition::free || std::any_of(side.begin(), side.end(), [](const Edge &e) { return e.condition != Condition::free; });
  }

  NodeSet
  BlankEdges::nodes(const BlankMesh &mesh, const unsigned s)
  {
    const unsigned a   = axis(s);
    double         end = -1e300;
    for (const auto &node : mesh.nodes)
      end = std::max(end, sign(s) * node[a]);
    return nodes_where(mesh, [&](const Eigen::Vector3d &node) { return sign(s) * node[a] > end - 1e-6; });
  }

  double
  BlankEdges::largest_motion() const
  {
    double largest = 0;
    for (const Edge &e : side)
      if (e.motion)
        for (const double t : e.motion->breakpoints())
          largest = std::max(largest, std::abs(e.motion->value(t) - e.motion->value(0)));
    return largest;
  }
} // namespace tribodraw
