#ifndef tribodraw_shell_delaunay_h
#define tribodraw_shell_delaunay_h

#include <Eigen/Core>

#include <array>
#include <vector>

namespace tribodraw
{
  /// Delaunay triangulation of points in the plane by insertion and edge flips (C. L. Lawson, in: Mathematical Software
  /// III, Academic Press, 1977, 161). Flips that would turn a triangle inside out are not made, so that round-off can
  /// cost the Delaunay property at an edge but never a valid mesh.
  class Delaunay
  {
  public:
    struct Triangle
    {
      std::array<int, 3> vertex;    ///< counter-clockwise
      std::array<int, 3> neighbour; ///< across the side opposite to the vertex; -1: none
    };

    /// @param points different from each other, in an order in which consecutive ones are mostly close
    explicit Delaunay(const std::vector<Eigen::Vector2d> &points);

    /// Keep the triangles for which @p inside (of the centroid) is true; those at the corners of the enclosing triangle
    /// always go.
    template <class Inside>
    void keep(const Inside &inside);

    /// Move the points from @p first_free on towards even edge lengths relative to @p size (of a position) wherever
    /// that does not make the worst adjacent triangle worse, and flip.
    template <class Size>
    void smooth(unsigned first_free, const Size &size);

    std::vector<Eigen::Vector2d> point; ///< three corners of an enclosing triangle follow the given points
    std::vector<Triangle>        triangle;

    /// 4 sqrt(3) area / sum of squared sides: 1 for equilateral, 0 or less for degenerate triangles.
    double quality(const std::array<int, 3> &vertex) const;

  private:
    double                        twice_area(int a, int b, int c) const;
    int                           locate(int p, int start) const;
    int                           insert(int p, int start);
    void                          replace_neighbour(int of, int old_one, int new_one);
    bool                          flip_if_better(int t, int side);
    void                          legalise(std::vector<int> &suspects);
    void                          remove(const std::vector<bool> &marked);
    std::vector<std::vector<int>> triangles_of_points() const;

    double tolerance = 0; ///< distance from an edge that counts as on it
  };

  template <class Inside>
  void
  Delaunay::keep(const Inside &inside)
  {
    const int         n_given = static_cast<int>(point.size()) - 3;
    std::vector<bool> marked;
    for (const Triangle &t : triangle)
      {
        const auto &v = t.vertex;
        marked.push_back(v[0] >= n_given || v[1] >= n_given || v[2] >= n_given
                         || !inside(Eigen::Vector2d((point[v[0]] + point[v[1]] + point[v[2]]) / 3)));
      }
    remove(marked);
  }

  template <class Size>
  void
  Delaunay::smooth(const unsigned first_free, const Size &size)
  {
    constexpr unsigned n_sweeps = 15;
    for (unsigned sweep = 0; sweep < n_sweeps; ++sweep)
      {
        const auto around = triangles_of_points();
        for (std::size_t p = first_free; p + 3 < point.size(); ++p)
          {
            const Eigen::Vector2d old_place = point[p];
            Eigen::Vector2d       sum       = Eigen::Vector2d::Zero();
            double                weights = 0, worst = 1;
            for (const int t : around[p])
              {
                worst = std::min(worst, quality(triangle[t].vertex));
                for (const int other : triangle[t].vertex)
                  {
                    const double weight
                        = (point[other] - old_place).norm() / size(Eigen::Vector2d(0.5 * (point[other] + old_place)));
                    sum += weight * point[other];
                    weights += weight;
                  }
              }
            if (!(weights > 0))
              continue;
            point[p]         = sum / weights;
            double worst_new = 1;
            for (const int t : around[p])
              worst_new = std::min(worst_new, quality(triangle[t].vertex));
            if (!(worst_new >= worst))
              point[p] = old_place;
          }
        std::vector<int> all(triangle.size());
        for (std::size_t t = 0; t < all.size(); ++t)
          all[t] = static_cast<int>(t);
        legalise(all);
      }
  }
} // namespace tribodraw

#endif
