#ifndef tribodraw_material_log_strain_pack_h
#define tribodraw_material_log_strain_pack_h

#include "pack_update.h"

namespace tribodraw
{
  /// LogarithmicStrain for four points, in (m, a, b) components: exx + eyy = 1/2 ln det C, exx - eyy = 2 theta d and
  /// gamma = 2 theta y with p = (C11+C22)/2, d = (C11-C22)/2, y = C12.
  struct LogarithmicStrainPack
  {
    Pack           p, d, y;
    Pack           i_det; ///< 1/det C
    Pack           theta, theta_r, theta_rr;
    MohrStrainPack strain;
    PackMask       valid; ///< C is positive definite

    TRIBODRAW_INLINE
    LogarithmicStrainPack(const Pack &C11, const Pack &C22, const Pack &C12)
        : p(0.5 * (C11 + C22)), d(0.5 * (C11 - C22)), y(C12)
    {
      const Pack det = C11 * C22 - C12 * C12;
      valid          = p > 0. && p < 1e100 && det > 0. && det < 1e200;
      i_det          = 1. / det;
      const Pack r2 = d * d + y * y, ip = 1. / p, z = r2 * ip * ip;

      // The series of theta = atanh(sqrt z)/(2 p sqrt z) and of its derivatives, see LogarithmicStrain.
      const auto close = z < 0.02;
      Pack       f = 1. / 19, f1 = 9. / 19, f2 = 72. / 19;
      for (int k = 8; k >= 0; --k)
        {
          const double a = 1. / (2 * k + 1);
          f              = f * z + a;
          if (k >= 1)
            f1 = f1 * z + k * a;
          if (k >= 2)
            f2 = f2 * z + k * (k - 1) * a;
        }
      const Pack ip3 = ip * ip * ip;
      theta          = 0.5 * f * ip;
      theta_r        = 0.5 * f1 * ip3;
      theta_rr       = 0.5 * f2 * ip3 * ip * ip;

      if (pack::any(!close))
        {
          const Pack far_r2 = pack::select(close, p * p, r2), r = pack::sqrt(far_r2), larger = p + r;
          const Pack i_2r2 = 0.5 / far_r2;
          const Pack t     = pack::log(larger * larger * i_det) / (4. * r);
          const Pack t_r   = (0.5 * p * i_det - t) * i_2r2;
          const Pack t_rr  = (0.5 * p * i_det * i_det - 3. * t_r) * i_2r2;
          theta            = pack::select(close, theta, t);
          theta_r          = pack::select(close, theta_r, t_r);
          theta_rr         = pack::select(close, theta_rr, t_rr);
        }
      strain = { 0.5 * pack::log(det), 2. * theta * d, 2. * theta * y };
    }

    /// Stress conjugate to (C11, C22, C12) from that conjugate to the strain.
    TRIBODRAW_INLINE void
    pull_back(const MohrStress<Pack> &T, Pack &s11, Pack &s22, Pack &s12) const
    {
      // Derivatives of the energy by p, d, y.
      const Pack power = T.a * d + T.b * y;
      const Pack along = 4. * theta_r * power, mean = T.m * i_det;
      const Pack s_p = mean * p - power * i_det, s_d = 2. * theta * T.a + d * (along - mean),
                 s_y = 2. * theta * T.b + y * (along - mean);
      s11            = 0.5 * (s_p + s_d);
      s22            = 0.5 * (s_p - s_d);
      s12            = s_y;
    }

    /// d s / d (C11, C22, C12) from the tangent in the strains: (11,11), (22,22), (12,12), (11,22), (11,12), (22,12).
    TRIBODRAW_INLINE void
    pull_back(const MohrStress<Pack> &T, const SymmetricPack &K, Pack (&result)[6]) const
    {
      // Rows of the derivative of the strain by p, d, y.
      const Pack t_d = 2. * d * theta_r, t_y = 2. * y * theta_r, twice = 2. * theta;
      const Pack m_p = p * i_det, m_d = -d * i_det, m_y = -y * i_det;
      const Pack a_p = -d * i_det, a_d = twice + 2. * d * t_d, a_y = 2. * d * t_y;
      const Pack b_p = -y * i_det, b_d = 2. * y * t_d, b_y = twice + 2. * y * t_y;
      const Pack Km_p = K.mm * m_p + K.ma * a_p + K.mb * b_p, Ka_p = K.ma * m_p + K.aa * a_p + K.ab * b_p,
                 Kb_p = K.mb * m_p + K.ab * a_p + K.bb * b_p;
      const Pack Km_d = K.mm * m_d + K.ma * a_d + K.mb * b_d, Ka_d = K.ma * m_d + K.aa * a_d + K.ab * b_d,
                 Kb_d = K.mb * m_d + K.ab * a_d + K.bb * b_d;
      const Pack Km_y = K.mm * m_y + K.ma * a_y + K.mb * b_y, Ka_y = K.ma * m_y + K.aa * a_y + K.ab * b_y,
                 Kb_y = K.mb * m_y + K.ab * a_y + K.bb * b_y;
      // Second derivatives of the strain times the stress: those of m/2 ln det C, then of 2 theta q, q = a d + b y.
      const Pack s1 = T.m * i_det, s2 = 2. * T.m * i_det * i_det;
      const Pack q = 2. * (T.a * d + T.b * y), a2 = 2. * T.a, b2 = 2. * T.b;
      const Pack t_p = -0.5 * i_det, t_pp = p * i_det * i_det, t_pr = -0.5 * i_det * i_det;
      const Pack pp = s1 - s2 * p * p + q * t_pp + m_p * Km_p + a_p * Ka_p + b_p * Kb_p;
      const Pack pd = s2 * p * d + 2. * q * d * t_pr + a2 * t_p + m_p * Km_d + a_p * Ka_d + b_p * Kb_d;
      const Pack py = s2 * p * y + 2. * q * y * t_pr + b2 * t_p + m_p * Km_y + a_p * Ka_y + b_p * Kb_y;
      const Pack dd = -s1 - s2 * d * d + q * (2. * theta_r + 4. * d * d * theta_rr) + 4. * a2 * d * theta_r + m_d * Km_d
                      + a_d * Ka_d + b_d * Kb_d;
      const Pack yy = -s1 - s2 * y * y + q * (2. * theta_r + 4. * y * y * theta_rr) + 4. * b2 * y * theta_r + m_y * Km_y
                      + a_y * Ka_y + b_y * Kb_y;
      const Pack dy = -s2 * d * y + 4. * q * d * y * theta_rr + 2. * theta_r * (d * b2 + y * a2) + m_d * Km_y
                      + a_d * Ka_y + b_d * Kb_y;
      result[0] = 0.25 * (pp + dd) + 0.5 * pd;
      result[1] = 0.25 * (pp + dd) - 0.5 * pd;
      result[2] = yy;
      result[3] = 0.25 * (pp - dd);
      result[4] = 0.5 * (py + dy);
      result[5] = 0.5 * (py - dy);
    }
  };
} // namespace tribodraw

#endif
