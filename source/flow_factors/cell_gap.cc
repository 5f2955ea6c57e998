#include <tribodraw/flow_factors/cell_gap.h>

#include <algorithm>

namespace tribodraw
{
  namespace
  {
    double
    mean_square(const std::vector<double> &values)
    {
      double sum = 0;
      for (const double v : values)
        sum += v * v;
      return values.empty() ? 0. : sum / static_cast<double>(values.size());
    }

    // Share of the cut height that belongs to the sheet; all of it when both surfaces are flat.
    double
    share_of_sheet(const HeightMap &sheet, const HeightMap &tool)
    {
      const double tool_square = mean_square(tool.z);
      return tool_square > 0 ? 1 - tool_square / (tool_square + mean_square(sheet.z)) : 1.;
    }

    // Regions as trees of pixels (union-find). Every pixel also knows how many periods lie between itself and its
    // parent, so that a path that closes with a period left over shows a region that meets its own image.
    struct RegionForest
    {
      struct Offset
      {
        int x = 0, y = 0;
      };

      std::vector<int>                 parent;
      std::vector<Offset>              offset; // of the pixel relative to its parent
      std::array<std::vector<char>, 2> wraps;  // by axis, valid at roots

      explicit RegionForest(const std::size_t n)
          : parent(n), offset(n), wraps{ { std::vector<char>(n, 0), std::vector<char>(n, 0) } }
      {
        for (std::size_t i = 0; i < n; ++i)
          parent[i] = static_cast<int>(i);
      }

      // Root of pixel i, and the offset of i relative to it; halves the path on the way.
      int
      find(int i, Offset &total)
      {
        total = {};
        while (parent[i] != i)
          {
            const int up = parent[i];
            offset[i]    = { offset[i].x + offset[up].x, offset[i].y + offset[up].y };
            parent[i]    = parent[up];
            total        = { total.x + offset[i].x, total.y + offset[i].y };
            i            = parent[i];
          }
        return i;
      }

      // Put a new pixel into the tree of its neighbour.
      void
      follow(const int i, const int neighbour)
      {
        parent[i] = parent[neighbour];
        offset[i] = offset[neighbour];
      }

      // Join pixels a and b; the step from a to b crosses `step` periods.
      void
      join(const int a, const int b, const Offset step)
      {
        Offset       from_a, from_b;
        const int    root_a = find(a, from_a), root_b = find(b, from_b);
        const Offset gap{ from_a.x + step.x - from_b.x, from_a.y + step.y - from_b.y };
        if (root_a == root_b)
          {
            wraps[0][root_a] |= gap.x != 0;
            wraps[1][root_a] |= gap.y != 0;
            return;
          }
        parent[root_b] = root_a;
        offset[root_b] = gap;
        for (std::vector<char> &w : wraps)
          w[root_a] |= w[root_b];
      }
    };
  } // namespace

  CellGap
  make_cell_gap(const HeightMap &sheet, const HeightMap &tool, const double cut_height, const double closed_gap)
  {
    CellGap result;
    result.closed_gap   = closed_gap;
    const std::size_t n = sheet.size();
    result.gap.resize(n);
    result.carried.resize(n);
    const double difference_of_shares = 2 * share_of_sheet(sheet, tool) - 1;
    std::size_t  contact              = 0;
    for (std::size_t i = 0; i < n; ++i)
      {
        const double t   = tool.z.empty() ? 0. : tool.z[i];
        const double h   = cut_height - sheet.z[i] - t;
        const bool   dry = h <= 0;
        contact += dry;
        result.gap[i]     = dry ? 0. : h;
        result.carried[i] = dry ? 0. : difference_of_shares * cut_height - sheet.z[i] + t;
        result.mean_gap += result.gap[i];
        result.mean_carried += result.carried[i];
      }
    result.mean_gap /= static_cast<double>(n);
    result.mean_carried /= static_cast<double>(n);
    result.contact_fraction = static_cast<double>(contact) / static_cast<double>(n);
    return result;
  }

  CellConnectivity::CellConnectivity(const CellGrid &grid_in, const CellGap &gap_in) : grid(grid_in), gap(gap_in)
  {
    label_regions();
  }

  // Runs of open pixels in a row share the parent of their first pixel; rows are joined where runs first meet.
  void
  CellConnectivity::label_regions()
  {
    RegionForest forest(grid.size());
    const int    nx = static_cast<int>(grid.nx), ny = static_cast<int>(grid.ny);
    for (int iy = 0; iy < ny; ++iy)
      {
        const int first = iy * nx, below = iy > 0 ? first - nx : -1;
        for (int ix = 0; ix < nx; ++ix)
          {
            const int i = first + ix;
            if (!gap.open(i))
              continue;
            const bool continued = ix > 0 && gap.open(i - 1);
            if (continued)
              forest.follow(i, i - 1);
            if (below >= 0 && gap.open(below + ix) && !(continued && gap.open(below + ix - 1)))
              forest.join(below + ix, i, {});
          }
      }
    if (grid.periodic)
      {
        for (int iy = 0; iy < ny; ++iy)
          if (gap.open(iy * nx + nx - 1) && gap.open(iy * nx))
            forest.join(iy * nx + nx - 1, iy * nx, { 1, 0 });
        for (int ix = 0; ix < nx; ++ix)
          if (gap.open((ny - 1) * nx + ix) && gap.open(ix))
            forest.join((ny - 1) * nx + ix, ix, { 0, 1 });
      }
    RegionForest::Offset unused;
    for (std::size_t i = 0; i < grid.size(); ++i)
      forest.parent[i] = forest.find(static_cast<int>(i), unused);
    root  = std::move(forest.parent);
    wraps = std::move(forest.wraps);
  }

  // Marks the roots of regions that lead through the cell along the axis.
  std::vector<char>
  CellConnectivity::conducting_roots(const int axis) const
  {
    std::vector<char> conducts = wraps[axis];
    if (grid.periodic)
      return conducts;
    std::vector<char> touches_lower(grid.size(), 0);
    for (const int cell : grid.lower_boundary[axis])
      if (gap.open(cell))
        touches_lower[root[cell]] = 1;
    for (const int cell : grid.upper_boundary[axis])
      if (gap.open(cell) && touches_lower[root[cell]])
        conducts[root[cell]] = 1;
    return conducts;
  }

  bool
  CellConnectivity::conducts(const int axis) const
  {
    const std::vector<char> roots = conducting_roots(axis);
    return std::find(roots.begin(), roots.end(), 1) != roots.end();
  }

  std::vector<int>
  CellConnectivity::conducting_regions(const int axis) const
  {
    std::vector<char> conducts = conducting_roots(axis);
    if (grid.periodic)
      {
        const std::vector<char> other = conducting_roots(1 - axis);
        for (std::size_t i = 0; i < conducts.size(); ++i)
          conducts[i] |= other[i];
      }
    std::vector<int> number(grid.size(), -1), region(grid.size(), -1);
    int              n_regions = 0;
    for (std::size_t i = 0; i < grid.size(); ++i)
      if (gap.open(static_cast<int>(i)) && conducts[root[i]])
        {
          if (number[root[i]] < 0)
            number[root[i]] = n_regions++;
          region[i] = number[root[i]];
        }
    return region;
  }
} // namespace tribodraw
