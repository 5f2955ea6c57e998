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
    template <class Values>
    struct Differences
    {
      Values below, above, left, right, twist;

      Differences(const Values &v0, const Values &v1, const Values &v2, const Values &v3)
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

  // Minus half the derivative of the primal energies (times the number of cells / area) by the corner values.
  std::vector<CellTrialFields::SingleValues>
  CellTrialFields::potential_residual() const
  {
    std::vector<Values> sum(u.size(), Values::Zero());
    const double        dx = grid.dx, dy = grid.dy, twist = (1 / (dx * dx) + 1 / (dy * dy)) / 12;
    for (std::size_t i = 0; i < cells.size(); ++i)
      {
        const auto                kg = drive(i);
        const auto               &c  = corners[i];
        const Differences<Values> d(u[c[0]], u[c[1]], u[c[2]], u[c[3]]);
        const Values              x = (kg[0] + (d.below + d.above) * (k[i] / (2 * dx))) * (1 / (2 * dx));
        const Values              y = (kg[1] + (d.left + d.right) * (k[i] / (2 * dy))) * (1 / (2 * dy));
        const Values              t = d.twist * (k[i] * twist);
        sum[c[0]] += x + y - t;
        sum[c[1]] += y - x + t;
        sum[c[2]] += x - y + t;
        sum[c[3]] -= x + y + t;
      }
    std::vector<SingleValues> result(u.size());
    for (std::size_t c = 0; c < u.size(); ++c)
      result[c] = sum[c].cast<float>();
    return result;
  }

  // The same for <|q - k g|^2 / k> and a circulation z around each corner: it adds the difference of the values at the
  // ends of a face to its flux, over a face across x upper minus lower, across y left minus right.
  std::vector<CellTrialFields::SingleValues>
  CellTrialFields::circulation_residual() const
  {
    std::vector<Values> sum(u.size(), Values::Zero());
    const double        dx = grid.dx, dy = grid.dy;
    for (std::size_t i = 0; i < cells.size(); ++i)
      {
        const auto    kg = drive(i);
        const auto   &c  = corners[i];
        const Values &ql = face_values(cells[i], left), &qr = face_values(cells[i], right),
                     &qb = face_values(cells[i], bottom), &qt = face_values(cells[i], top);
        // derivatives by the flux over each face
        const Values mean_x = ((ql + qr) * (1 / (2 * dy)) - kg[0]) * (1 / (2 * dy * k[i]));
        const Values mean_y = ((qb + qt) * (1 / (2 * dx)) - kg[1]) * (1 / (2 * dx * k[i]));
        const Values rise_x = (qr - ql) * (1 / (12 * dy * dy * k[i])), rise_y = (qt - qb) * (1 / (12 * dx * dx * k[i]));
        const Values l = mean_x - rise_x, r = mean_x + rise_x, b = mean_y - rise_y, t = mean_y + rise_y;
        sum[c[0]] += l - b;
        sum[c[1]] += r + b;
        sum[c[2]] -= l + t;
        sum[c[3]] += t - r;
      }
    std::vector<SingleValues> result(u.size());
    for (std::size_t c = 0; c < u.size(); ++c)
      result[c] = sum[c].cast<float>();
    return result;
  }

  // Conjugate gradients on corner values with diagonal preconditioner. The matrix is that of Q1 with the coefficient k
  // for potentials and 1/k for circulations (a circulation is a turned gradient). Any result gives valid bounds,
  // therefore single precision is enough.
  std::vector<CellTrialFields::SingleValues>
  CellTrialFields::descend(std::vector<SingleValues> residual, const bool circulation, const unsigned steps) const
  {
    const float ax = static_cast<float>(1 / (4 * grid.dx * grid.dx)),
                ay = static_cast<float>(1 / (4 * grid.dy * grid.dy)), at = (ax + ay) / 3;
    const std::size_t  n = u.size();
    std::vector<float> kappa(cells.size()), inverse_diagonal(n, 0.f);
    for (std::size_t i = 0; i < cells.size(); ++i)
      {
        kappa[i] = static_cast<float>(circulation ? 1 / k[i] : k[i]);
        for (const int c : corners[i])
          inverse_diagonal[c] += kappa[i] * (ax + ay + at);
      }
    const std::vector<char> &mask = circulation ? closed : fixed;
    for (std::size_t c = 0; c < n; ++c)
      inverse_diagonal[c] = mask[c] || !(inverse_diagonal[c] > 0) ? 0.f : 1 / inverse_diagonal[c];

    const auto quotient = [](const Values &a, const Values &b) -> SingleValues {
      return (b > 0).select(a / b, Values::Zero()).cast<float>();
    };
    std::vector<SingleValues> x(n, SingleValues::Zero()), p(n, SingleValues::Zero()), ap(n);
    Values                    rz_before = Values::Zero(), rz = Values::Zero();
    for (std::size_t c = 0; c < n; ++c)
      rz += (residual[c] * residual[c] * inverse_diagonal[c]).cast<double>();
    for (unsigned step = 0; step < steps; ++step)
      {
        const SingleValues beta = quotient(rz, rz_before);
        for (std::size_t c = 0; c < n; ++c)
          {
            p[c]  = inverse_diagonal[c] * residual[c] + beta * p[c];
            ap[c] = SingleValues::Zero();
          }
        for (std::size_t i = 0; i < cells.size(); ++i)
          {
            const auto                     &c = corners[i];
            const Differences<SingleValues> d(p[c[0]], p[c[1]], p[c[2]], p[c[3]]);
            const SingleValues gx = (d.below + d.above) * (kappa[i] * ax), gy = (d.left + d.right) * (kappa[i] * ay),
                               gt = d.twist * (kappa[i] * at);
            ap[c[0]] += gt - gx - gy;
            ap[c[1]] += gx - gy - gt;
            ap[c[2]] += gy - gx - gt;
            ap[c[3]] += gx + gy + gt;
          }
        Values pap = Values::Zero();
        for (std::size_t c = 0; c < n; ++c)
          pap += (p[c] * ap[c]).cast<double>();
        const SingleValues alpha = quotient(rz, pap);
        rz_before                = rz;
        rz.setZero();
        for (std::size_t c = 0; c < n; ++c)
          {
            x[c] += alpha * p[c];
            residual[c] -= alpha * ap[c];
            rz += (residual[c] * residual[c] * inverse_diagonal[c]).cast<double>();
          }
      }
    return x;
  }

  void
  CellTrialFields::improve(const unsigned steps)
  {
    {
      const std::vector<SingleValues> du = descend(potential_residual(), false, steps);
      for (std::size_t c = 0; c < u.size(); ++c)
        u[c] += du[c].cast<double>();
    }
    const std::vector<SingleValues> z   = descend(circulation_residual(), true, steps);
    const auto                      add = [](Values &flux, const SingleValues &plus, const SingleValues &minus) {
      flux += plus.cast<double>() - minus.cast<double>();
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

  namespace
  {
    // Sums of one row of pixels, added to those of the map: round-off grows with the length of a row and of a column
    // only.
    struct EnergySums
    {
      using Vector = Eigen::Array4d;

      Eigen::Matrix4d primal = Eigen::Matrix4d::Zero(), gap = Eigen::Matrix4d::Zero();
      Vector          complementary = Vector::Zero(), flux_x = Vector::Zero(), flux_y = Vector::Zero(),
             magnitude_x = Vector::Zero(), magnitude_y = Vector::Zero();

      static void
      add_square(Eigen::Matrix4d &to, const Vector &v, const double weight)
      {
        to.noalias() += (weight * v).matrix() * v.matrix().transpose();
      }

      EnergySums &
      operator+=(const EnergySums &other)
      {
        primal += other.primal;
        gap += other.gap;
        complementary += other.complementary;
        flux_x += other.flux_x;
        flux_y += other.flux_y;
        magnitude_x += other.magnitude_x;
        magnitude_y += other.magnitude_y;
        return *this;
      }

      CellEnergies
      per_area(const double n) const
      {
        CellEnergies result;
        for (int a = 0; a < CellTrialFields::n_fields; ++a)
          {
            for (int b = 0; b < CellTrialFields::n_fields; ++b)
              {
                result.primal[a][b] = a < 2 || b < 2 ? primal(a, b) / n : 0.;
                result.gap[a][b]    = gap(a, b) / n;
              }
            result.complementary[a] = complementary[a] / n;
          }
        result.mean_flux      = { { flux_x[0] / n, flux_y[1] / n } };
        result.mean_magnitude = { { magnitude_x[0] / n, magnitude_y[1] / n } };
        return result;
      }
    };
  } // namespace

  CellEnergies
  CellTrialFields::energies() const
  {
    const double dx = grid.dx, dy = grid.dy, twist = (1 / (dx * dx) + 1 / (dy * dy)) / 12;
    EnergySums   sums, row;
    std::size_t  current_row = 0;
    for (std::size_t i = 0; i < cells.size(); ++i)
      {
        if (grid.coordinate(cells[i], 1) != current_row)
          {
            sums += row;
            row         = EnergySums();
            current_row = grid.coordinate(cells[i], 1);
          }
        const auto    kg = drive(i);
        const auto   &c  = corners[i];
        const Values &ql = face_values(cells[i], left), &qr = face_values(cells[i], right),
                     &qb = face_values(cells[i], bottom), &qt = face_values(cells[i], top);
        const Differences<Values> d(u[c[0]], u[c[1]], u[c[2]], u[c[3]]);
        // All fields are linear in the pixel: mean and rise of each component. The rises of k grad u are across its
        // components, those of q along them.
        const Values px = kg[0] + (d.below + d.above) * (k[i] / (2 * dx)),
                     py = kg[1] + (d.left + d.right) * (k[i] / (2 * dy));
        const Values pt = d.twist * k[i];
        const Values qx = (ql + qr) * (1 / (2 * dy)), qy = (qb + qt) * (1 / (2 * dx));
        const Values rise_x = (qr - ql) * (1 / dy), rise_y = (qt - qb) * (1 / dx);
        const double w = 1 / k[i];
        EnergySums::add_square(row.primal, px, w);
        EnergySums::add_square(row.primal, py, w);
        EnergySums::add_square(row.primal, pt, w * twist);
        EnergySums::add_square(row.gap, qx - px, w);
        EnergySums::add_square(row.gap, qy - py, w);
        EnergySums::add_square(row.gap, rise_x, w / 12);
        EnergySums::add_square(row.gap, rise_y, w / 12);
        EnergySums::add_square(row.gap, pt, w * twist);
        row.complementary += (qx * qx + qy * qy + (rise_x * rise_x + rise_y * rise_y) * (1. / 12)) * w;
        row.flux_x += qx;
        row.flux_y += qy;
        row.magnitude_x += qx.abs();
        row.magnitude_y += qy.abs();
      }
    sums += row;
    return sums.per_area(static_cast<double>(grid.size()));
  }
} // namespace tribodraw
