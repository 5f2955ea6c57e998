#include <tribodraw/flow_factors/cell_trial_fields.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tribodraw
{
  namespace
  {
    // Differences of the four corner values of a pixel: along x below and above, along y left and right, twist.
    // Corners: (0,0), (1,0), (0,1), (1,1).
    template <class Number>
    struct Differences
    {
      Number below, above, left, right, twist;

      Differences(const Number v0, const Number v1, const Number v2, const Number v3)
          : below(v1 - v0), above(v3 - v2), left(v2 - v0), right(v3 - v1), twist(above - below)
      {
      }
    };
  } // namespace

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
    u.assign(fixed.size(), Values{});
    face_flux[0].assign(mx * grid.ny, Values{});
    face_flux[1].assign(grid.nx * my, Values{});
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
    std::size_t ix = grid.coordinate(cell, 0), iy = grid.coordinate(cell, 1);
    if (face == left || face == right)
      {
        ix += face == right;
        return iy * mx + (ix == mx ? 0 : ix);
      }
    iy += face == top;
    return (iy == my ? 0 : iy) * grid.nx + ix;
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
    const int  axis = face == left || face == right ? 0 : 1, n = static_cast<int>(grid.n(axis));
    const int  stride = axis == 0 ? 1 : static_cast<int>(grid.nx), i = static_cast<int>(grid.coordinate(cell, axis));
    const bool up = face == right || face == top;
    if (up ? i + 1 < n : i > 0)
      return cell + (up ? stride : -stride);
    return grid.periodic ? cell + (up ? -(n - 1) * stride : (n - 1) * stride) : -1;
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
    std::array<Values, 2> result{};
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

  // Minus half the derivative of the primal energies (times the number of cells / area) by the corner values.
  std::vector<CellTrialFields::SingleValues>
  CellTrialFields::potential_residual() const
  {
    std::vector<Values> sum(u.size(), Values{});
    const double        dx = grid.dx, dy = grid.dy, twist = (1 / (dx * dx) + 1 / (dy * dy)) / 12;
    for (std::size_t i = 0; i < cells.size(); ++i)
      {
        const auto  kg = drive(i);
        const auto &c  = corners[i];
        for (int f = 0; f < n_fields; ++f)
          {
            const Differences<double> d(u[c[0]][f], u[c[1]][f], u[c[2]][f], u[c[3]][f]);
            const double              x = (kg[0][f] + k[i] * (d.below + d.above) / (2 * dx)) / (2 * dx);
            const double              y = (kg[1][f] + k[i] * (d.left + d.right) / (2 * dy)) / (2 * dy);
            const double              t = k[i] * d.twist * twist;
            sum[c[0]][f] += x + y - t;
            sum[c[1]][f] += -x + y + t;
            sum[c[2]][f] += x - y + t;
            sum[c[3]][f] += -x - y - t;
          }
      }
    std::vector<SingleValues> result(u.size());
    for (std::size_t c = 0; c < u.size(); ++c)
      for (int f = 0; f < n_fields; ++f)
        result[c][f] = static_cast<float>(sum[c][f]);
    return result;
  }

  // The same for <|q - k g|^2 / k> and a circulation z around each corner: it adds the difference of the values at the
  // ends of a face to its flux, over a face across x upper minus lower, across y left minus right.
  std::vector<CellTrialFields::SingleValues>
  CellTrialFields::circulation_residual() const
  {
    std::vector<Values> sum(u.size(), Values{});
    const double        dx = grid.dx, dy = grid.dy;
    for (std::size_t i = 0; i < cells.size(); ++i)
      {
        const auto    kg = drive(i);
        const auto   &c  = corners[i];
        const Values &ql = face_values(cells[i], left), &qr = face_values(cells[i], right),
                     &qb = face_values(cells[i], bottom), &qt = face_values(cells[i], top);
        for (int f = 0; f < n_fields; ++f)
          {
            // derivatives by the flux over each face
            const double mean_x = ((ql[f] + qr[f]) / (2 * dy) - kg[0][f]) / (2 * dy * k[i]);
            const double mean_y = ((qb[f] + qt[f]) / (2 * dx) - kg[1][f]) / (2 * dx * k[i]);
            const double rise_x = (qr[f] - ql[f]) / (12 * dy * dy * k[i]),
                         rise_y = (qt[f] - qb[f]) / (12 * dx * dx * k[i]);
            const double l = mean_x - rise_x, r = mean_x + rise_x, b = mean_y - rise_y, t = mean_y + rise_y;
            sum[c[0]][f] += l - b;
            sum[c[1]][f] += r + b;
            sum[c[2]][f] += -l - t;
            sum[c[3]][f] += -r + t;
          }
      }
    std::vector<SingleValues> result(u.size());
    for (std::size_t c = 0; c < u.size(); ++c)
      for (int f = 0; f < n_fields; ++f)
        result[c][f] = static_cast<float>(sum[c][f]);
    return result;
  }

  // Conjugate gradients on corner values with diagonal preconditioner. The matrix is that of Q1 with the coefficient k
  // for potentials and 1/k for circulations (a circulation is a turned gradient). Any result gives valid bounds,
  // therefore single precision is enough.
  std::vector<CellTrialFields::SingleValues>
  CellTrialFields::descend(std::vector<SingleValues> residual, const bool circulation, const unsigned steps) const
  {
    const double dx = grid.dx, dy = grid.dy;
    const float  ax = static_cast<float>(1 / (4 * dx * dx)), ay = static_cast<float>(1 / (4 * dy * dy)),
                at       = (ax + ay) / 3;
    const std::size_t  n = u.size();
    std::vector<float> inverse_diagonal(n, 0.f);
    for (std::size_t i = 0; i < cells.size(); ++i)
      for (const int c : corners[i])
        inverse_diagonal[c] += static_cast<float>(circulation ? 1 / k[i] : k[i]) * (ax + ay + at);
    const std::vector<char> &mask = circulation ? closed : fixed;
    for (std::size_t c = 0; c < n; ++c)
      inverse_diagonal[c] = mask[c] || !(inverse_diagonal[c] > 0) ? 0.f : 1 / inverse_diagonal[c];

    std::vector<SingleValues> x(n, SingleValues{}), p(n, SingleValues{}), ap(n);
    Values                    rz_before{};
    for (unsigned step = 0; step < steps; ++step)
      {
        Values rz{};
        for (std::size_t c = 0; c < n; ++c)
          for (int f = 0; f < n_fields; ++f)
            rz[f] += static_cast<double>(residual[c][f] * residual[c][f] * inverse_diagonal[c]);
        SingleValues beta{};
        for (int f = 0; f < n_fields; ++f)
          beta[f] = rz_before[f] > 0 ? static_cast<float>(rz[f] / rz_before[f]) : 0.f;
        for (std::size_t c = 0; c < n; ++c)
          for (int f = 0; f < n_fields; ++f)
            {
              p[c][f]  = inverse_diagonal[c] * residual[c][f] + beta[f] * p[c][f];
              ap[c][f] = 0;
            }
        Values pap{};
        for (std::size_t i = 0; i < cells.size(); ++i)
          {
            const auto &c     = corners[i];
            const float kappa = static_cast<float>(circulation ? 1 / k[i] : k[i]);
            for (int f = 0; f < n_fields; ++f)
              {
                const Differences<float> d(p[c[0]][f], p[c[1]][f], p[c[2]][f], p[c[3]][f]);
                const float              gx = kappa * ax * (d.below + d.above), gy = kappa * ay * (d.left + d.right);
                const float              gt = kappa * at * d.twist;
                ap[c[0]][f] += gt - gx - gy;
                ap[c[1]][f] += gx - gy - gt;
                ap[c[2]][f] += gy - gx - gt;
                ap[c[3]][f] += gx + gy + gt;
              }
          }
        for (std::size_t c = 0; c < n; ++c)
          for (int f = 0; f < n_fields; ++f)
            pap[f] += static_cast<double>(p[c][f] * ap[c][f]);
        SingleValues alpha{};
        for (int f = 0; f < n_fields; ++f)
          alpha[f] = pap[f] > 0 ? static_cast<float>(rz[f] / pap[f]) : 0.f;
        for (std::size_t c = 0; c < n; ++c)
          for (int f = 0; f < n_fields; ++f)
            {
              x[c][f] += alpha[f] * p[c][f];
              residual[c][f] -= alpha[f] * ap[c][f];
            }
        rz_before = rz;
      }
    return x;
  }

  void
  CellTrialFields::improve(const unsigned steps)
  {
    const std::vector<SingleValues> du = descend(potential_residual(), false, steps);
    for (std::size_t c = 0; c < u.size(); ++c)
      for (int f = 0; f < n_fields; ++f)
        u[c][f] += du[c][f];

    const std::vector<SingleValues> z   = descend(circulation_residual(), true, steps);
    const auto                      add = [](Values &flux, const SingleValues &plus, const SingleValues &minus) {
      for (int f = 0; f < n_fields; ++f)
        flux[f] += static_cast<double>(plus[f]) - static_cast<double>(minus[f]);
    };
    // Each face once: by the cell below it, and over the lower edge of the map by the cell above.
    for (std::size_t i = 0; i < cells.size(); ++i)
      {
        const int   cell = cells[i];
        const auto &c    = corners[i];
        add(face_values(cell, right), z[c[3]], z[c[1]]);
        add(face_values(cell, top), z[c[2]], z[c[3]]);
        if (neighbour(cell, left) < 0)
          add(face_values(cell, left), z[c[2]], z[c[0]]);
        if (neighbour(cell, bottom) < 0)
          add(face_values(cell, bottom), z[c[0]], z[c[1]]);
      }
  }

  void
  CellTrialFields::balance()
  {
    for (int field = 0; field < n_fields; ++field)
      if (set[field])
        balance(field);
  }

  // Rounding to multiples of a quantum, then the excess of each cell goes to its parent, leaves first. Sums and
  // differences of multiples below 2^53 quanta are exact, so nothing is left in the end.
  void
  CellTrialFields::balance(const int field)
  {
    double largest = 0;
    for (const auto &fluxes : face_flux)
      for (const Values &f : fluxes)
        largest = std::max(largest, std::abs(f[field]));
    if (!(largest > 0))
      return;
    const double quantum = std::ldexp(1., std::ilogb(largest) + 1 - 49);
    for (auto &fluxes : face_flux)
      for (Values &f : fluxes)
        f[field] = std::nearbyint(f[field] / quantum) * quantum;
    for (auto cell = tree.rbegin(); cell != tree.rend(); ++cell)
      {
        const double excess = (flux(*cell, right, field) - flux(*cell, left, field))
                              + (flux(*cell, top, field) - flux(*cell, bottom, field));
        const int face = to_parent[*cell];
        if (face < 0)
          {
            if (excess != 0)
              throw std::logic_error("The fluxes in a local Reynolds cell cannot be balanced.");
            continue;
          }
        double &to_change = face_values(*cell, static_cast<Face>(face))[field];
        to_change += face == right || face == top ? -excess : excess;
      }
  }

  CellEnergies
  CellTrialFields::energies() const
  {
    CellEnergies result;
    const double dx = grid.dx, dy = grid.dy;
    // Sums of rows, then of the rows: round-off grows with the length of a row only.
    CellEnergies row;
    const auto   add_row = [&]() {
      for (int a = 0; a < n_fields; ++a)
        {
          for (int b = 0; b < n_fields; ++b)
            {
              result.primal[a][b] += row.primal[a][b];
              result.gap[a][b] += row.gap[a][b];
            }
          result.complementary[a] += row.complementary[a];
        }
      for (const int a : { 0, 1 })
        {
          result.mean_flux[a] += row.mean_flux[a];
          result.mean_magnitude[a] += row.mean_magnitude[a];
        }
      row = CellEnergies();
    };
    std::size_t current_row = 0;
    for (std::size_t i = 0; i < cells.size(); ++i)
      {
        if (grid.coordinate(cells[i], 1) != current_row)
          {
            add_row();
            current_row = grid.coordinate(cells[i], 1);
          }
        const auto    kg = drive(i);
        const auto   &c  = corners[i];
        const Values &ql = face_values(cells[i], left), &qr = face_values(cells[i], right),
                     &qb = face_values(cells[i], bottom), &qt = face_values(cells[i], top);
        // Both fields are linear in the pixel: mean, and rise along x and y of each component.
        Values px, py, pt, tx, ty, tx_x, ty_y;
        for (int f = 0; f < n_fields; ++f)
          {
            const Differences<double> d(u[c[0]][f], u[c[1]][f], u[c[2]][f], u[c[3]][f]);
            px[f]   = kg[0][f] + k[i] * (d.below + d.above) / (2 * dx);
            py[f]   = kg[1][f] + k[i] * (d.left + d.right) / (2 * dy);
            pt[f]   = k[i] * d.twist;
            tx[f]   = (ql[f] + qr[f]) / (2 * dy) - px[f];
            ty[f]   = (qb[f] + qt[f]) / (2 * dx) - py[f];
            tx_x[f] = (qr[f] - ql[f]) / dy;
            ty_y[f] = (qt[f] - qb[f]) / dx;
          }
        const double twist = (1 / (dx * dx) + 1 / (dy * dy)) / 12;
        for (int a = 0; a < n_fields; ++a)
          for (int b = a; b < n_fields; ++b)
            {
              if (a < 2) // that of two shear flows would be dominated by <c^2/k>
                row.primal[a][b] += (px[a] * px[b] + py[a] * py[b] + pt[a] * pt[b] * twist) / k[i];
              row.gap[a][b] += (tx[a] * tx[b] + ty[a] * ty[b] + (tx_x[a] * tx_x[b] + ty_y[a] * ty_y[b]) / 12
                                + pt[a] * pt[b] * twist)
                               / k[i];
            }
        for (int f = 0; f < n_fields; ++f)
          {
            const double qx = (ql[f] + qr[f]) / (2 * dy), qy = (qb[f] + qt[f]) / (2 * dx);
            row.complementary[f] += (qx * qx + qy * qy + (tx_x[f] * tx_x[f] + ty_y[f] * ty_y[f]) / 12) / k[i];
            if (f < 2)
              {
                row.mean_flux[f] += f == 0 ? qx : qy;
                row.mean_magnitude[f] += std::abs(f == 0 ? qx : qy);
              }
          }
      }
    add_row();
    const double n = static_cast<double>(grid.size());
    for (int a = 0; a < n_fields; ++a)
      {
        result.complementary[a] /= n;
        for (int b = a; b < n_fields; ++b)
          {
            result.primal[a][b] /= n;
            result.gap[a][b] /= n;
            result.primal[b][a] = result.primal[a][b];
            result.gap[b][a]    = result.gap[a][b];
          }
      }
    for (const int a : { 0, 1 })
      {
        result.mean_flux[a] /= n;
        result.mean_magnitude[a] /= n;
      }
    return result;
  }
} // namespace tribodraw
