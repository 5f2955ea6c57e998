#ifndef tribodraw_flow_factors_flow_factors_h
#define tribodraw_flow_factors_flow_factors_h

#include <tribodraw/base/csv.h>
#include <tribodraw/surface/height_map.h>

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tribodraw
{
  class Parameters;

  /// Pressure and shear flow factors of one gap. Tensor components in the order xx, xy, yx, yy.
  struct FlowFactors
  {
    double                cut_height       = 0; ///< s [mm] on the sheet's own height distribution
    double                h_avg            = 0; ///< mean gap [mm]
    double                contact_fraction = 0;
    std::array<double, 4> phi_p{ { 1, 0, 0, 1 } };
    std::array<double, 4> phi_s{ { 0, 0, 0, 0 } };
    double                residual   = 0; ///< relative residual of the worst linear solve
    double                flux_error = 0; ///< relative mismatch of the flux through opposite sides
    unsigned              iterations = 0;

    /// Guaranteed enclosures of both factors of the gap that is constant in each pixel (cell_bounds.h), mean over the
    /// whole map.
    bool                  bounded = false;
    std::array<double, 4> phi_p_lower{}, phi_p_upper{}, phi_s_lower{}, phi_s_upper{};

    /// Mean and standard deviation of the factors of the four quarters of the map at the same mean gap: components xx,
    /// yy.
    bool                  quartered = false;
    std::array<double, 2> phi_p_quarter_mean{}, phi_p_quarter_sd{}, phi_s_quarter_mean{}, phi_s_quarter_sd{};

    /// All numbers in a fixed order, for the exchange between ranks.
    std::vector<double> numbers() const;
    static FlowFactors  from_numbers(const double *numbers);
    static std::size_t  n_numbers();
  };

  /// Conditions at the sides of a local Reynolds cell.
  enum class CellBoundaryConditions
  {
    paper,   ///< pressures fixed on two sides, no flow through the others; mean over the central 0.8 L x 0.8 L
    periodic ///< the map is repeated in both directions; mean over the whole map, full tensors
  };

  /// How the coefficients of a face follow from the gaps of its two pixels.
  enum class CellDiscretisation
  {
    paper,   ///< harmonic mean of h^3 (Appendix A)
    mean_gap ///< cube of the mean gap
  };

  /// Settings of section `Flow factors` that belong to solved cells, whatever the model is called.
  struct CellSettings
  {
    CellBoundaryConditions boundary_conditions = CellBoundaryConditions::periodic;
    CellDiscretisation     discretisation      = CellDiscretisation::mean_gap;
    bool                   error_bounds        = false; ///< see FactorChecks
    bool                   quarter_maps        = false;
  };

  /// What a solved cell shall tell of its own accuracy.
  struct FactorChecks
  {
    bool error_bounds = false; ///< fill FlowFactors::phi_p_lower ...
    bool quarter_maps = false; ///< fill FlowFactors::phi_p_quarter_mean ...
  };

  /// Flow factors as functions of the separation for a pair of surfaces: cell problem, published fits.
  class FlowFactorModel
  {
  public:
    virtual ~FlowFactorModel() = default;
    static const char *
    kind()
    {
      return "flow factor model";
    }
    /// @param sheet rough sheet, surface 1; heights towards the tool, zero mean.
    /// @param tool heights towards the sheet, same grid, zero mean; empty z: smooth tool.
    /// @param sq_reference combined Sq [mm] of the undeformed surfaces, to which phi_s refers.
    /// @param cut_heights s [mm]; the gap is max(0, s - z - t).
    /// @param progress called with the fraction done (by one thread at a time); may be empty.
    /// Collective: every rank must call with the same arguments and gets the same result.
    virtual std::vector<FlowFactors> compute(const HeightMap &sheet, const HeightMap &tool, double sq_reference,
                                             const std::vector<double>         &cut_heights,
                                             const std::function<void(double)> &progress) const = 0;
    /// Text of everything the result depends on besides the maps, for the cache.
    virtual std::string fingerprint() const = 0;

    /// Ask for checks of the results. A model that solves cells does them and returns true; for the others there is
    /// nothing to check.
    virtual bool
    use_checks(const FactorChecks &)
    {
      return false;
    }

    /// Hand over the cell settings that stand directly in section `Flow factors`. A model that solves cells keeps them
    /// and returns true; for the others they have no effect, and the reader warns if the file gives them.
    virtual bool
    use_cell_settings(const CellSettings &)
    {
      return false;
    }
  };

  /// Read the current section (`Flow factors`): `Model`, `Boundary conditions`, `Discretisation`. The two cell settings
  /// stand in the section itself, so that they keep their place whichever model is chosen; the reader hands them to
  /// the model. Returns nullptr if the choice of the model is wrong (recorded in @p parameters).
  std::unique_ptr<FlowFactorModel> read_flow_factors(Parameters &parameters);

  /// Read `Error bounds` and `Quarter maps` of the current section and hand them to the model, which may be nullptr.
  void read_factor_checks(Parameters &parameters, FlowFactorModel *model);

  /// Read `Separations` of the current section: h_avg/Sq, returned in descending order.
  std::vector<double> read_separations(Parameters &parameters);

  /// Cut heights s [mm] at which the mean of max(0, s - z - t) is separation * sq_reference. The rough tool is part of
  /// the gap, therefore the distribution of z + t is inverted, not the sheet's own.
  std::vector<double> cut_heights_for_separations(const HeightMap &sheet, const HeightMap &tool, double sq_reference,
                                                  const std::vector<double> &separations);

  /// Table flow_factors.csv.
  CsvTable flow_factors_table(const std::vector<FlowFactors> &factors, double sq_reference);
} // namespace tribodraw

#endif
