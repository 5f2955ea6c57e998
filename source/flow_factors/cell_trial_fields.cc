#include <tribodraw/flow_factors/cell_trial_fields.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tribodraw
{
  CellTrialFields::CellTrialFields(const CellGrid &grid_in, const CellGap &gap, const std::vector<int> &region,
                                   const int driven_axis_in)
      : grid(grid_in), driven_axis(driven_axis_in), mx(grid.nx + (grid.periodic ? 0 : 1)),
        my(grid.ny + (grid.periodic ? 0 : 1)), position(grid.size(), -1)
  {
    for (std::size_t i = 0; i < grid.size(); ++i)
      if (region[i] >= 0)
        {
          const double h = gap.gap[i] / gap.mean_gap;
          position[i]    = static_cast<int>(cells.size());
          cells.push_back(static_cast<int>(i));
          k.push_back(h * h * h);
          carried.push_back(gap.carried[i] / gap.mean_gap);
        }
    number_corners();
    mark_corners();
    u.assign(fixed.size(), Values::Zero());
    face_flux[0].assign(mx * grid.ny, Values::Zero());
    face_flux[1].assign(grid.nx * my, Values::Zero());
    grow_tree();
  }

  std::size_t
  CellTrialFields::corner_index(const std::size_t ix, const std::size_t iy) const
  {
    return (iy == my ? 0 : iy) * mx + (ix == mx ? 0 : ix);
  }

  std::size_t
  CellTrialFields::face_index(const int cell, const Face face) const
  {
    // 32 bits: division is what this costs
    const auto nx = static_cast<unsigned>(grid.nx), c = static_cast<unsigned>(cell);
    if (face == bottom)
      return c;
    if (face == top)
      return c + nx < grid.nx * my ? c + nx : c + nx - grid.size();
    if (grid.periodic)
      return face == left ? c : (c + 1) % nx == 0 ? c + 1 - nx : c + 1;
    return c + c / nx + (face == right);
  }

  CellTrialFields::Values &
  CellTrialFields::face_values(const int cell, const Face face)
  {
    return face_flux[face == left || face == right ? 0 : 1][face_index(cell, face)];
  }

  const CellTrialFields::Values &
  CellTrialFields::face_values(const int cell, const Face face) const
  {
    return face_flux[face == left || face == right ? 0 : 1][face_index(cell, face)];
  }

  // Cell beyond a face, -1 outside the map.
  int
  CellTrialFields::neighbour(const int cell, const Face face) const
  {
    const int nx = static_cast<int>(grid.nx), size = static_cast<int>(grid.size());
    switch (face)
      {
      case bottom:
        return cell >= nx ? cell - nx : grid.periodic ? cell - nx + size : -1;
      case top:
        return cell + nx < size ? cell + nx : grid.periodic ? cell + nx - size : -1;
      case left:
        return cell % nx > 0 ? cell - 1 : grid.periodic ? cell - 1 + nx : -1;
      default:
        return (cell + 1) % nx > 0 ? cell + 1 : grid.periodic ? cell + 1 - nx : -1;
      }
  }

  void
  CellTrialFields::number_corners()
  {
    corners.reserve(cells.size());
    for (const int cell : cells)
      {
        const std::size_t ix = grid.coordinate(cell, 0), iy = grid.coordinate(cell, 1);
        const auto        index
            = [&](const std::size_t i, const std::size_t j) { return static_cast<int>(corner_index(i, j)); };
        corners.push_back({ { index(ix, iy), index(ix + 1, iy), index(ix, iy + 1), index(ix + 1, iy + 1) } });
      }
    fixed.assign(mx * my, 0);
    closed.assign(mx * my, 1);
    for (std::size_t iy = 0; iy < my; ++iy)
      for (std::size_t ix = 0; ix < mx; ++ix)
        split_corner(ix, iy);
  }

  // Decide on a corner from the four pixels around it: a second value if only two opposite ones are open; free for a
  // circulation if all are, or at an end with given pressure the two that exist.
  void
  CellTrialFields::split_corner(const std::size_t ix, const std::size_t iy)
  {
    const auto cell = [&](const std::size_t i, const std::size_t j) { // i, j are one too large
      if (grid.periodic)
        return static_cast<int>((j == 0 ? grid.ny - 1 : j - 1) * grid.nx + (i == 0 ? grid.nx - 1 : i - 1));
      return i == 0 || j == 0 || i > grid.nx || j > grid.ny ? -1 : static_cast<int>((j - 1) * grid.nx + i - 1);
    };
    const auto is_open   = [this](const int c) { return c >= 0 && open(c); };
    const int  southwest = cell(ix, iy), southeast = cell(ix + 1, iy), northwest = cell(ix, iy + 1),
              northeast = cell(ix + 1, iy + 1);
    const bool sw = is_open(southwest), se = is_open(southeast), nw = is_open(northwest), ne = is_open(northeast);
    const auto second_value = [this](const int c, const int local) {
      corners[position[c]][local] = static_cast<int>(fixed.size());
      fixed.push_back(0);
      closed.push_back(1);
    };
    if (sw && ne && !se && !nw)
      second_value(northeast, 0);
    if (se && nw && !sw && !ne)
      second_value(northwest, 1);
    closed[iy * mx + ix] = !(sw && se && nw && ne);
  }

  void
  CellTrialFields::mark_corners()
  {
    if (grid.periodic)
      return;
    const std::size_t n = grid.n(driven_axis), m = grid.n(1 - driven_axis);
    for (const std::size_t end : { std::size_t(0), n })
      for (std::size_t j = 0; j <= m; ++j)
        {
          const std::size_t corner = driven_axis == 0 ? corner_index(end, j) : corner_index(j, end);
          fixed[corner]            = 1;
          if (j == 0 || j == m)
            continue;
          const std::size_t row  = end == 0 ? 0 : n - 1;
          const auto        cell = [&](const std::size_t beside) {
            return static_cast<int>(driven_axis == 0 ? beside * grid.nx + row : row * grid.nx + beside);
          };
          closed[corner] = !(open(cell(j - 1)) && open(cell(j)));
        }
  }

  // Spanning trees of the open cells. Their roots are the cells at the lower end with given pressure, where the flux
  // over the edge is free; on a periodic grid one cell of each region.
  void
  CellTrialFields::grow_tree()
  {
    constexpr std::int8_t unseen = -2, root = -1;
    constexpr Face        faces[] = { left, right, bottom, top }, opposite[] = { right, left, top, bottom };
    to_parent.assign(grid.size(), unseen);
    tree.reserve(cells.size());
    std::size_t next = 0;
    const auto  grow = [&]() {
      for (; next < tree.size(); ++next)
        for (const Face face : faces)
          {
            const int c = neighbour(tree[next], face);
            if (c < 0 || !open(c) || to_parent[c] != unseen)
              continue;
            to_parent[c] = static_cast<std::int8_t>(opposite[face]);
            tree.push_back(c);
          }
    };
    if (!grid.periodic)
      for (const int c : grid.lower_boundary[driven_axis])
        if (open(c))
          {
            to_parent[c] = static_cast<std::int8_t>(driven_axis == 0 ? left : bottom);
            tree.push_back(c);
          }
    grow();
    for (const int c : cells)
      if (to_parent[c] == unseen)
        {
          to_parent[c] = root;
          tree.push_back(c);
          grow();
        }
  }

  // k g of all fields in an open cell, by axis.
  std::array<CellTrialFields::Values, 2>
  CellTrialFields::drive(const std::size_t i) const
  {
    std::array<Values, 2> result{ { Values::Zero(), Values::Zero() } };
    for (const int axis : { 0, 1 })
      {
        if (set[pressure_field(axis)])
          result[axis][pressure_field(axis)] = k[i];
        if (set[shear_field(axis)])
          result[axis][shear_field(axis)] = -carried[i];
      }
    return result;
  }

  void
  CellTrialFields::start(const int field, const std::vector<double> &pressure,
                         const std::array<std::vector<double>, 2> &upper_flux)
  {
    set[field] = true;
    // The value at a corner makes the fluxes from there to the centres of its cells balance.
    std::vector<double> weight(u.size(), 0.);
    for (std::size_t i = 0; i < cells.size(); ++i)
      {
        const auto   kg = drive(i);
        const double dx = 0.5 * grid.dx * kg[0][field], dy = 0.5 * grid.dy * kg[1][field];
        const double here = k[i] * pressure[cells[i]];
        for (int corner = 0; corner < 4; ++corner)
          {
            // from the corner to the centre: + in x for corners 0 and 2, + in y for 0 and 1
            u[corners[i][corner]][field] += here + (corner % 2 == 0 ? dx : -dx) + (corner < 2 ? dy : -dy);
            weight[corners[i][corner]] += k[i];
          }
      }
    for (std::size_t c = 0; c < u.size(); ++c)
      u[c][field] = weight[c] > 0 && !fixed[c] ? u[c][field] / weight[c] : 0.;

    for (const int cell : cells)
      {
        face_values(cell, right)[field] = -upper_flux[0][cell];
        face_values(cell, top)[field]   = -upper_flux[1][cell];
      }
    if (!grid.periodic)
      for (const int cell : grid.lower_boundary[driven_axis])
        if (open(cell))
          {
            const double across = driven_axis == 0 ? flux(cell, top, field) - flux(cell, bottom, field)
                                                   : flux(cell, right, field) - flux(cell, left, field);
            face_values(cell, driven_axis == 0 ? left : bottom)[field]
                = flux(cell, driven_axis == 0 ? right : top, field) + across;
          }
  }

  double
  CellTrialFields::potential(const int cell, const int corner, const int field) const
  {
    return u[corners[position[cell]][corner]][field];
  }

  double
  CellTrialFields::flux(const int cell, const Face face, const int field) const
  {
    return face_values(cell, face)[field];
  }

  // Rounding to multiples of a quantum, then the excess of each cell goes to its parent, leaves first. Sums and
  // differences of multiples below 2^53 quanta are exact, so nothing is left in the end.
  void
  CellTrialFields::balance()
  {
    Values largest = Values::Constant(1e-100);
    for (const auto &fluxes : face_flux)
      for (const Values &f : fluxes)
        largest = largest.max(f.abs());
    // Beside 1.5 * 2^52 quanta a number has no digits below the quantum.
    Values rounder;
    for (int f = 0; f < n_fields; ++f)
      rounder[f] = std::ldexp(1.5, std::ilogb(largest[f]) + 1 - 49 + 52);
    for (auto &fluxes : face_flux)
      for (Values &f : fluxes)
        {
          const Values sum = f + rounder;
          f                = sum - rounder;
        }
    for (auto cell = tree.rbegin(); cell != tree.rend(); ++cell)
      {
        Values &r = face_values(*cell, right), &l = face_values(*cell, left), &t = face_values(*cell, top),
               &b           = face_values(*cell, bottom);
        const Values excess = (r - l) + (t - b);
        switch (to_parent[*cell])
          {
          case left:
            l += excess;
            break;
          case right:
            r -= excess;
            break;
          case bottom:
            b += excess;
            break;
          case top:
            t -= excess;
            break;
          default:
            if ((excess != 0).any())
              throw std::logic_error("The fluxes in a local Reynolds cell cannot be balanced.");
          }
      }
  }
} // namespace tribodraw
