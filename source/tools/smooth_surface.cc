#include <tribodraw/base/errors.h>
#include <tribodraw/base/units.h>
#include <tribodraw/tools/corner_normals.h>
#include <tribodraw/tools/smooth_surface.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

namespace tribodraw
{
  namespace
  {
    using Eigen::Matrix2d;
    using Eigen::Matrix3d;
    using Eigen::Vector2d;
    using Eigen::Vector3d;
    using Tangents = Eigen::Matrix<double, 3, 2>;

    /// Barycentric coordinates up to here count as zero.
    constexpr double at_edge = 1e-14;

    /// Direction in which a border leaves a corner (or arrives there): along the chord in the tangent plane; at a sharp
    /// edge in both planes.
    Vector3d
    border_direction(const Vector3d &chord, const Vector3d &own, const Vector3d *other)
    {
      if (other)
        {
          const Vector3d common = own.cross(*other);
          const double   along  = common.dot(chord);
          if (std::abs(along) > 0.5 * common.norm() && common.norm() > 1e-2)
            return (along > 0 ? 1 : -1) * common.normalized();
        }
      return (chord - own.dot(chord) * own).normalized();
    }

    std::string
    text(const char *format, const double a, const double b, const double c)
    {
      char buffer[128];
      std::snprintf(buffer, sizeof(buffer), format, a, b, c);
      return buffer;
    }

    void
    refuse_sharp_edges(const TriangleMesh &mesh, const MeshTopology &topology, const CornerNormals &normals,
                       const double feature_angle)
    {
      std::size_t count = 0, at = 0;
      double      largest = 0;
      unsigned    edge    = 0;
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (unsigned k = 0; k < 3; ++k)
          if (normals.sharp[t][k])
            {
              const auto   other = static_cast<std::size_t>(topology.opposite(t, k).triangle);
              const double cosine
                  = std::clamp(topology.facet_normals()[t].dot(topology.facet_normals()[other]), -1., 1.);
              ++count;
              if (std::acos(cosine) > largest)
                {
                  largest = std::acos(cosine);
                  at      = t;
                  edge    = k;
                }
            }
      if (count == 0)
        return;
      const Vector3d x = 0.5 * (mesh.corner(at, edge) + mesh.corner(at, edge + 1));
      throw InputError(describe_error(
          "The tool's surface has " + std::to_string(count / 2) + " sharp edges: neighbouring triangles at more than "
              + text("%.3g degrees.", feature_angle * 180 / M_PI, 0, 0),
          mesh.name + text(", the sharpest at (%.4g, %.4g, %.4g) mm", x[0], x[1], x[2]),
          text("%.3g degrees", largest * 180 / M_PI, 0, 0), "",
          "Export it with more triangles on the radii (90 degrees in at least three); raise `Feature angle` if it is "
          "meant to be round; or set `Sharp edges = keep` if the sheet does not touch them."));
    }
  } // namespace

  SmoothSurface::SmoothSurface(const TriangleMesh &mesh, const Options &options) : name(mesh.name)
  {
    const MeshTopology  topology(mesh);
    const CornerNormals normals = estimate_normals(mesh, topology, options.feature_angle);
    if (!options.keep_sharp_edges)
      refuse_sharp_edges(mesh, topology, normals, options.feature_angle);
    n_border_edges = topology.n_border_edges();
    make_patches(mesh, topology, normals);
    make_boxes();
    find_smallest_radius(mesh, normals);
  }

  void
  SmoothSurface::make_patches(const TriangleMesh &mesh, const MeshTopology &topology, const CornerNormals &normals)
  {
    std::vector<Join>     at_vertex(mesh.vertices.size(), Join::smooth);
    std::vector<Vector3d> around(mesh.vertices.size(), Vector3d::Zero());
    patches.resize(mesh.triangles.size());
    for (std::size_t t = 0; t < patches.size(); ++t)
      for (unsigned k = 0; k < 3; ++k)
        {
          const auto &next   = topology.opposite(t, k);
          const Join  join   = next.triangle < 0 ? Join::border : normals.sharp[t][k] ? Join::sharp : Join::smooth;
          patches[t].edge[k] = join;
          if (join == Join::sharp)
            patches[t].beyond_edge[k] = topology.facet_normals()[static_cast<std::size_t>(next.triangle)];
          for (const unsigned v : { mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3] })
            if (join == Join::sharp || (join == Join::border && at_vertex[v] == Join::smooth))
              at_vertex[v] = join;
          const Vector3d a = (mesh.corner(t, k + 1) - mesh.corner(t, k)).normalized(),
                         b = (mesh.corner(t, k + 2) - mesh.corner(t, k)).normalized();
          around[mesh.triangles[t][k]]
              += std::atan2(a.cross(b).norm(), a.dot(b)) * topology.facet_normals()[t]; // weighted by the angle
        }
    for (std::size_t t = 0; t < patches.size(); ++t)
      {
        std::array<Vector3d, 3>            x, n;
        std::array<SmoothPatch::Border, 3> borders;
        for (unsigned k = 0; k < 3; ++k)
          {
            x[k]                        = mesh.corner(t, k);
            n[k]                        = normals.of(t, k);
            patches[t].corner[k]        = at_vertex[mesh.triangles[t][k]];
            patches[t].around_corner[k] = around[mesh.triangles[t][k]].normalized();
            const Vector3d chord        = (mesh.corner(t, k + 1) - mesh.corner(t, k)).normalized();
            const auto    &next         = topology.opposite(t, k);
            const bool     sharp        = normals.sharp[t][k];
            const auto     other        = [&](const unsigned corner) {
              return sharp ? &normals.of(static_cast<std::size_t>(next.triangle), corner) : nullptr;
            };
            borders[k] = { border_direction(chord, n[k], other(next.edge + 1)),
                           border_direction(chord, normals.of(t, k + 1), other(next.edge)) };
          }
        patches[t].surface = SmoothPatch(x, n, borders);
      }
  }

  void
  SmoothSurface::make_boxes()
  {
    std::vector<Eigen::AlignedBox3d> around(patches.size());
    for (std::size_t t = 0; t < patches.size(); ++t)
      {
        for (const Vector3d &point : patches[t].surface.control_points())
          around[t].extend(point);
        all.extend(around[t]);
      }
    std::vector<unsigned> order(patches.size());
    std::iota(order.begin(), order.end(), 0u);
    boxes.push_back({ {}, 0, static_cast<unsigned>(order.size()) });
    split(0, order, around);
    std::vector<Patch> sorted(patches.size());
    for (std::size_t i = 0; i < order.size(); ++i)
      sorted[i] = std::move(patches[order[i]]);
    patches = std::move(sorted);
    for (const Patch &patch : patches)
      {
        const SmoothPatch &s  = patch.surface;
        const Vector3d     ab = s.corner(1) - s.corner(0), ac = s.corner(2) - s.corner(0);
        facets.push_back(
            { s.corner(0), ab, ac, ab.squaredNorm(), ab.dot(ac), ac.squaredNorm(), s.largest_deviation() });
      }
  }

  void
  SmoothSurface::split(const unsigned box, std::vector<unsigned> &order, const std::vector<Eigen::AlignedBox3d> &around)
  {
    const unsigned      first = boxes[box].first, count = boxes[box].count;
    Eigen::AlignedBox3d bounds, centres;
    for (unsigned i = first; i < first + count; ++i)
      {
        bounds.extend(around[order[i]]);
        centres.extend(around[order[i]].center());
      }
    const Vector3d rounding
        = Vector3d::Constant(1e-6 * all.diagonal().norm()) + 1e-6 * all.max().cwiseAbs() + 1e-6 * all.min().cwiseAbs();
    boxes[box].bounds.min() = (bounds.min() - rounding).cast<float>();
    boxes[box].bounds.max() = (bounds.max() + rounding).cast<float>();
    if (count <= 2)
      return;
    int axis = 0;
    centres.sizes().maxCoeff(&axis);
    const unsigned half = count / 2;
    std::nth_element(
        order.begin() + first, order.begin() + first + half, order.begin() + first + count,
        [&](const unsigned a, const unsigned b) { return around[a].center()[axis] < around[b].center()[axis]; });
    const auto child = static_cast<unsigned>(boxes.size());
    boxes.push_back({ {}, first, half });
    boxes.push_back({ {}, first + half, count - half });
    boxes[box].first = child;
    boxes[box].count = 0;
    split(child, order, around); // as deep as the logarithm of the number of patches
    split(child + 1, order, around);
  }

  bool
  SmoothSurface::Foot::at_border() const
  {
    return u <= at_edge || v <= at_edge || 1 - u - v <= at_edge;
  }

  void
  SmoothSurface::approach(const Vector3d &x, Foot &foot)
  {
    // Newton for the nearest point, inside of the triangle of (u, v); what would leave it stops at a border and goes
    // on along it.
    constexpr int most_steps = 20;
    const auto    evaluate   = [&](const double u, const double v) {
      foot.u       = u;
      foot.v       = v;
      foot.point   = foot.patch->surface.evaluate(u, v);
      foot.squared = (foot.point.x - x).squaredNorm();
    };
    evaluate(foot.u, foot.v);
    for (int step = 0; step < most_steps; ++step)
      {
        const auto    &p = foot.point;
        const Vector3d r = p.x - x;
        const Vector2d gradient(r.dot(p.u), r.dot(p.v));
        Matrix2d       metric, h;
        metric << p.u.dot(p.u), p.u.dot(p.v), p.u.dot(p.v), p.v.dot(p.v);
        h = metric;
        h(0, 0) += r.dot(p.uu);
        h(1, 0) = h(0, 1) += r.dot(p.uv);
        h(1, 1) += r.dot(p.vv);
        if (!(h.trace() > 0 && h.determinant() > 1e-3 * metric.determinant()))
          h = metric; // beyond a centre of curvature
        Vector2d     move = -h.inverse() * gradient;
        const double w    = 1 - foot.u - foot.v;
        // A direction along a border, as far as the border goes.
        const auto along = [&](const Vector2d &e) { return (-gradient.dot(e) / e.dot(h * e) * e).eval(); };
        const auto room  = [&](const Vector2d &m) {
          double       share   = 1;
          const double from[3] = { w, foot.u, foot.v }, change[3] = { -m[0] - m[1], m[0], m[1] };
          for (int k = 0; k < 3; ++k)
            if (change[k] < 0)
              share = std::min(share, from[k] <= at_edge ? 0 : -from[k] / change[k]);
          return share;
        };
        double share = room(move);
        if (share == 0)
          {
            // At a border, and out of it: the borders we are at, one after the other.
            const Vector2d directions[3] = { { 1, -1 }, { 0, 1 }, { 1, 0 } };
            const double   at[3]         = { w, foot.u, foot.v };
            for (int k = 0; k < 3 && share == 0; ++k)
              if (at[k] <= at_edge)
                {
                  move  = along(directions[k]);
                  share = room(move);
                }
            if (share == 0)
              return; // in a corner
          }
        move *= share;
        const double length = std::sqrt(move.dot(metric * move)), u = foot.u, v = foot.v, before = foot.squared;
        evaluate(std::max(0., u + move[0]), std::max(0., v + move[1]));
        // Cut what overshoots. Small steps do not, and rounding would be taken for it.
        const double size = std::sqrt(metric.trace());
        for (int cut = 0; cut < 5 && length > 1e-4 * size && foot.squared > before; ++cut)
          {
            move *= 0.4;
            evaluate(std::max(0., u + move[0]), std::max(0., v + move[1]));
          }
        // Quadratic convergence: the next step would be of the order of the square of this one.
        if (length < 1e-8 * size && share == 1)
          return;
      }
  }

  double
  SmoothSurface::Facet::nearest(const Vector3d &x, double &u, double &v) const
  {
    // By the regions of corners, borders and inside that the point projects to.
    const Vector3d ax   = x - a;
    const double   a_ab = ab.dot(ax), a_ac = ac.dot(ax);     // from a
    const double   b_ab = a_ab - ab_ab, b_ac = a_ac - ab_ac; // from b
    const double   c_ab = a_ab - ab_ac, c_ac = a_ac - ac_ac; // from c
    const double   at_c = a_ab * b_ac - b_ab * a_ac, at_b = c_ab * a_ac - a_ab * c_ac, at_a = b_ab * c_ac - c_ab * b_ac;
    if (a_ab <= 0 && a_ac <= 0)
      u = v = 0;
    else if (b_ab >= 0 && b_ac <= b_ab)
      {
        u = 1;
        v = 0;
      }
    else if (c_ac >= 0 && c_ab <= c_ac)
      {
        u = 0;
        v = 1;
      }
    else if (at_c <= 0 && a_ab >= 0 && b_ab <= 0)
      {
        u = a_ab / (a_ab - b_ab);
        v = 0;
      }
    else if (at_b <= 0 && a_ac >= 0 && c_ac <= 0)
      {
        u = 0;
        v = a_ac / (a_ac - c_ac);
      }
    else if (at_a <= 0)
      {
        const double from_b = b_ac - b_ab, from_c = c_ab - c_ac;
        v = from_b / (from_b + from_c);
        u = 1 - v;
      }
    else
      {
        const double scale = 1 / (at_a + at_b + at_c);
        u                  = at_b * scale;
        v                  = at_c * scale;
      }
    return (ax - u * ab - v * ac).norm();
  }

  float
  SmoothSurface::Box::squared_distance(const Eigen::Vector3f &x) const
  {
    return (x - x.cwiseMax(bounds.min()).cwiseMin(bounds.max())).squaredNorm();
  }

  SmoothSurface::Foot
  SmoothSurface::nearest(const Vector3d &x) const
  {
    // First the flat triangles: the patch is at most its bulge nearer or further. Then the patches that are left.
    struct Candidate
    {
      unsigned patch;
      double   flat, u, v;
    };
    std::array<Candidate, 64> candidates;
    std::size_t               n_candidates = 0;
    Foot                      best;
    best.squared     = std::numeric_limits<double>::infinity();
    double     limit = best.squared; // a bound of the distance
    const auto solve = [&](const Candidate &c) {
      if (c.flat - facets[c.patch].bulge >= limit)
        return;
      Foot foot;
      foot.patch = &patches[c.patch];
      foot.u     = c.u;
      foot.v     = c.v;
      approach(x, foot);
      // On a common border one of two neighbours stops at it and the other a hair further, where rounding hides which
      // is nearer: the one that could move freely is right.
      const double tie = 1e-12 * foot.squared;
      if (foot.squared < best.squared - (foot.at_border() ? tie : -tie))
        best = foot;
      limit = std::min(limit, std::sqrt(foot.squared));
    };

    struct Waiting
    {
      unsigned box;
      float    squared;
    };
    std::array<Waiting, 128> stack; // twice the depth of the tree would do
    std::size_t              n        = 0;
    float                    within   = std::numeric_limits<float>::infinity(); // the bound squared
    const double             rounding = 1e-6 * x.norm();                        // of single precision
    const Eigen::Vector3f    place    = x.cast<float>();
    stack[n++]                        = { 0, 0 };
    while (n > 0)
      {
        const Waiting next = stack[--n];
        if (next.squared > within)
          continue;
        const Box &box = boxes[next.box];
        if (box.count == 0)
          {
            Waiting nearer{ box.first, boxes[box.first].squared_distance(place) };
            Waiting further{ box.first + 1, boxes[box.first + 1].squared_distance(place) };
            if (further.squared < nearer.squared)
              std::swap(nearer, further);
            stack[n++] = further;
            stack[n++] = nearer;
            continue;
          }
        for (unsigned i = box.first; i < box.first + box.count; ++i)
          {
            Candidate c{ i, 0, 0, 0 };
            c.flat             = facets[i].nearest(x, c.u, c.v);
            const double bulge = facets[i].bulge;
            if (c.flat - bulge > limit)
              continue;
            if (c.flat + bulge < limit)
              {
                limit  = c.flat + bulge;
                within = static_cast<float>((limit + rounding) * (limit + rounding));
              }
            if (n_candidates == candidates.size())
              solve(c);
            else
              candidates[n_candidates++] = c;
          }
      }
    // A hair more than the bound, so that the patch which gave it is not left out.
    limit = limit * (1 + 1e-12) + 1e-12;
    std::sort(candidates.begin(), candidates.begin() + static_cast<std::ptrdiff_t>(n_candidates),
              [](const Candidate &a, const Candidate &b) { return a.flat < b.flat; });
    for (std::size_t i = 0; i < n_candidates; ++i)
      solve(candidates[i]);
    return best;
  }

  ToolDistance
  SmoothSurface::at_sharp_place(const Vector3d &x, const Foot &foot, const int edge, const int corner)
  {
    const Vector3d r      = x - foot.point.x;
    const double   length = r.norm();
    const Vector3d own    = foot.point.u.cross(foot.point.v).normalized();
    const Vector3d mean
        = corner >= 0 ? foot.patch->around_corner[corner] : (own + foot.patch->beyond_edge[edge]).normalized().eval();
    if (length < 1e-9)
      return { 0, mean, Matrix3d::Zero() };
    const double   side      = r.dot(mean) < 0 ? -1 : 1;
    const Vector3d n         = side * r / length;
    Matrix3d       curvature = (Matrix3d::Identity() - n * n.transpose()) / (side * length);
    if (corner < 0)
      {
        // Along the edge the foot moves with the point, as far as the edge is straight.
        const Vector3d t = edge == 0 ? foot.point.u : edge == 1 ? (foot.point.v - foot.point.u).eval() : foot.point.v;
        curvature -= t * t.transpose() / t.squaredNorm() / (side * length);
      }
    return { side * length, n, curvature };
  }

  ToolDistance
  SmoothSurface::at_foot(const Vector3d &x, const Foot &foot)
  {
    const double at[3] = { foot.v, 1 - foot.u - foot.v, foot.u }; // distance from the edges 0, 1, 2
    int          edge = -1, corner = -1;
    for (int k = 0; k < 3; ++k)
      if (at[k] <= at_edge)
        {
          corner = edge < 0 ? -1 : (edge == 0 && k == 2) ? 0 : k;
          edge   = k;
        }
    if ((corner >= 0 && foot.patch->corner[corner] == Join::sharp)
        || (corner < 0 && edge >= 0 && foot.patch->edge[edge] == Join::sharp))
      return at_sharp_place(x, foot, edge, corner);

    const auto    &p = foot.point;
    const Vector3d n = p.u.cross(p.v).normalized();
    ToolDistance   result{ n.dot(x - p.x), n, Matrix3d::Zero() };
    Tangents       t;
    t << p.u, p.v;
    const Matrix2d metric = t.transpose() * t;
    Matrix2d       bending;
    bending << n.dot(p.uu), n.dot(p.uv), n.dot(p.uv), n.dot(p.vv);
    const Matrix2d h = metric - result.distance * bending;
    if (!(h.trace() > 0 && h.determinant() > 1e-6 * metric.determinant()))
      return result; // beyond a centre of curvature
    // How the foot moves with the point: everywhere in the patch, along a border, or not at all in a corner.
    Matrix2d   response    = h.inverse();
    const bool border_edge = edge >= 0 && corner < 0 && foot.patch->edge[edge] == Join::border;
    if (corner >= 0 && foot.patch->corner[corner] == Join::border)
      return result;
    if (border_edge)
      {
        const Vector2d e = edge == 0 ? Vector2d(1, 0) : edge == 1 ? Vector2d(-1, 1) : Vector2d(0, 1);
        response         = e * e.transpose() / e.dot(h * e);
      }
    const Matrix3d c = -t * metric.inverse() * bending * response * t.transpose();
    result.curvature = 0.5 * (c + c.transpose());
    return result;
  }

  ToolDistance
  SmoothSurface::distance(const Vector3d &x) const
  {
    return at_foot(x, nearest(x));
  }

  void
  SmoothSurface::find_smallest_radius(const TriangleMesh &mesh, const CornerNormals &normals)
  {
    // Along an edge the normal turns by the mean curvature of the way. On a radius it swings about that of the shape,
    // and single edges may be spoilt: the mean of those within 30 % of what a hundredth of the edges exceeds.
    const double        flat = 1 / all.diagonal().norm();
    std::vector<double> curvatures;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (unsigned k = 0; k < 3; ++k)
        {
          const Vector3d e         = mesh.corner(t, k + 1) - mesh.corner(t, k);
          const double   curvature = e.dot(normals.of(t, k + 1) - normals.of(t, k)) / e.squaredNorm();
          if (curvature > flat)
            curvatures.push_back(curvature);
        }
    if (curvatures.empty())
      return;
    const auto hundredth = curvatures.end() - 1 - static_cast<std::ptrdiff_t>(curvatures.size() / 100);
    std::nth_element(curvatures.begin(), hundredth, curvatures.end());
    double       sum   = 0;
    unsigned     n     = 0;
    const double limit = 0.7 * *hundredth;
    for (auto curvature = curvatures.begin(); curvature <= hundredth; ++curvature)
      if (*curvature >= limit)
        {
          sum += *curvature;
          ++n;
        }
    radius = n / sum;
  }

  Eigen::AlignedBox3d
  SmoothSurface::extent() const
  {
    return all;
  }

  std::string
  SmoothSurface::describe() const
  {
    const Vector3d size = extent().sizes();
    return "surface of " + std::to_string(patches.size()) + " triangles from " + name
           + text(", %.4g x %.4g x %.4g mm, ", size[0], size[1], size[2])
           + (n_border_edges == 0 ? "closed" : "with a border of " + std::to_string(n_border_edges) + " edges")
           + (std::isinf(radius) ? "" : text(", smallest convex radius %.3g mm", radius, 0, 0));
  }
} // namespace tribodraw
