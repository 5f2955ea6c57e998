#ifndef tribodraw_material_cosine_interpolation_h
#define tribodraw_material_cosine_interpolation_h

namespace tribodraw
{
  /// A function of the direction of the stress, written in c = cos 2 theta (theta: angle between rolling direction
  /// and major principal stress): a0 + a1 cos 2 theta + a2 cos 4 theta through the values at 0, 45 and 90 degrees.
  struct Cosines
  {
    double k0 = 0, k1 = 0, k2 = 0; ///< k0 + k1 c + k2 c^2

    static Cosines
    through(const double f0, const double f45, const double f90)
    {
      return { f45, 0.5 * (f0 - f90), 0.5 * (f0 - 2 * f45 + f90) };
    }
    double
    value(const double c) const
    {
      return k0 + c * (k1 + c * k2);
    }
    double
    slope(const double c) const
    {
      return k1 + 2 * c * k2;
    }
    double
    curvature() const
    {
      return 2 * k2;
    }
  };

  /// Value with first and second derivative with respect to c.
  struct Jet
  {
    double v = 0, d = 0, dd = 0;

    Jet() = default;
    Jet(const double value, const double slope, const double curvature) : v(value), d(slope), dd(curvature) {}
    Jet(const Cosines &f, const double c) : v(f.value(c)), d(f.slope(c)), dd(f.curvature()) {}
    Jet
    operator+(const Jet &o) const
    {
      return { v + o.v, d + o.d, dd + o.dd };
    }
    Jet
    operator-(const Jet &o) const
    {
      return { v - o.v, d - o.d, dd - o.dd };
    }
    Jet
    operator*(const Jet &o) const
    {
      return { v * o.v, d * o.v + v * o.d, dd * o.v + 2 * d * o.d + v * o.dd };
    }
    Jet
    operator*(const double a) const
    {
      return { a * v, a * d, a * dd };
    }
    Jet
    operator/(const Jet &o) const
    {
      const double q = v / o.v, qd = (d - q * o.d) / o.v;
      return { q, qd, (dd - 2 * qd * o.d - q * o.dd) / o.v };
    }
  };
} // namespace tribodraw

#endif
