#ifndef tribodraw_material_point_batch_h
#define tribodraw_material_point_batch_h

#include <tribodraw/material/sheet_material.h>

#include <array>

namespace tribodraw
{
  /// Material points that are driven by the right Cauchy-Green tensor of the surface and evaluated together: all points
  /// of an element. Stored component by component, because the points are computed several at a time in vector
  /// registers; a point costs a fraction of what evaluate_in_cauchy_green() costs, with the same result.
  struct PointBatch
  {
    /// Points that are computed together; batches are filled up to a multiple of it.
    static constexpr unsigned lanes = 4;
    /// Most points in a batch: 3 in-plane times 11 thickness points.
    static constexpr unsigned capacity = 36;

    struct alignas(32) Row : std::array<double, capacity>
    {
    };

    unsigned n = 0; ///< points in use, in

    unsigned slow      = 0; ///< points of the last evaluation that the vectorised iteration left to the slow way
    unsigned sub_steps = 0; ///< sum of StressUpdate::sub_steps of these

    std::array<Row, 3> C; ///< in: C11, C22, C12

    std::array<Row, 3> stress; ///< s = dW/dC_v with C_v = (C11, C22, C12): s = (S11, S22, 2 S12)/2 [MPa]
    /// d s / d C_v, symmetric [MPa]: (11,11), (22,22), (12,12), (11,22), (11,12), (22,12). Only with options.tangent.
    std::array<Row, 6> tangent;
    std::array<Row, 3> logarithmic_stress; ///< conjugate to the logarithmic strain (xx, yy, xy) [MPa]
    Row                thickness_strain;   ///< logarithmic
    Row                elastic_energy;     ///< stored, per reference volume [N/mm^2]
    Row                plastic_work;       ///< of the increment, per reference volume [N/mm^2]
  };

  struct PointOptions
  {
    double time_increment  = 1;     ///< [s], > 0
    bool   tangent         = true;  ///< compute PointBatch::tangent
    bool   loading_tangent = false; ///< see SheetMaterial::update()
    /// Share of the elastic in the plastic tangent (far from the solution).
    double elastic_blend = 0;
  };

  /// Evaluate @p batch.n points with the history of @p old_states; @p new_states (not the same array) is overwritten.
  /// Returns false if a metric is not positive definite or a point did not converge; then the results are of no use.
  bool evaluate(const SheetMaterial &material, PointBatch &batch, const PlasticState *old_states,
                PlasticState *new_states, const PointOptions &options);
} // namespace tribodraw

#endif
