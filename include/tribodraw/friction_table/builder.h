#ifndef tribodraw_friction_table_builder_h
#define tribodraw_friction_table_builder_h

#include <tribodraw/boundary_friction/boundary_friction.h>
#include <tribodraw/flattening/flattening.h>
#include <tribodraw/flow_factors/flow_factors.h>
#include <tribodraw/friction_table/friction_table.h>
#include <tribodraw/material/hardening_law.h>
#include <tribodraw/surface/height_map.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tribodraw
{
  class Parameters;
  class SheetMaterial;

  /// Resolution of a friction table: section `Friction table`.
  struct FrictionTableAxes
  {
    std::vector<double> pressures;          ///< solid pressure, ascending, > 0 [MPa]
    std::vector<double> strains;            ///< equivalent plastic strain, ascending from 0
    unsigned int        n_cut_heights  = 0; ///< separations at which flow factors are computed
    unsigned int        n_curve_points = 0; ///< points of the state curves over the cut height
    /// Points are added halfway (pressures: geometrically) until linear interpolation is nearer than this to the
    /// model, in contact fraction, mean film over Sq and flow factors; 1: no points are added.
    double       interpolation_error = 1;
    unsigned int max_points          = 40; ///< of pressures and of strains

    static FrictionTableAxes read(Parameters &parameters);
  };

  /// A sheet-tool pair and the models that describe it.
  struct PairDescription
  {
    HeightMap                              sheet; ///< zero mean
    HeightMap                              tool;  ///< same grid, zero mean, heights towards the sheet; empty: smooth
    std::optional<Flattening>              flattening;
    std::shared_ptr<const HardeningLaw>    hardening;
    BoundaryFriction                       boundary_friction;
    std::shared_ptr<const FlowFactorModel> flow_factors;
    FrictionTableAxes                      axes;
  };

  /// Compute the friction table of a pair. Collective: every rank must call and gets the same table.
  ///
  /// Contact fraction: plateaus of the sheet, the area that carries and shears. Film h_avg and flow factors: of the gap
  /// max(0, s - z - t), so that both count a rough tool in the same way; with a smooth tool h_avg is the mean gap of
  /// the volume-conserving flattening exactly.
  /// @param progress called with the fraction done; may be empty.
  FrictionTable build_friction_table(const PairDescription &pair, const std::function<void(double)> &progress = {});

  /// Reads all sections that describe a sheet-tool pair and keeps tables in a folder, under a hash of everything they
  /// depend on.
  class FrictionTableBuilder
  {
  public:
    /// Reads `Sheet surface`, `Tool surface` (or `Tool surface/<zone>` if the file gives zones), `Flattening`, `Flow
    /// factors`, `Boundary friction`, `Friction table`, `Sheet material`; all at the top level. No work is done.
    /// @param zone `Punch`, `Die`, `Blank holder`; empty: one tool surface only.
    static FrictionTableBuilder read(Parameters &parameters, const std::string &zone = "");

    /// The zone if the file gives it a tool surface of its own. Builders of one file for which this is equal make the
    /// same table.
    const std::string &
    tool_surface_zone() const
    {
      return own_zone;
    }
    /// Hash of everything the table depends on: maps and settings. Makes the maps.
    std::string   fingerprint();
    FrictionTable build(const std::function<void(double)> &progress = {});
    /// The table from @p folder if a table of this fingerprint is there, otherwise built and kept there as
    /// `friction_table_<hash>.json` and `.csv`. Collective.
    FrictionTable load_or_build(const std::filesystem::path &folder, const std::function<void(double)> &progress = {});
    std::filesystem::path cached_file(const std::filesystem::path &folder);
    /// True if the last load_or_build() found its table.
    bool
    was_cached() const
    {
      return found;
    }

    const HeightMap &
    sheet()
    {
      return make_maps().sheet;
    }
    /// Empty (nx = 0) for a smooth tool.
    const HeightMap &
    tool()
    {
      return make_maps().tool;
    }

  private:
    const PairDescription &make_maps();

    std::string                          zone, own_zone;
    std::function<HeightMap()>           make_sheet, make_tool;
    std::shared_ptr<const SheetMaterial> material;
    PairDescription                      pair;
    std::string                          settings; // effective entries of the sections the table depends on
    std::string                          surface_settings;
    bool                                 have_maps = false, found = false;
  };
} // namespace tribodraw

#endif
