#ifndef tribodraw_friction_table_friction_table_h
#define tribodraw_friction_table_friction_table_h

#include <tribodraw/base/csv.h>
#include <tribodraw/base/table.h>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include <array>
#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

namespace tribodraw
{
  /// Everything the macroscopic simulation knows of a sheet-tool pair: the only border between the micro and the
  /// macro world. One table for one tool zone.
  ///
  /// A sheet point carries the cut height s of its asperities (design: state, not memoryless tables). The table holds
  ///  - state curves over s: contact fraction, mean film h_avg, flow-factor tensors;
  ///  - flattening: s under normal load alone over (solid pressure, plastic strain), and the plastic strain needed
  ///    per unit descent of s over (solid pressure, plastic strain, s), times the pressure: for the Wilson-Sheu law
  ///    this product is linear in the pressure and in the shear strength k(eps), and is interpolated in these without
  ///    error. The paper's monotone look-up s(p, eps) is the integral of these and is stored too;
  ///  - boundary friction: shear strength of the boundary layer over its pressure P0, shear strength k of the sheet
  ///    over plastic strain, ploughing coefficient over (solid pressure, plastic strain).
  /// Units: mm, MPa.
  class FrictionTable
  {
  public:
    struct StateCurves
    {
      std::vector<double> cut_height;       ///< ascending [mm]
      std::vector<double> contact_fraction; ///< decreasing
      std::vector<double> h_avg;            ///< increasing [mm]
      std::vector<double> phi_p_xx, phi_p_xy, phi_p_yx, phi_p_yy;
      std::vector<double> phi_s_xx, phi_s_xy, phi_s_yx, phi_s_yy;
    };

    /// Film quantities of one sheet point.
    struct Film
    {
      double          contact_fraction;
      double          h_avg; ///< [mm]
      Eigen::Matrix2d phi_p; ///< in the axes of the blank
      Eigen::Matrix2d phi_s; ///< in the axes of the blank; positive: the sheet is the rough surface
    };

    // ---- content (public: written by the builder, checked by check()) ----
    StateCurves curves;
    Table<2>    cut_height_normal; ///< s(p, eps) under load alone [mm]; s goes to the map's top as p goes to 0
    /// p * d eps / d(-s) over (p, eps, s) [MPa/mm]; negative where the load alone still flattens, never above
    /// rigid_strain_load.
    Table<3>                strain_load_per_descent;
    Table<2>                cut_height_monotone;       ///< s(p, eps): the paper's look-up [mm]
    Table<1>                boundary_layer_shear;      ///< tau_BL over P0 [MPa]; interpolated in logarithms
    Table<1>                shear_strength;            ///< k over eps [MPa]
    Table<2>                ploughing_coefficient;     ///< ploughing shear per solid pressure over (p, eps)
    static constexpr double rigid_strain_load  = 1e15; ///< stands for infinity: strain does not flatten
    double                  sq                 = 0;    ///< reference Sq of phi_s: combined, undeformed [mm]
    double                  initial_cut_height = 0;    ///< top of the undeformed map [mm]
    nlohmann::json          provenance;                ///< parameters, surface hashes, filters, versions

    // ---- use ----
    /// Cut height after solid pressure @p p_solid and straining from @p eps_old to @p eps_new; never above @p s_old.
    /// The load acts first (on the sheet as hard as it is at eps_old), then the strain at constant load.
    double advance(double s_old, double p_solid, double eps_old, double eps_new) const;
    Film   film(double cut_height) const;
    /// Boundary friction shear stress of the solids per nominal area [MPa]:
    /// alpha min(tau_BL(p0), k(eps)) + ploughing coefficient * p_solid, with p0 the pressure in the boundary layer.
    double solid_shear(double cut_height, double p_solid, double p0, double eps) const;
    /// Largest solid pressure [MPa], plastic strain and contact fraction for which the table was made.
    double
    max_pressure() const
    {
      return strain_load_per_descent.axes()[0].points.back();
    }
    double
    max_strain() const
    {
      return strain_load_per_descent.axes()[1].points.back();
    }
    double
    max_contact_fraction() const
    {
      return curves.contact_fraction.front();
    }
    /// Look-ups above the end of an axis so far; they took the value at the end. Pressures below the first point are
    /// inside: the limit p -> 0 is known.
    struct Beyond
    {
      unsigned long n       = 0;
      double        largest = 0; ///< that was asked for
    };
    Beyond beyond_pressures() const; ///< [MPa]
    Beyond beyond_strains() const;
    /// Within both, but more flattening than at the largest pressure and strain (which a history can bring about).
    unsigned long
    n_beyond_cut_heights() const
    {
      return beyond[2].n;
    }
    /// A warning for each axis that was left: how often, how far, and what to change.
    void warn_of_look_ups_beyond() const;

    /// Throws InputError naming the first inconsistency (axis, size, sign, finiteness).
    void check(const std::string &name) const;

    /// JSON (self-describing) and CSV with the columns of the design. The JSON file, by which a kept table is found, comes
    /// last: where it stands, the other one does too.
    void                 write(const std::filesystem::path &json_file, const std::filesystem::path &csv_file) const;
    static FrictionTable read(const std::filesystem::path &json_file);
    nlohmann::json       to_json() const;
    /// @param name of the file, for messages
    static FrictionTable from_json(const nlohmann::json &json, const std::string &name);
    /// The monotone look-up as a table of the design's columns.
    CsvTable monotone_look_up() const;

  private:
    double normal_cut_height(double p_solid, double eps) const;
    double descend(double s, double p_solid, double eps, double strain) const;

    /// Counts and the largest of the values; any thread may look up.
    struct Counter
    {
      std::atomic<unsigned long> n{ 0 };
      std::atomic<double>        largest{ 0 };

      Counter() = default;
      Counter(const Counter &other) : n(other.n.load()), largest(other.largest.load()) {}
      Counter &operator=(const Counter &other);
      void     add(double value);
    };
    mutable std::array<Counter, 3> beyond; // pressure, strain, cut height
  };
} // namespace tribodraw

#endif
