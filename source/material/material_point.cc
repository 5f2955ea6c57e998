#include <tribodraw/material/material_point.h>

#include <Eigen/LU>

#include <array>
#include <cmath>

#include "csv_rows.h"

namespace tribodraw
{
  Matrix3
  strain_rotation(const double angle)
  {
    const double c = std::cos(angle), s = std::sin(angle);
    Matrix3      Q;
    Q << c * c, s * s, c * s, s * s, c * c, -c * s, -2 * c * s, 2 * c * s, c * c - s * s;
    return Q;
  }

  namespace
  {
    /// Go on from @p old with a stress update that succeeded.
    PointState
    next_state(const PointState &old, const double time, const Vector3 &strain, const StressUpdate &u,
               const PlasticState &plastic)
    {
      PointState next;
      next.time           = time;
      next.strain         = strain;
      next.stress         = u.stress;
      next.plastic        = plastic;
      next.elastic_energy = u.elastic_energy;
      next.plastic_work   = old.plastic_work + u.plastic_work;
      next.stress_power   = old.stress_power + 0.5 * (old.stress + u.stress).dot(strain - old.strain);
      next.sub_steps      = old.sub_steps + u.sub_steps;
      return next;
    }

    /// The three conditions of a test on local strain and stress; the first is the prescribed strain.
    struct Conditions
    {
      PointTest test;
      double    target;

      Vector3
      residual(const Vector3 &strain, const Vector3 &stress) const
      {
        switch (test)
          {
          case PointTest::uniaxial:
            return { strain[0] - target, stress[1], stress[2] };
          case PointTest::plane_strain:
            return { strain[0] - target, strain[1], stress[2] };
          case PointTest::equibiaxial:
            return { strain[0] - target, stress[1] - stress[0], stress[2] };
          case PointTest::shear:
            return { strain[2] - target, stress[0], stress[1] };
          }
        return Vector3::Zero();
      }
      Matrix3
      jacobian(const Matrix3 &T) const
      {
        Matrix3 J                              = Matrix3::Zero();
        J(0, test == PointTest::shear ? 2 : 0) = 1;
        J.row(2)                               = T.row(test == PointTest::shear ? 1 : 2);
        switch (test)
          {
          case PointTest::uniaxial:
            J.row(1) = T.row(1);
            break;
          case PointTest::plane_strain:
            J(1, 1) = 1;
            break;
          case PointTest::equibiaxial:
            J.row(1) = T.row(1) - T.row(0);
            break;
          case PointTest::shear:
            J.row(1) = T.row(0);
            break;
          }
        return J;
      }
    };

    /// One increment; false if Newton's method fails. @p guess: local strain to start from.
    bool
    solve_increment(const SheetMaterial &material, const Matrix3 &Q, const Conditions &conditions,
                    const PointState &old, const double time, Vector3 local, PointState &next)
    {
      constexpr unsigned max_iterations = 40;
      const Matrix3      Q_inverse      = Q.inverse();
      for (unsigned i = 0; i < max_iterations; ++i)
        {
          PlasticState  plastic;
          const Vector3 strain = Q_inverse * local;
          const auto    u      = material.update(strain, old.plastic, time - old.time, plastic);
          if (!u.converged)
            return false;
          const Vector3 stress   = Q_inverse.transpose() * u.stress;
          const Vector3 residual = conditions.residual(local, stress);
          // The first residual and those of strains vanish after one iteration; those of stresses are in MPa.
          if (i > 0 && residual.norm() < 1e-10 * std::max(1., stress.norm()))
            {
              next = next_state(old, time, strain, u, plastic);
              return true;
            }
          const Matrix3 J = conditions.jacobian(Q_inverse.transpose() * u.tangent * Q_inverse);
          const Vector3 d = -(J.fullPivLu().solve(residual));
          if (!d.allFinite())
            return false;
          local += d;
        }
      return false;
    }
  } // namespace

  std::vector<PointState>
  run_point_test(const SheetMaterial &material, const PointTest test, const double angle, const double last_strain,
                 const double rate, const unsigned n)
  {
    constexpr unsigned      most_parts = 64;
    const Matrix3           Q          = strain_rotation(angle);
    const unsigned          control    = test == PointTest::shear ? 2 : 0;
    std::vector<PointState> path(1);
    for (unsigned i = 1; i <= n; ++i)
      {
        const double from = last_strain * (i - 1) / n, to = last_strain * i / n;
        bool         done = false;
        for (unsigned parts = 1; parts <= most_parts && !done; parts *= 2)
          {
            PointState state = path.back(), next;
            unsigned   k     = 1;
            for (; k <= parts; ++k)
              {
                const double target = from + (to - from) * k / parts;
                // The start follows the last direction.
                Vector3 local = Q * state.strain;
                if (local[control] != 0)
                  local *= target / local[control];
                local[control] = target;
                if (!solve_increment(material, Q, { test, target }, state, std::abs(target) / rate, local, next))
                  break;
                state = next;
              }
            if ((done = k > parts))
              path.push_back(state);
          }
        if (!done)
          throw ConvergenceError(describe_error("the stress update of a material point did not converge.",
                                                "strain " + std::to_string(from) + " to " + std::to_string(to), "", "",
                                                "More increments may help."));
      }
    return path;
  }

  std::vector<PrescribedStrain>
  read_strain_path(const std::filesystem::path &file)
  {
    constexpr std::uintmax_t largest_file = 16u << 20;
    constexpr std::size_t    most_rows    = 100000;
    constexpr double         most_strain  = 3;
    const CsvData            data         = read_small_csv(file, largest_file);
    if (data.rows.empty() || data.rows.size() > most_rows)
      throw InputError(describe_error("the strain path has no rows or too many.", data.file,
                                      std::to_string(data.rows.size()), "1 to " + std::to_string(most_rows)));
    const auto time = finite_numbers(data, "time_s");
    const auto xx = finite_numbers(data, "eps_xx"), yy = finite_numbers(data, "eps_yy"),
               xy       = finite_numbers(data, "eps_xy");
    const auto complain = [&](const std::string &what, const std::size_t row, const double value) {
      throw InputError(describe_error(what, place_of_row(data.file, row), std::to_string(value)));
    };
    std::vector<PrescribedStrain> path;
    double                        last = 0;
    for (std::size_t i = 0; i < time.size(); ++i)
      {
        const Vector3 strain(xx[i], yy[i], 2 * xy[i]);
        if (strain.lpNorm<Eigen::Infinity>() > most_strain)
          complain("a logarithmic strain is larger than 3.", i, strain.lpNorm<Eigen::Infinity>());
        if (i == 0 && time[0] == 0)
          {
            if (strain.norm() != 0)
              complain("there is strain at time 0.", i, strain.norm());
            continue;
          }
        if (!(time[i] > last))
          complain("the time does not rise.", i, time[i]);
        last = time[i];
        path.push_back({ time[i], strain, data.file + ", time " + std::to_string(time[i]) + " s" });
      }
    return path;
  }

  std::vector<PointState>
  follow_strain_path(const SheetMaterial &material, const std::vector<PrescribedStrain> &prescribed)
  {
    std::vector<PointState> path(1);
    for (const PrescribedStrain &p : prescribed)
      {
        PlasticState plastic;
        const auto   u = material.update(p.strain, path.back().plastic, p.time - path.back().time, plastic);
        if (!u.converged)
          throw ConvergenceError(describe_error("the stress update of a material point did not converge.", p.place, "",
                                                "", "More rows with smaller steps may help."));
        path.push_back(next_state(path.back(), p.time, p.strain, u, plastic));
      }
    return path;
  }
} // namespace tribodraw
