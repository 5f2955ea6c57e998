#include <tribodraw/base/errors.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/base/units.h>
#include <tribodraw/flattening/height_distribution.h>
#include <tribodraw/flow_factors/flow_factors.h>

#include <algorithm>
#include <functional>
#include <type_traits>

namespace tribodraw
{
  namespace
  {
    CellSettings
    read_cell_settings(Parameters &parameters)
    {
      CellSettings settings;
      if (parameters.choice(
              "Boundary conditions", { "paper", "periodic" },
              "Sides of the local Reynolds cell. `paper`: fixed pressures on two sides, no flow through the "
              "others, mean over the central 0.8 L x 0.8 L, diagonal components. `periodic`: the map repeats "
              "itself; full tensors.",
              Default{ "periodic", "no disturbance by walls, less scatter, full tensors from one matrix" })
          == "paper")
        settings.boundary_conditions = CellBoundaryConditions::paper;
      if (parameters.choice("Discretisation", { "paper", "mean gap" },
                            "Conductance of the face between two pixels. `paper`: harmonic mean of h^3 (Appendix A). "
                            "`mean gap`: cube of the mean h.",
                            Default{ "mean gap", "10 to 30 times smaller error at equal pixel size in contact" })
          == "paper")
        settings.discretisation = CellDiscretisation::paper;
      return settings;
    }
  } // namespace

  namespace
  {
    // Calls action(number) for every number of the result; Factors is FlowFactors or const FlowFactors.
    template <class Factors, class Action>
    void
    for_each_number(Factors &f, const Action &action)
    {
      action(f.cut_height);
      action(f.h_avg);
      action(f.contact_fraction);
      for (auto *components : { &f.phi_p, &f.phi_s, &f.phi_p_lower, &f.phi_p_upper, &f.phi_s_lower, &f.phi_s_upper })
        for (auto &component : *components)
          action(component);
      for (auto *components :
           { &f.phi_p_quarter_mean, &f.phi_p_quarter_sd, &f.phi_s_quarter_mean, &f.phi_s_quarter_sd })
        for (auto &component : *components)
          action(component);
      action(f.residual);
      action(f.flux_error);
      action(f.iterations);
      action(f.bounded);
      action(f.quartered);
    }
  } // namespace

  std::vector<double>
  FlowFactors::numbers() const
  {
    std::vector<double> result;
    for_each_number(*this, [&result](const auto &number) { result.push_back(static_cast<double>(number)); });
    return result;
  }

  FlowFactors
  FlowFactors::from_numbers(const double *numbers)
  {
    FlowFactors result;
    for_each_number(result, [&numbers](auto &number) {
      number = static_cast<std::remove_reference_t<decltype(number)>>(*numbers++);
    });
    return result;
  }

  std::size_t
  FlowFactors::n_numbers()
  {
    static const std::size_t n = FlowFactors().numbers().size();
    return n;
  }

  std::unique_ptr<FlowFactorModel>
  read_flow_factors(Parameters &parameters)
  {
    auto model
        = parameters.model<FlowFactorModel>("Model", "How pressure and shear flow factors are found.",
                                            Default{ "cell problem", "solves the surface at hand instead of a fit" });
    const CellSettings settings = read_cell_settings(parameters);
    if (model && !model->use_cell_settings(settings))
      for (const char *entry : { "Boundary conditions", "Discretisation" })
        if (parameters.has(entry))
          parameters.warning("'" + parameters.path() + "/" + entry + "' has no effect on the chosen model.");
    return model;
  }

  void
  read_factor_checks(Parameters &parameters, FlowFactorModel *model)
  {
    FactorChecks checks;
    checks.error_bounds = parameters.flag(
        "Error bounds",
        "Guaranteed lower and upper bounds of both factors of the gap that is constant in each pixel, from energies of "
        "admissible fields, as further columns.",
        Default{ "true",
                 "takes half of the time of the solution or less; for maps beyond some ten million pixels, of which "
                 "it needs 250 bytes each, set it to false" });
    checks.quarter_maps = parameters.flag(
        "Quarter maps",
        "Mean and standard deviation of the factors of the four quarters of the map at the same mean gap, as further "
        "columns: shows how representative the map is. A quarter is solved with fixed pressures on two sides and no "
        "flow "
        "through the others, as it is not periodic.",
        Default{ "false", "takes about as long again as the map itself" });
    if (model && !model->use_checks(checks))
      for (const char *entry : { "Error bounds", "Quarter maps" })
        if (parameters.has(entry))
          parameters.warning("'" + parameters.path() + "/" + entry + "' has no effect on the chosen model.");
  }

  std::vector<double>
  read_separations(Parameters &parameters)
  {
    std::vector<double> separations = parameters.quantity_list(
        "Separations", "", Range::positive().usual(0.01, 20), "Mean gaps h_avg as multiples of the reference Sq.",
        Default{ "3, 2.5, 2, 1.75, 1.5, 1.25, 1, 0.85, 0.7, 0.6, 0.5, 0.4, 0.3",
                 "from first contact to below the percolation of a Gaussian surface (0.4)" });
    std::sort(separations.begin(), separations.end(), std::greater<>());
    const auto twice = std::adjacent_find(separations.begin(), separations.end());
    if (twice != separations.end())
      parameters.problem("Separations", "the value " + units::number(*twice) + " is given twice", "different values");
    return separations;
  }

  std::vector<double>
  cut_heights_for_separations(const HeightMap &sheet, const HeightMap &tool, const double sq_reference,
                              const std::vector<double> &separations)
  {
    HeightMap sum = sheet;
    for (std::size_t i = 0; i < tool.z.size(); ++i)
      sum.z[i] += tool.z[i];
    const HeightDistribution distribution(sum);
    std::vector<double>      cut_heights;
    for (const double separation : separations)
      cut_heights.push_back(distribution.cut_height_for_mean_gap(separation * sq_reference));
    return cut_heights;
  }

  CsvTable
  flow_factors_table(const std::vector<FlowFactors> &factors, const double sq_reference)
  {
    // Every row has the same columns: bounds and quarters are there if the first row has them.
    const bool bounded = !factors.empty() && factors[0].bounded, quartered = !factors.empty() && factors[0].quartered;
    std::vector<std::string> columns{ "cut_height_um", "h_avg_um", "h_avg_over_sq", "contact_fraction", "phi_p_xx",
                                      "phi_p_xy",      "phi_p_yx", "phi_p_yy",      "phi_s_xx",         "phi_s_xy",
                                      "phi_s_yx",      "phi_s_yy", "residual",      "flux_error",       "iterations" };
    if (bounded)
      for (const char *factor : { "phi_p", "phi_s" })
        for (const char *component : { "_xx", "_xy", "_yx", "_yy" })
          for (const char *end : { "_lower", "_upper" })
            columns.push_back(std::string(factor) + component + end);
    if (quartered)
      for (const char *factor : { "phi_p", "phi_s" })
        for (const char *component : { "_xx", "_yy" })
          for (const char *what : { "_quarter_mean", "_quarter_sd" })
            columns.push_back(std::string(factor) + component + what);
    CsvTable     table(columns);
    const double um = units::factor("um");
    for (const FlowFactors &f : factors)
      {
        std::vector<CsvTable::Cell> row{ f.cut_height / um, f.h_avg / um,
                                         sq_reference > 0 ? f.h_avg / sq_reference : 0., f.contact_fraction };
        row.insert(row.end(), f.phi_p.begin(), f.phi_p.end());
        row.insert(row.end(), f.phi_s.begin(), f.phi_s.end());
        row.insert(row.end(), { f.residual, f.flux_error, static_cast<long>(f.iterations) });
        const auto add_pairs = [&row](const auto &first, const auto &second) {
          for (std::size_t k = 0; k < first.size(); ++k)
            row.insert(row.end(), { first[k], second[k] });
        };
        if (bounded)
          {
            add_pairs(f.phi_p_lower, f.phi_p_upper);
            add_pairs(f.phi_s_lower, f.phi_s_upper);
          }
        if (quartered)
          {
            add_pairs(f.phi_p_quarter_mean, f.phi_p_quarter_sd);
            add_pairs(f.phi_s_quarter_mean, f.phi_s_quarter_sd);
          }
        table.add_row(std::move(row));
      }
    return table;
  }
} // namespace tribodraw
