#include <tribodraw/base/parameters.h>
#include <tribodraw/material/hardening_law.h>

namespace tribodraw
{
  namespace
  {
    /// Dislocation-based hardening with thermally activated rate dependence:
    /// sigma = sigma0 + dsigma_m { beta (eps+eps0) + [1 - exp(-omega (eps+eps0))]^n }
    ///         + sigma0* { 1 + (kB T/dG0) ln(rate/rate0) }^m,
    /// the last bracket not less than zero (it would become negative at very low rates, also at rate 0).
    class BergstroemVanLiempt : public HardeningLaw
    {
    public:
      explicit BergstroemVanLiempt(Parameters &parameters);
      FlowStress flow_stress(double strain, double rate) const override;
      void       flow_stress_pack(const Pack &strain, const Pack &rate, FlowStressOf<Pack> &result) const override;

    private:
      template <class Number>
      FlowStressOf<Number> compute(const Number &strain, const Number &rate) const;

      double sigma0, dsigma_m, beta, omega, n, eps0; ///< static part [MPa, -]
      double sigma_dynamic, m, rate0;                ///< dynamic part [MPa, -, 1/s]
      double thermal = 0;                            ///< kB T / dG0
    };

    BergstroemVanLiempt::BergstroemVanLiempt(Parameters &parameters)
    {
      const auto stress = Range::non_negative().usual(0., 3000.);
      sigma0
          = parameters.quantity("Initial stress", "MPa", Range::positive().usual(10., 3000.), "Static stress sigma_0.");
      dsigma_m
          = parameters.quantity("Stress increment", "MPa", stress, "Stress increment dsigma_m of strain hardening.");
      beta  = parameters.quantity("Linear hardening", "", Range::non_negative().usual(0., 10.),
                                  "beta: hardening that is linear in strain, for large strains.");
      omega = parameters.quantity("Remobilisation", "", Range::positive().usual(0.1, 100.),
                                  "Omega: remobilisation of dislocations, for small strains.");
      n = parameters.quantity("Hardening exponent", "", Range::positive().usual(0.1, 2.), "Exponent n of the bracket.");
      eps0          = parameters.quantity("Initial strain", "", Range::positive().usual(1e-6, 0.2),
                                          "eps0; must be positive, or the slope at zero strain would be infinite.");
      sigma_dynamic = parameters.quantity("Dynamic stress", "MPa", stress, "Limit sigma0* of the dynamic stress.");
      m = parameters.quantity("Dynamic exponent", "", Range{ 1. }.usual(1., 10.), "Exponent m of the dynamic stress.");
      rate0 = parameters.quantity("Limit strain rate", "1/s", Range::positive().usual(1., 1e15),
                                  "Rate of the full dynamic stress.");
      const double T
          = parameters.quantity("Temperature", "K", Range::positive().usual(200., 1500.), "Absolute temperature T.");
      const double activation_energy
          = parameters.quantity("Activation energy", "eV", Range::positive().usual(0.05, 10.),
                                "Activation energy dG0 of one event (eV, not J).");
      const double kB = parameters.quantity("Boltzmann constant", "eV/K", Range::positive().usual(8.61e-5, 8.63e-5),
                                            "Boltzmann constant, 8.617e-5 eV/K.");
      thermal         = kB * T / activation_energy;
    }

    template <class Number>
    TRIBODRAW_INLINE inline HardeningLaw::FlowStressOf<Number>
    BergstroemVanLiempt::compute(const Number &strain, const Number &rate) const
    {
      const Number e       = strain + eps0;
      const Number decay   = pack::exp(Number(-omega * e));
      const Number bracket = 1. - decay;
      const Number power   = pack::pow(bracket, n - 1);
      // At rest nothing is left of the dynamic part.
      const auto   moves   = rate > 1e-300;
      const Number dynamic = pack::select(
          moves, Number(1. + thermal * pack::log(Number(pack::select(moves, rate, Number(1.)) / rate0))), Number(0.));
      const auto   acts          = dynamic > 0.;
      const Number dynamic_power = sigma_dynamic * pack::pow(pack::select(acts, dynamic, Number(1.)), m - 1);
      const Number zero          = 0.;
      return { sigma0 + dsigma_m * (beta * e + power * bracket) + pack::select(acts, dynamic_power * dynamic, zero),
               dsigma_m * (beta + n * omega * decay * power),
               pack::select(acts, m * thermal * dynamic_power / pack::select(acts, rate, Number(1.)), zero) };
    }

    HardeningLaw::FlowStress
    BergstroemVanLiempt::flow_stress(const double strain, const double rate) const
    {
      return compute(strain, rate);
    }

    void
    BergstroemVanLiempt::flow_stress_pack(const Pack &strain, const Pack &rate, FlowStressOf<Pack> &result) const
    {
      pack::vectorised([&]() TRIBODRAW_INLINE { result = compute(strain, rate); });
    }
  } // namespace

  TRIBODRAW_REGISTER(HardeningLaw, BergstroemVanLiempt, "Bergstroem-van Liempt",
                     "Dislocation-based strain hardening with thermally activated rate dependence.",
                     "P. van Liempt, J. Mater. Process. Technol. 45 (1994) 459-464; H. Vegter et al. (2003)")
} // namespace tribodraw
