#ifndef tribodraw_friction_table_scatter_h
#define tribodraw_friction_table_scatter_h

#include <tribodraw/base/csv.h>
#include <tribodraw/friction_table/friction_table.h>

#include <vector>

namespace tribodraw
{
  /// The table of a sheet of which several maps were measured (same tool, same models): the mean of their tables. States
  /// are matched by contact fraction, on which load and straining depend, because the top pixel differs from map to map;
  /// cut heights, films and flow factors of one contact fraction are averaged (Sq PhiS, not PhiS alone). Axes are the
  /// union of the axes of all tables within their common range.
  /// Throws InputError if there is no table or the tables have no range in common.
  FrictionTable mean_friction_table(const std::vector<FrictionTable> &tables);

  /// Mean and standard deviation over the tables at every point (p, eps) of the union of their axes:
  /// `p_solid_mpa,eps_p` and `<quantity>_mean,<quantity>_sd,<quantity>_min,<quantity>_max` for contact_fraction, h_avg_um,
  /// tau_solid_mpa, mu_boundary, phi_p_xx, phi_p_yy, phi_s_xx, phi_s_yy.
  CsvTable friction_table_scatter(const std::vector<FrictionTable> &tables);
} // namespace tribodraw

#endif
