#ifndef tribodraw_source_lubrication_film_terms_h
#define tribodraw_source_lubrication_film_terms_h

#include "film_geometry.h"

#include <tribodraw/lubrication/average_reynolds.h>

#include <Eigen/Core>

#include <array>
#include <vector>

namespace tribodraw
{
  /// The data of a node as they are integrated.
  struct FilmCoefficient
  {
    bool            has_film = false;
    double          film = 0, fluidity = 0, squeeze = 0;     ///< fluidity: 1/(12 eta)
    Eigen::Vector3d phi_p         = Eigen::Vector3d::Zero(); ///< xx, yy, xy
    Eigen::Matrix2d sq_phi_s      = Eigen::Matrix2d::Zero();
    Eigen::Vector3d mean_velocity = Eigen::Vector3d::Zero(); ///< (U1 + U2)/2 - W
    Eigen::Vector3d half_slip     = Eigen::Vector3d::Zero(); ///< (U1 - U2)/2
  };

  /// @param phi_p_floor smallest eigenvalue of PhiP.
  FilmCoefficient film_coefficient(const AverageReynolds::NodeData &node, double phi_p_floor);

  /// Integrals over a triangle, without its shape functions.
  struct FilmTerms
  {
    Eigen::Matrix2d mobility = Eigen::Matrix2d::Zero(); ///< of h^3/(12 eta) PhiP, along the axes
    Eigen::Vector2d flux     = Eigen::Vector2d::Zero(); ///< of h (mean velocity) + Sq PhiS (half slip), along the axes
    Eigen::Vector3d squeeze  = Eigen::Vector3d::Zero(); ///< of the squeeze term times each shape function
  };

  /// Coefficients vary linearly between the nodes, products are integrated exactly. A node without film takes the mean
  /// of the other nodes; at least one must have a film.
  FilmTerms film_terms(const FilmGeometry::Cell &cell, const std::vector<FilmGeometry::QuadraturePoint> &quadrature,
                       const std::array<const FilmCoefficient *, 3> &nodes);
} // namespace tribodraw

#endif
