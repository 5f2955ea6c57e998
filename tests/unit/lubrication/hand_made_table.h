#ifndef tests_lubrication_hand_made_table_h
#define tests_lubrication_hand_made_table_h

#include <tribodraw/fluid/viscosity_law.h>
#include <tribodraw/friction_table/friction_table.h>

#include <cmath>
#include <memory>

namespace tribodraw::test
{
  constexpr double eta = 3.2e-8; // 32 mPa s in MPa s

  class ConstantOil : public ViscosityLaw
  {
  public:
    Value
    viscosity(double, double) const override
    {
      return { eta, 0. };
    }
  };

  // A table by hand. Under load alone s = 2.4, 2.0, 1.5, 0.8 um at 0.1, 1, 10, 100 MPa (linear in log p).
  inline std::shared_ptr<FrictionTable>
  hand_made_table()
  {
    auto  t             = std::make_shared<FrictionTable>();
    auto &c             = t->curves;
    c.cut_height        = { 0.5e-3, 0.8e-3, 1.5e-3, 2.0e-3, 2.5e-3 };
    c.contact_fraction  = { 0.6, 0.5, 0.25, 0.05, 0. };
    c.h_avg             = { 0.8e-3, 1.0e-3, 1.6e-3, 2.02e-3, 2.5e-3 };
    c.phi_p_xx          = { 0.05, 0.1, 0.4, 0.7, 0.9 };
    c.phi_p_yy          = { 0.03, 0.08, 0.3, 0.6, 0.85 };
    c.phi_p_xy          = { 0., 0., 0., 0., 0. };
    c.phi_p_yx          = c.phi_p_xy;
    c.phi_s_xx          = { 0.3, 0.4, 0.6, 0.5, 0.4 };
    c.phi_s_yy          = c.phi_s_xx;
    c.phi_s_xy          = c.phi_p_xy;
    c.phi_s_yx          = c.phi_p_xy;
    const Axis pressure = { { 0.1, 1, 10, 100 }, AxisScale::logarithmic }, strain = { { 0, 1 }, AxisScale::linear };
    t->cut_height_normal
        = Table<2>({ pressure, strain }, { 2.4e-3, 2.4e-3, 2.0e-3, 2.0e-3, 1.5e-3, 1.5e-3, 0.8e-3, 0.8e-3 });
    t->cut_height_monotone = t->cut_height_normal;
    // p d eps/d(-s) = 1000/mm (p_n(s) - p), p_n(s) the pressure under which the load alone leads to s: as the table of
    // the Wilson-Sheu law, linear in p and zero on the curve above.
    const double        p_n[] = { 200, 100, 10, 1, 0 };
    std::vector<double> descent;
    for (const double p : pressure.points)
      for (int e = 0; e < 2; ++e)
        for (const double limit : p_n)
          descent.push_back(1e3 * (limit - p));
    t->strain_load_per_descent = Table<3>({ pressure, strain, Axis{ c.cut_height, AxisScale::linear } }, descent);
    t->boundary_layer_shear
        = Table<1>({ Axis{ { 1, 1000 }, AxisScale::logarithmic } }, { 0.35418, 0.35418 * std::pow(1000., 0.75) });
    t->shear_strength        = Table<1>({ strain }, { 150, 150 });
    t->ploughing_coefficient = Table<2>({ pressure, strain }, std::vector<double>(8, 0.02));
    t->sq                    = 1.6e-3;
    t->initial_cut_height    = 2.5e-3;
    t->check("hand made");
    return t;
  }
} // namespace tribodraw::test

#endif
