#ifndef tribodraw_output_figures_h
#define tribodraw_output_figures_h

#include <tribodraw/output/plot.h>

#include <filesystem>

namespace tribodraw
{
  /// Figures of an output folder, drawn from the files in it, so that they can be drawn again at any time
  /// (`tribodraw report DIR`), also for a run that is still going on. What a file does not hold is skipped.
  namespace figures
  {
    /// All that the files allow. Throws InputError if a file cannot be understood.
    void draw_all(const std::filesystem::path &folder);

    /// surface.gsf, height_distribution.csv, abbott_curve.csv, closed_voids.csv -> surface_map, height_distribution,
    /// abbott_curve, closed_voids.
    void draw_surface(const std::filesystem::path &folder);
    /// flow_factors.csv -> phi_p, phi_s.
    void draw_flow_factors(const std::filesystem::path &folder);
    /// friction_table.csv -> table_contact_fraction, table_film_thickness, table_solid_shear,
    /// table_friction_coefficient, table_phi_p, table_phi_s, each over solid pressure for several plastic strains;
    /// scatter.csv -> scatter_contact_fraction, scatter_film_thickness, scatter_friction_coefficient.
    void draw_friction_table(const std::filesystem::path &folder);

    /// strip_profile.csv, sweep_<quantity>.csv -> strip_pressure, strip_gap, sweep_<quantity>, sweep_<quantity>_share.
    void draw_strip(const std::filesystem::path &folder);

    /// history.csv of a forming run -> force_travel, draw_in, mean_friction, peak_lubricant_pressure.
    void draw_history(const std::filesystem::path &folder);
    /// nodes_final.csv (`node,x_mm,y_mm,z_mm,x0_mm,y0_mm` and fields) and elements_final.csv (`element,n1,n2,n3` and
    /// fields; nodes counted from 0) -> a map of each known field on the undeformed blank, `<field>_blank`, and of some
    /// on the deformed sheet seen from above, `<field>`. If the mesh does not move only the latter.
    void draw_maps(const std::filesystem::path &folder);
    /// elements_final.csv with `major_strain,minor_strain`, flc.csv (`minor_strain,major_strain`) -> fld.
    void draw_forming_limits(const std::filesystem::path &folder);
    /// nodes_final.csv and elements_final.csv -> outline (of the part and the blank), thinning_cuts (along x, y and the
    /// diagonal of the blank).
    void draw_cuts(const std::filesystem::path &folder);
    /// A field that is linear on each triangle along the line through the origin in the direction of the unit vector
    /// @p direction, over the distance from the origin (negative on the other side).
    plot::Series values_along(const plot::PlanMesh &mesh, const std::vector<double> &values,
                              const std::array<double, 2> &direction);
    /// The drawings above: history, maps, forming limits, cuts.
    void draw_forming(const std::filesystem::path &folder);
  } // namespace figures
} // namespace tribodraw

#endif
