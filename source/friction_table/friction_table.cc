#include <tribodraw/base/log.h>
#include <tribodraw/base/units.h>
#include <tribodraw/friction_table/friction_table.h>

#include <algorithm>
#include <cmath>

namespace tribodraw
{
  namespace
  {
    /// Interval of an ascending list and the weight of its upper point, clamped.
    struct Place
    {
      std::size_t cell;
      double      weight;
    };

    Place
    locate(const std::vector<double> &points, const double x)
    {
      if (points.size() < 2 || !(x > points.front()))
        return { 0, 0. };
      if (x >= points.back())
        return { points.size() - 2, 1. };
      const auto i = static_cast<std::size_t>(std::upper_bound(points.begin(), points.end(), x) - points.begin()) - 1;
      return { i, (x - points[i]) / (points[i + 1] - points[i]) };
    }

    double
    interpolate(const std::vector<double> &values, const Place &at)
    {
      return at.weight == 0. ? values[at.cell] : values[at.cell] + at.weight * (values[at.cell + 1] - values[at.cell]);
    }

    /// Largest strain that advance() takes in one step with one hardness. The hardness of annealed steel changes by a
    /// few per cent over it; taken in the middle of the step, the error is of second order.
    constexpr double       largest_strain_step = 0.01;
    constexpr unsigned int max_strain_steps    = 200;
  } // namespace

  FrictionTable::Counter &
  FrictionTable::Counter::operator=(const Counter &other)
  {
    n       = other.n.load();
    largest = other.largest.load();
    return *this;
  }

  void
  FrictionTable::Counter::add(const double value)
  {
    ++n;
    for (double known = largest; known < value && !largest.compare_exchange_weak(known, value);)
      ;
  }

  FrictionTable::Beyond
  FrictionTable::beyond_pressures() const
  {
    return { beyond[0].n, beyond[0].largest };
  }

  FrictionTable::Beyond
  FrictionTable::beyond_strains() const
  {
    return { beyond[1].n, beyond[1].largest };
  }

  void
  FrictionTable::warn_of_look_ups_beyond() const
  {
    if (const Beyond p = beyond_pressures(); p.n > 0)
      log::warning(std::to_string(p.n) + " look-ups in the friction table asked for pressures up to "
                   + units::format(p.largest, "MPa") + " and took the value of its largest, "
                   + units::format(max_pressure(), "MPa") + ". Extend 'Friction table/Pressures'.");
    if (const Beyond eps = beyond_strains(); eps.n > 0)
      log::warning(std::to_string(eps.n) + " look-ups in the friction table asked for strains up to "
                   + units::number(eps.largest) + " and took the value of its largest, " + units::number(max_strain())
                   + ". Extend 'Friction table/Strains'.");
    if (const unsigned long n = n_beyond_cut_heights(); n > 0)
      log::warning(std::to_string(n) + " look-ups in the friction table flattened the sheet to its largest contact fraction, "
                   + units::number(max_contact_fraction())
                   + ", and took the values there. If the sheet is not flat then, extend 'Friction table/Pressures' or "
                     "'Friction table/Strains'.");
  }

  double
  FrictionTable::normal_cut_height(const double p_solid, const double eps) const
  {
    const double p_min = cut_height_normal.axes()[0].points.front();
    const double s     = cut_height_normal.value({ p_solid, eps });
    return p_solid < p_min ? initial_cut_height + (s - initial_cut_height) * p_solid / p_min : s;
  }

  double
  FrictionTable::descend(double s, const double p_solid, const double eps, double strain) const
  {
    const std::vector<double> &p_points = strain_load_per_descent.axes()[0].points;
    const std::vector<double> &e_points = strain_load_per_descent.axes()[1].points;
    const std::vector<double> &s_points = strain_load_per_descent.axes()[2].points;
    if (!(s > s_points.front()))
      return s;

    // Weights of the four rows along s that surround (p, eps). Below the first pressure the straight line is continued
    // to p = 0. Between strains the weight is that of the shear strength, through which strain enters.
    const Place e = locate(e_points, eps);
    Place       p = locate(p_points, p_solid);
    if (p_solid < p_points.front() && p_points.size() > 1)
      p.weight = (p_solid - p_points[0]) / (p_points[1] - p_points[0]);
    double we = e.weight;
    if (e.weight > 0. && e.weight < 1.)
      {
        const double k0 = shear_strength.value({ e_points[e.cell] }),
                     k1 = shear_strength.value({ e_points[e.cell + 1] });
        if (std::abs(k1 - k0) > 1e-6 * k0)
          we = std::clamp((shear_strength.value({ eps }) - k0) / (k1 - k0), 0., 1.);
      }
    const std::size_t n_s = s_points.size(), n_e = e_points.size();
    const std::size_t next_p = p_points.size() > 1 ? 1 : 0, next_e = n_e > 1 ? 1 : 0;
    const auto        row = [&](const std::size_t i, const std::size_t j) {
      return strain_load_per_descent.values().data() + ((p.cell + i * next_p) * n_e + e.cell + j * next_e) * n_s;
    };
    const double *r00 = row(0, 0), *r01 = row(0, 1), *r10 = row(1, 0), *r11 = row(1, 1);
    const double  pressure = std::min(p_solid, p_points.back());
    const double  w00 = (1. - p.weight) * (1. - we) / pressure, w01 = (1. - p.weight) * we / pressure;
    const double  w10 = p.weight * (1. - we) / pressure, w11 = p.weight * we / pressure;
    const auto    rate = [&](const std::size_t j) { return w00 * r00[j] + w01 * r01[j] + w10 * r10[j] + w11 * r11[j]; };

    // Down the points of s: strain is spent linearly varying within each interval.
    Place  at         = locate(s_points, s);
    double upper_rate = rate(at.cell) + at.weight * (rate(at.cell + 1) - rate(at.cell));
    if (at.weight == 0.)
      {
        --at.cell; // s is a point of the axis: the interval below it
        upper_rate = rate(at.cell + 1);
      }
    for (std::size_t cell = at.cell + 1; cell-- > 0;)
      {
        double       length     = s - s_points[cell];
        const double lower_rate = rate(cell);
        if (upper_rate < 0)
          {
            if (lower_rate <= 0)
              {
                s          = s_points[cell]; // the load alone flattens
                upper_rate = lower_rate;
                continue;
              }
            const double free = length * upper_rate / (upper_rate - lower_rate);
            s -= free;
            length -= free;
            upper_rate = 0.;
          }
        const double low  = std::max(lower_rate, 0.);
        const double cost = 0.5 * (upper_rate + low) * length;
        if (cost >= strain)
          {
            const double root
                = std::sqrt(upper_rate * upper_rate + 2. * (low - upper_rate) * strain / std::max(length, 1e-300));
            return strain > 0 ? s - std::min(length, 2. * strain / (upper_rate + root)) : s;
          }
        strain -= cost;
        s          = s_points[cell];
        upper_rate = lower_rate;
      }
    if (p_solid <= max_pressure() && eps <= max_strain())
      beyond[2].add(0); // more strain than the axis of s reaches down
    return s;
  }

  double
  FrictionTable::advance(const double s_old, const double p_solid, const double eps_old, const double eps_new) const
  {
    if (!(p_solid > 0))
      return s_old;
    if (p_solid > max_pressure())
      beyond[0].add(p_solid);
    if (eps_new > max_strain())
      beyond[1].add(eps_new);
    double s = std::min(s_old, initial_cut_height);
    if (strain_load_per_descent.values().front() >= rigid_strain_load)
      s = std::min(s, std::max(curves.cut_height.front(), normal_cut_height(p_solid, eps_old)));
    else
      s = descend(s, p_solid, eps_old, 0.); // down to where the strain rate number is zero: the load alone
    const double strain = std::max(0., eps_new - eps_old);
    if (!(strain > 0))
      return std::min(s, s_old);
    const auto steps = static_cast<unsigned int>(
        std::clamp(std::ceil(strain / largest_strain_step), 1., static_cast<double>(max_strain_steps)));
    for (unsigned int i = 0; i < steps; ++i)
      s = descend(s, p_solid, eps_old + (i + 0.5) * strain / steps, strain / steps);
    return std::min(s, s_old);
  }

  FrictionTable::Film
  FrictionTable::film(const double cut_height) const
  {
    const Place at = locate(curves.cut_height, cut_height);
    Film        film;
    film.contact_fraction = interpolate(curves.contact_fraction, at);
    film.h_avg            = interpolate(curves.h_avg, at);
    film.phi_p << interpolate(curves.phi_p_xx, at), interpolate(curves.phi_p_xy, at), //
        interpolate(curves.phi_p_yx, at), interpolate(curves.phi_p_yy, at);
    film.phi_s << interpolate(curves.phi_s_xx, at), interpolate(curves.phi_s_xy, at), //
        interpolate(curves.phi_s_yx, at), interpolate(curves.phi_s_yy, at);
    return film;
  }

  double
  FrictionTable::solid_shear(const double cut_height, const double p_solid, const double p0, const double eps) const
  {
    if (!(p_solid > 0))
      return 0.;
    double layer = 0.;
    if (p0 > 0)
      {
        // A power law is a straight line in logarithms, also beyond the first and the last point.
        const std::vector<double> &p = boundary_layer_shear.axes()[0].points, &tau = boundary_layer_shear.values();
        const std::size_t          i = locate(p, p0).cell;
        if (tau[i] > 0)
          layer = tau[i] * std::pow(p0 / p[i], std::log(tau[i + 1] / tau[i]) / std::log(p[i + 1] / p[i]));
        layer = std::min(layer, shear_strength.value({ eps }));
      }
    const double alpha = interpolate(curves.contact_fraction, locate(curves.cut_height, cut_height));
    return alpha * layer + ploughing_coefficient.value({ p_solid, eps }) * p_solid;
  }
} // namespace tribodraw
