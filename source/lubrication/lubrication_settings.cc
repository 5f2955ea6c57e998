#include <tribodraw/base/parameters.h>
#include <tribodraw/lubrication/lubrication_settings.h>

namespace tribodraw
{
  void
  LubricationSettings::read_micro_settings(Parameters &parameters)
  {
    const std::string p0 = parameters.choice(
        "Boundary layer pressure", { "solid plus lubricant", "nominal" },
        "Pressure P0 in the law of the boundary layer, tau_BL(P0). `solid plus lubricant`: P_solid/alpha + P_lub, the "
        "pressure on an asperity top; `nominal`: P_nom/alpha as printed in the paper, which makes the solid friction "
        "independent of the lubricant pressure.",
        Default{ "solid plus lubricant",
                 "equilibrium of an asperity top that carries load beside pressurised valleys" });
    boundary_layer_pressure
        = p0 == "nominal" ? BoundaryLayerPressure::nominal : BoundaryLayerPressure::solid_plus_lubricant;
    phi_p_floor = parameters.quantity(
        "Smallest pressure factor", "", Range{ 0., 1., true }.usual(1e-6, 0.1),
        "Lower limit of the eigenvalues of the pressure flow factor.",
        Default{ "1e-3", "below percolation it is zero; forces agree within 0.1 % for 1e-2 to 1e-4" });
  }

  void
  LubricationSettings::read_friction_loop(Parameters &parameters)
  {
    const bool iterated
        = parameters.choice("Friction loop", { "staggered", "iterated" },
                            "`staggered`: the sheet moves with the friction of the increment before, as in the paper. "
                            "`iterated`: film and friction are found from the increment's own pressures and velocities "
                            "while its equilibrium is sought, until they belong to it.",
                            Default{ "iterated", "friction belongs to the increment; staggered saves some 5 % of the "
                                                 "time, and with increments of 1 mm its punch force is 0.7 % smaller" })
          == "iterated";
    if (!iterated && !parameters.documentation_mode())
      {
        parameters.mark_unselected("Friction loops");
        parameters.mark_unselected("Friction tolerance");
        return;
      }
    friction_loops = static_cast<unsigned>(parameters.integer(
        "Friction loops", Range::between(1, 100),
        "`Friction loop = iterated` only: how often friction is changed in an increment at most; then the increment is "
        "accepted, and a warning at the end counts these.",
        Default{ "20", "usually two or three are needed" }));
    friction_tolerance = parameters.quantity(
        "Friction tolerance", "", Range{ 1e-8, 0.5 },
        "`Friction loop = iterated` only: the loop ends when the coefficients of the film differ from those that act by "
        "less than this, in parts of the friction force (sum of |change| times force over sum of coefficient times "
        "force).",
        Default{ "0.02", "a punch force within 0.1 %; the change from increment to increment is 10 %" });
  }

  LubricationSettings
  LubricationSettings::read(Parameters &parameters)
  {
    LubricationSettings s;
    {
      const auto scope = parameters.section("Lubricant");
      s.supply
          = parameters.choice(
                "Supply", { "film transport", "paper rule" },
                "What decides whether there is enough lubricant. `film transport`: lubricant is conserved; it moves with "
                "the sheet, is dragged along by the tool, flows under pressure, and opens the gap where it carries all "
                "load. `paper rule`: it stays where it is on the sheet, and where it does not fill the valleys "
                "(h_inp A0/A < h_avg) there is boundary friction without lubricant pressure.",
                Default{ "film transport", "conserves the lubricant; the rule of Shisode et al. (2021) does not" })
                    == "paper rule"
                ? Supply::paper_rule
                : Supply::film_transport;
      const bool needed = s.supply == Supply::paper_rule || parameters.documentation_mode();
      if (needed)
        s.thinning
            = parameters.choice("Thinning", { "yes", "no" },
                                "`Supply = paper rule` only: whether the film h_inp is divided by the area ratio A/A0 of "
                                "the sheet.",
                                Default{ "yes", "the lubricant of a stretched sheet covers more area" })
              == "yes";
      else
        parameters.mark_unselected("Thinning");
    }
    const auto scope = parameters.section("Coupling");
    s.read_micro_settings(parameters);
    const bool paper = s.supply == Supply::paper_rule;
    if (paper || parameters.documentation_mode())
      s.squeeze = parameters.choice("Squeeze term", { "neglected", "kept" },
                                    "`Supply = paper rule` only: the rate dh_avg/dt at a fixed point of the tool in the "
                                    "average Reynolds equation, taken at the end of the increment (implicit). Film "
                                    "transport always contains it, as it conserves the lubricant.",
                                    Default{ "neglected", "as in the paper" })
                  == "kept";
    else
      parameters.mark_unselected("Squeeze term");
    s.squeeze = s.squeeze || !paper;
    s.memory  = parameters.choice("Asperities", { "stay flattened", "follow the table" },
                                  "`stay flattened`: the cut height of a point of the sheet never rises. `follow the "
                                   "table`: it is looked up for the present solid pressure and strain, as in the paper, so "
                                   "that unloaded asperities stand up again.",
                                  Default{ "stay flattened", "flattening is plastic" })
               == "stay flattened";
    s.smoothing = static_cast<unsigned>(parameters.integer(
        "Smoothing passes", Range::between(0, 10),
        "Area-weighted smoothing passes over the nominal pressure, which then bounds the lubricant pressure.",
        Default{ "1", "nodal contact pressures alternate from node to node; a second pass changes nothing more" }));
    s.film_iterations = static_cast<unsigned>(parameters.integer(
        "Film iterations", Range::between(1, 100),
        "Film solutions in an increment at most (flattening and pressure in turn); 1: staggered.",
        Default{ paper ? "1" : "30", paper ? "staggered as in the paper; with asperities that stay flattened, iterating "
                                             "changed the drawing force by less than its scatter"
                                           : "the iteration ends when the pressure changes by less than 0.1 %" }));
    s.film_relaxation = parameters.quantity(
        "Film relaxation", "", Range{ 0.05, 1. },
        "Part of the new lubricant pressure that is taken over in a film solution.",
        Default{ "1", "the cut height as a state damps the film; less only makes the pressure lag" });
    s.contact_threshold = parameters.quantity(
        "Contact threshold", "MPa", Range::positive().usual(1e-4, 1),
        "Smallest nominal pressure that counts as contact.",
        Default{ "0.05 MPa", "far below any pressure in drawing, above the noise of nearly open contact" });
    s.fresh_contact_pressure
        = parameters.quantity("Fresh contact pressure", "MPa", Range::positive().usual(0.1, 100),
                              "Pressure for which nodes that are not in contact get their friction coefficient, in "
                              "case they touch in the next "
                              "increment.",
                              Default{ "3 MPa", "usual pressure under a blank holder; acts for one increment only" });
    s.smallest_travel = parameters.quantity(
        "Smallest travel", "mm", Range::non_negative().usual(0, 5),
        "Punch travel between solutions of the film; motion is averaged over it.",
        Default{ "0.2 mm", "over less, elastic slip and rebound of the sheet falsify the velocities" });
    s.min_friction = parameters.quantity(
        "Smallest friction coefficient", "", Range::between(0, 1), "Lower limit of the local friction coefficient.",
        Default{ "0.005", "full-film nodes need some friction for a definite tangent" });
    s.max_friction = parameters.quantity(
        "Largest friction coefficient", "", Range{ 0., 1., true }, "Upper limit of the local friction coefficient.",
        Default{ "0.3", "the power law of the boundary layer has no limit when a flattened node is unloaded" });
    s.read_friction_loop(parameters);
    if (s.min_friction > s.max_friction)
      parameters.problem("Smallest friction coefficient", "It is above `Largest friction coefficient`.");
    return s;
  }
} // namespace tribodraw
