#include "film_terms.h"

#include <algorithm>
#include <cmath>

namespace tribodraw
{
  namespace
  {
    /// Symmetric part of PhiP with eigenvalues not below the floor.
    Eigen::Matrix2d
    bounded_from_below(const Eigen::Matrix2d &phi, const double floor)
    {
      const double    mean = 0.5 * (phi(0, 0) + phi(1, 1)), half = 0.5 * (phi(0, 0) - phi(1, 1));
      const double    off    = 0.5 * (phi(0, 1) + phi(1, 0));
      const double    radius = std::hypot(half, off);
      Eigen::Matrix2d symmetric;
      symmetric << phi(0, 0), off, off, phi(1, 1);
      if (mean - radius >= floor)
        return symmetric;
      const double upper = std::max(mean + radius, floor), lower = floor;
      const double c = radius > 0 ? half / radius : 0., s = radius > 0 ? off / radius : 0.;
      const double m = 0.5 * (upper + lower), d = 0.5 * (upper - lower);
      symmetric << m + d * c, d * s, d * s, m - d * c;
      return symmetric;
    }

    /// The mean film of the nodes that have one, at the velocity of this node.
    FilmCoefficient
    filled(const FilmCoefficient &node, const std::array<const FilmCoefficient *, 3> &nodes)
    {
      FilmCoefficient mean;
      double          n  = 0;
      mean.mean_velocity = node.mean_velocity;
      mean.half_slip     = node.half_slip;
      for (const FilmCoefficient *other : nodes)
        if (other->has_film)
          {
            mean.film += other->film;
            mean.fluidity += other->fluidity;
            mean.squeeze += other->squeeze;
            mean.phi_p += other->phi_p;
            mean.sq_phi_s += other->sq_phi_s;
            ++n;
          }
      mean.film /= n;
      mean.fluidity /= n;
      mean.squeeze /= n;
      mean.phi_p /= n;
      mean.sq_phi_s /= n;
      return mean;
    }

    /// All nodes have a film.
    FilmTerms
    integrals(const FilmGeometry::Cell &cell, const std::vector<FilmGeometry::QuadraturePoint> &quadrature,
              const std::array<const FilmCoefficient *, 3> &node)
    {
      std::array<Eigen::Vector2d, 3> velocity, slip;
      for (unsigned i = 0; i < 3; ++i)
        {
          velocity[i] = cell.axes.transpose() * node[i]->mean_velocity;
          slip[i]     = cell.axes.transpose() * node[i]->half_slip;
        }
      const auto &a = *node[0], &b = *node[1], &c = *node[2];
      FilmTerms   terms;
      // Of degree 5.
      double xx = 0, yy = 0, xy = 0;
      for (const auto &[weight, N] : quadrature)
        {
          const double h = N[0] * a.film + N[1] * b.film + N[2] * c.film;
          const double f = N[0] * a.fluidity + N[1] * b.fluidity + N[2] * c.fluidity;
          const double m = weight * h * h * h * f;
          xx += m * (N[0] * a.phi_p[0] + N[1] * b.phi_p[0] + N[2] * c.phi_p[0]);
          yy += m * (N[0] * a.phi_p[1] + N[1] * b.phi_p[1] + N[2] * c.phi_p[1]);
          xy += m * (N[0] * a.phi_p[2] + N[1] * b.phi_p[2] + N[2] * c.phi_p[2]);
        }
      terms.mobility << xx, xy, xy, yy;
      terms.mobility *= cell.area;
      // Of degree 2: the integral of N_i N_j is A/12, of N_i N_i twice as much.
      const double twelfth = cell.area / 12;
      terms.flux           = (a.film + b.film + c.film) * (velocity[0] + velocity[1] + velocity[2])
                   + (a.sq_phi_s + b.sq_phi_s + c.sq_phi_s) * (slip[0] + slip[1] + slip[2]);
      for (unsigned i = 0; i < 3; ++i)
        terms.flux += node[i]->film * velocity[i] + node[i]->sq_phi_s * slip[i];
      terms.flux *= twelfth;
      const Eigen::Vector3d squeeze(a.squeeze, b.squeeze, c.squeeze);
      terms.squeeze = twelfth * (squeeze + Eigen::Vector3d::Constant(squeeze.sum()));
      return terms;
    }
  } // namespace

  FilmCoefficient
  film_coefficient(const AverageReynolds::NodeData &node, const double phi_p_floor)
  {
    FilmCoefficient c;
    c.mean_velocity = 0.5 * (node.sheet_velocity + node.tool_velocity) - node.mesh_velocity;
    c.half_slip     = 0.5 * (node.sheet_velocity - node.tool_velocity);
    c.has_film      = node.film > 0 && node.viscosity > 0;
    if (c.has_film)
      {
        const Eigen::Matrix2d phi = bounded_from_below(node.phi_p, phi_p_floor);
        c.film                    = node.film;
        c.fluidity                = 1. / (12. * node.viscosity);
        c.squeeze                 = node.squeeze;
        c.phi_p                   = { phi(0, 0), phi(1, 1), phi(0, 1) };
        c.sq_phi_s                = node.sq_phi_s;
      }
    return c;
  }

  FilmTerms
  film_terms(const FilmGeometry::Cell &cell, const std::vector<FilmGeometry::QuadraturePoint> &quadrature,
             const std::array<const FilmCoefficient *, 3> &nodes)
  {
    if (nodes[0]->has_film && nodes[1]->has_film && nodes[2]->has_film)
      return integrals(cell, quadrature, nodes);
    std::array<FilmCoefficient, 3> node;
    for (unsigned i = 0; i < 3; ++i)
      node[i] = nodes[i]->has_film ? *nodes[i] : filled(*nodes[i], nodes);
    return integrals(cell, quadrature, { &node[0], &node[1], &node[2] });
  }
} // namespace tribodraw
