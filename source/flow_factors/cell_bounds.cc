#include <tribodraw/flow_factors/cell_bounds.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tribodraw
{
  namespace
  {
    // Steps of conjugate gradients on the trial fields. The start is accurate but for the scale of a pixel: after three
    // steps the intervals are within 5 % of their final width (Gaussian maps, correlation length 4 and 8 pixels).
    constexpr unsigned n_improvements = 3;

    CellTrialFields
    make_fields(const CellGrid &grid, const CellGap &gap, const int driven_axis, std::array<bool, 2> &conducts)
    {
      const CellConnectivity connectivity(grid, gap);
      for (const int axis : { 0, 1 })
        conducts[axis] = connectivity.conducts(axis);
      return CellTrialFields(grid, gap, connectivity.conducting_regions(driven_axis), driven_axis);
    }
  } // namespace

  CellBounds
  bounds_from_energies(const CellEnergies &energies, const std::size_t longest_sum)
  {
    // A sum of m positive terms has a relative round-off below m eps, each term below 20 eps. Of a mixed sum it is
    // relative to the sum of magnitudes, which Cauchy's inequality limits by the diagonal.
    const double eps = std::numeric_limits<double>::epsilon(), error = (static_cast<double>(longest_sum) + 100) * eps;
    const auto   root_gap = [&](const int a) {
      // the field that the gap measures is the difference of two rounded fields
      const double rounding
          = 20 * eps * (std::sqrt(energies.complementary[a]) + (a < 2 ? std::sqrt(energies.primal[a][a]) : 0.));
      return (std::sqrt(energies.gap[a][a]) + rounding) * (1 + error);
    };
    CellBounds result;
    for (int i = 0; i < 2; ++i)
      {
        const double primal = energies.primal[i][i], missing = root_gap(i);
        double       lower = primal * (1 - error) - missing * missing;
        if (energies.complementary[i] > 0)
          {
            const double flux = std::max(0., energies.mean_flux[i] - error * energies.mean_magnitude[i]);
            lower             = std::max(lower, flux * flux / (energies.complementary[i] * (1 + 2 * error)));
          }
        result.conductance_lower[i][i] = std::max(0., lower);
        result.conductance_upper[i][i] = primal * (1 + error);
      }
    const auto enclose = [&](const int a, const int b, const double sign, double &lower, double &upper) {
      const double reach  = 0.5 * root_gap(a) * root_gap(b);
      const double centre = sign * (energies.primal[a][b] - 0.5 * energies.gap[a][b]);
      // <|k (g_b + grad u_b)|^2 / k> is at most twice the sum of the two energies
      const double of_b      = 2 * (energies.complementary[b] + energies.gap[b][b]);
      const double round_off = error * (std::sqrt(energies.primal[a][a] * of_b) + root_gap(a) * root_gap(b));
      lower                  = centre - reach - round_off;
      upper                  = centre + reach + round_off;
    };
    enclose(0, 1, 1, result.conductance_lower[0][1], result.conductance_upper[0][1]);
    result.conductance_lower[1][0] = result.conductance_lower[0][1];
    result.conductance_upper[1][0] = result.conductance_upper[0][1];
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        enclose(CellTrialFields::pressure_field(i), CellTrialFields::shear_field(j), -1, result.carried_lower[i][j],
                result.carried_upper[i][j]);
    return result;
  }

  CellBounding::CellBounding(const CellGrid &grid_in, const CellGap &gap_in, const int driven_axis_in)
      : grid(grid_in), gap(gap_in), driven_axis(driven_axis_in), fields(make_fields(grid, gap, driven_axis, conducts))
  {
  }

  void
  CellBounding::add_pressure_flow(const int axis, const std::vector<double> &pressure,
                                  const std::array<std::vector<double>, 2> &upper_flux)
  {
    if (conducts[axis])
      fields.start(CellTrialFields::pressure_field(axis), pressure, upper_flux);
  }

  void
  CellBounding::add_shear_flow(const int axis, const std::vector<double> &pressure,
                               const std::array<std::vector<double>, 2> &upper_flux)
  {
    if (conducts[0] || conducts[1])
      fields.start(CellTrialFields::shear_field(axis), pressure, upper_flux);
  }

  void
  CellBounding::finish(FlowFactors &result, const double sq_reference)
  {
    CellBounds bounds;
    if (conducts[0] || conducts[1])
      {
        fields.improve(n_improvements);
        fields.balance();
        bounds = bounds_from_energies(fields.energies(), grid.nx + grid.ny);
      }
    const double scale = sq_reference > 0 ? gap.mean_gap / sq_reference : 0.;
    const double rest  = sq_reference > 0 ? gap.mean_carried / sq_reference : 0.;
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        {
          if (!grid.periodic && (i != j || i != driven_axis))
            continue;
          // no way along i: e_i + grad chi_i = 0 wherever there is a film, so the rows of K and B vanish
          const bool        open = conducts[i], both = conducts[i] && conducts[j];
          const double      carried = i == j ? rest : 0.;
          const std::size_t index   = static_cast<std::size_t>(2 * i + j);
          result.phi_p_lower[index] = both ? bounds.conductance_lower[i][j] : 0.;
          result.phi_p_upper[index] = both ? bounds.conductance_upper[i][j] : 0.;
          result.phi_s_lower[index] = carried - (open ? scale * bounds.carried_upper[i][j] : 0.);
          result.phi_s_upper[index] = carried - (open ? scale * bounds.carried_lower[i][j] : 0.);
        }
    result.bounded = true;
  }
} // namespace tribodraw
