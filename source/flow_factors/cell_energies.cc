#include "corner_differences.h"

#include <tribodraw/flow_factors/cell_trial_fields.h>

namespace tribodraw
{
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
