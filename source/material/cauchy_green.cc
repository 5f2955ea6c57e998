#include <tribodraw/material/sheet_material.h>

#include <cmath>

namespace tribodraw
{
  // theta(p, r) = atanh(x)/(2 p x) with x = r/p and z = x^2 = (d^2+y^2)/p^2. Its derivative with respect to p at fixed
  // r is -1/(2 det C); that with respect to r^2 follows from it, but loses digits for small z like 1e-16/z^2. Below z =
  // 0.02 the series sum z^k/(2k+1) is used; its remainder after ten terms is below 1e-17.
  LogarithmicStrain::LogarithmicStrain(const Vector3 &C)
      : p(0.5 * (C[0] + C[1])), d(0.5 * (C[0] - C[1])), y(C[2]), determinant(C[0] * C[1] - C[2] * C[2]),
        positive(p > 0 && determinant > 0 && std::isfinite(p) && std::isfinite(determinant))
  {
    if (!positive)
      {
        theta = theta_r = theta_rr = 0;
        value.setZero();
        slope.setZero();
        return;
      }
    const double r2 = d * d + y * y, z = r2 / (p * p);
    if (z < 0.02)
      {
        double f = 0, f1 = 0, f2 = 0; // Horner for the series and its derivatives with respect to z
        for (int k = 9; k >= 0; --k)
          {
            const double a = 1. / (2 * k + 1);
            f              = f * z + a;
            if (k >= 1)
              f1 = f1 * z + k * a;
            if (k >= 2)
              f2 = f2 * z + k * (k - 1) * a;
          }
        const double ip = 1 / p;
        theta           = 0.5 * f * ip;
        theta_r         = 0.5 * f1 * ip * ip * ip;
        theta_rr        = 0.5 * f2 * ip * ip * ip * ip * ip;
      }
    else
      {
        const double r = std::sqrt(r2), larger = p + r;
        theta    = std::log(larger * larger / determinant) / (4 * r);
        theta_r  = (0.5 * p / determinant - theta) / (2 * r2);
        theta_rr = (0.5 * p / (determinant * determinant) - 3 * theta_r) / (2 * r2);
      }
    const double mean = 0.25 * std::log(determinant);
    value << mean + theta * d, mean - theta * d, 2 * theta * y;

    // Columns: derivatives with respect to p, d, y.
    const double iD  = 0.5 / determinant;
    const double m_p = p * iD, m_d = -d * iD, m_y = -y * iD; // of 1/4 ln det
    const double t_p = -iD, t_d = 2 * d * theta_r, t_y = 2 * y * theta_r;
    const double a_p = d * t_p, a_d = theta + d * t_d, a_y = d * t_y; // of theta d
    const double b_p = y * t_p, b_d = y * t_d, b_y = theta + y * t_y; // of theta y
    const double s0_p = m_p + a_p, s0_d = m_d + a_d, s1_p = m_p - a_p, s1_d = m_d - a_d;
    slope << 0.5 * (s0_p + s0_d), 0.5 * (s0_p - s0_d), m_y + a_y, //
        0.5 * (s1_p + s1_d), 0.5 * (s1_p - s1_d), m_y - a_y,      //
        b_p + b_d, b_p - b_d, 2 * b_y;
  }

  Matrix3
  LogarithmicStrain::second_derivative(const Vector3 &stress) const
  {
    const double sum = stress[0] + stress[1], difference = stress[0] - stress[1], shear = 2 * stress[2];
    const double iD = 1 / determinant;
    // sum * 1/4 ln det, then theta q with q = difference d + shear y.
    const double s1 = 0.5 * sum * iD, s2 = sum * iD * iD;
    double       pp = s1 - s2 * p * p, dd = -s1 - s2 * d * d, yy = -s1 - s2 * y * y;
    double       pd = s2 * p * d, py = s2 * p * y, dy = -s2 * d * y;
    const double q   = difference * d + shear * y;
    const double t_p = -0.5 * iD, t_pp = p * iD * iD, t_pr = -0.5 * iD * iD;
    pp += q * t_pp;
    pd += 2 * q * d * t_pr + difference * t_p;
    py += 2 * q * y * t_pr + shear * t_p;
    dd += q * (2 * theta_r + 4 * d * d * theta_rr) + 4 * difference * d * theta_r;
    yy += q * (2 * theta_r + 4 * y * y * theta_rr) + 4 * shear * y * theta_r;
    dy += 4 * q * d * y * theta_rr + 2 * theta_r * (d * shear + y * difference);
    Matrix3 result;
    result(0, 0) = 0.25 * (pp + dd) + 0.5 * pd;
    result(1, 1) = 0.25 * (pp + dd) - 0.5 * pd;
    result(0, 1) = result(1, 0) = 0.25 * (pp - dd);
    result(0, 2) = result(2, 0) = 0.5 * (py + dy);
    result(1, 2) = result(2, 1) = 0.5 * (py - dy);
    result(2, 2)                = yy;
    return result;
  }

  CauchyGreenResponse
  evaluate_in_cauchy_green(const SheetMaterial &material, const Vector3 &C, const PlasticState &old_state,
                           const double time_increment, PlasticState &new_state, const bool loading_tangent)
  {
    CauchyGreenResponse     result;
    const LogarithmicStrain log_strain(C);
    result.strain = log_strain.strain();
    if (!log_strain.valid())
      {
        result.stress.setZero();
        result.tangent.setZero();
        result.update.stress.setZero();
        result.update.tangent.setZero();
        result.update.converged = false;
        new_state               = old_state;
        return result;
      }
    result.update            = material.update(result.strain, old_state, time_increment, new_state, loading_tangent);
    const Matrix3 &J         = log_strain.derivative();
    result.stress.noalias()  = J.transpose() * result.update.stress;
    result.tangent.noalias() = J.transpose() * (result.update.tangent * J);
    result.tangent += log_strain.second_derivative(result.update.stress);
    return result;
  }
} // namespace tribodraw
