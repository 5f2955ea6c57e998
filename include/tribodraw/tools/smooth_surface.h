#ifndef tribodraw_tools_smooth_surface_h
#define tribodraw_tools_smooth_surface_h

#include <tribodraw/tools/smooth_patch.h>
#include <tribodraw/tools/tool_geometry.h>
#include <tribodraw/tools/triangle_mesh.h>

#include <array>
#include <string>
#include <vector>

namespace tribodraw
{
  struct CornerNormals;

  /// A tool given by triangles, smoothed: each triangle is replaced by a curved patch through its corners, and the
  /// patches join with common tangent planes. The distance is exactly that to the patches; the nearest is found in a
  /// tree of boxes. So the distance is as continuous as for a formula, and its normal jumps at sharp edges only.
  ///
  /// The surface need not be closed: beyond its border it goes on along its tangent planes. Behind it is the body.
  class SmoothSurface : public ToolGeometry
  {
  public:
    struct Options
    {
      double feature_angle    = 0.6; ///< [rad] neighbours at a larger angle form a sharp edge
      bool   keep_sharp_edges = false;
    };

    /// Throws InputError if the mesh is no oriented surface, or has sharp edges that are not to be kept.
    SmoothSurface(const TriangleMesh &mesh, const Options &options);

    ToolDistance distance(const Eigen::Vector3d &x) const override;
    /// From the turn of the normal along the sharpest convex edges; good to a tenth.
    double
    smallest_radius() const override
    {
      return radius;
    }
    Eigen::AlignedBox3d extent() const override;
    std::string         describe() const override;

  private:
    /// How a patch goes on beyond a border or corner.
    enum class Join : unsigned char
    {
      smooth,
      sharp,
      border
    };

    struct Patch
    {
      SmoothPatch                    surface;
      std::array<Join, 3>            edge, corner;
      std::array<Eigen::Vector3d, 3> beyond_edge;   ///< normal of the facet behind a sharp edge
      std::array<Eigen::Vector3d, 3> around_corner; ///< mean normal of all facets at a sharp corner
    };

    /// The flat triangle of a patch.
    struct Facet
    {
      Eigen::Vector3d a, ab, ac;           ///< corner and edges
      double          ab_ab, ab_ac, ac_ac; ///< products
      double          bulge;               ///< no point of the patch is further from that of the facet [mm]

      /// Distance to the nearest point, and its barycentric coordinates of the corners b and c.
      double nearest(const Eigen::Vector3d &x, double &u, double &v) const;
    };

    /// Nearest point of a patch.
    struct Foot
    {
      const Patch       *patch   = nullptr;
      double             squared = 0; ///< distance [mm^2]
      double             u = 0, v = 0;
      SmoothPatch::Point point;

      bool at_border() const;
    };

    /// Boxes around patches; the children of an inner box follow one another. Single precision halves the memory that
    /// a search goes through; the bounds are rounded outwards.
    struct Box
    {
      Eigen::AlignedBox3f bounds;
      unsigned            first; ///< child or patch
      unsigned            count; ///< of patches; 0: an inner box

      float squared_distance(const Eigen::Vector3f &x) const;
    };

    std::vector<Patch>  patches;
    std::vector<Facet>  facets;
    std::vector<Box>    boxes;
    Eigen::AlignedBox3d all;
    std::string         name;
    std::size_t         n_border_edges = 0;
    double              radius         = std::numeric_limits<double>::infinity();

    void        make_patches(const TriangleMesh &mesh, const MeshTopology &topology, const CornerNormals &normals);
    void        make_boxes();
    void        split(unsigned box, std::vector<unsigned> &order, const std::vector<Eigen::AlignedBox3d> &around);
    void        find_smallest_radius(const TriangleMesh &mesh, const CornerNormals &normals);
    Foot        nearest(const Eigen::Vector3d &x) const;
    static void approach(const Eigen::Vector3d &x, Foot &foot);
    static ToolDistance at_foot(const Eigen::Vector3d &x, const Foot &foot);
    static ToolDistance at_sharp_place(const Eigen::Vector3d &x, const Foot &foot, int edge, int corner);
  };
} // namespace tribodraw

#endif
