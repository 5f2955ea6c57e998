#ifndef tribodraw_boundary_friction_challen_oxley_h
#define tribodraw_boundary_friction_challen_oxley_h

namespace tribodraw
{
  /// Slip-line solution for a hard wedge sliding over a rigid-plastic body (Challen and Oxley 1979).
  struct ChallenOxley
  {
    enum class Regime
    {
      wave,   ///< a plastic wave is pushed ahead; no wear
      wedge,  ///< a wedge of material sticks to the face and is removed
      cutting ///< a chip
    };
    Regime regime;
    double pressure; ///< normal to the face, over k
    double shear;    ///< along the face, against the sliding, over k: +f, or -f where a chip slides up the face

    /// Drag over load of a wedge with attack angle @p theta.
    double friction(double theta) const;
  };

  /// @param theta attack angle in [0, pi/2); @param f strength of the interface over that of the body, 0 to 1.
  /// Wave up to theta = acos(f)/2, where the friction is 1; cutting from (pi - acos f)/2, where it is 1 again; wedge
  /// between, where it rises above 1 (the jump to cutting is in the model). For f > 1/3 the wedge solution ends at
  /// sin theta = sqrt(1 - f), before cutting starts: its last pressure is held.
  ChallenOxley challen_oxley(double theta, double f);
} // namespace tribodraw

#endif
