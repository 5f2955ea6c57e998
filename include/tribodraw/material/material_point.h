#ifndef tribodraw_material_material_point_h
#define tribodraw_material_material_point_h

#include <tribodraw/material/sheet_material.h>

#include <filesystem>
#include <string>
#include <vector>

namespace tribodraw
{
  /// One state of a material point on its way.
  struct PointState
  {
    double       time   = 0;               ///< [s]
    Vector3      strain = Vector3::Zero(); ///< logarithmic (xx, yy, gamma_xy), axes of the blank
    Vector3      stress = Vector3::Zero(); ///< conjugate to it (xx, yy, xy) [MPa]
    PlasticState plastic;
    double       elastic_energy = 0; ///< stored [N/mm^2]
    double       plastic_work   = 0; ///< dissipated since the start [N/mm^2]
    double       stress_power   = 0; ///< integral of stress times strain increment, trapezoidal rule [N/mm^2]
    unsigned     sub_steps      = 0; ///< see StressUpdate, sum since the start
  };

  /// What a material test prescribes, in axes turned by an angle from the rolling direction.
  enum class PointTest
  {
    uniaxial,     ///< strain along; no stress across, no shear stress
    plane_strain, ///< strain along; no strain across, no shear stress
    equibiaxial,  ///< strain along; the same stress across, no shear stress
    shear         ///< engineering shear strain; no normal stresses
  };

  /// Rows: (normal along, normal across, engineering shear) strain in axes turned by @p angle [rad] from strains in the
  /// axes of the blank. Its transpose brings stresses back (work conjugate).
  Matrix3 strain_rotation(double angle);

  /// Drive a point to the logarithmic strain @p last_strain (along, or shear) at the strain rate @p rate [1/s] in @p n
  /// increments; the first state is the undeformed one. The other components follow by Newton's method.
  /// Throws ConvergenceError if an increment does not converge even when cut into 64.
  std::vector<PointState> run_point_test(const SheetMaterial &material, PointTest test, double angle,
                                         double last_strain, double rate, unsigned n);

  struct PrescribedStrain
  {
    double      time;
    Vector3     strain; ///< (xx, yy, gamma_xy)
    std::string place;  ///< for messages
  };
  /// Read `time_s,eps_xx,eps_yy,eps_xy` (logarithmic, tensor component of the shear): times rising from above 0, or
  /// from 0 with no strain. At most 100000 rows. Throws InputError naming the line.
  std::vector<PrescribedStrain> read_strain_path(const std::filesystem::path &file);
  std::vector<PointState> follow_strain_path(const SheetMaterial &material, const std::vector<PrescribedStrain> &path);
} // namespace tribodraw

#endif
