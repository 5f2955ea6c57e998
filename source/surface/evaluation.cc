#include <tribodraw/base/parameters.h>
#include <tribodraw/base/units.h>
#include <tribodraw/surface/autocorrelation.h>
#include <tribodraw/surface/evaluation.h>
#include <tribodraw/surface/material_ratio.h>
#include <tribodraw/surface/slopes.h>

#include <algorithm>
#include <limits>

namespace tribodraw
{
  namespace
  {
    constexpr double um = 1e-3; // in mm

    class Table
    {
    public:
      explicit Table(Evaluation &e) : evaluation(e) {}

      void
      plain(const std::string &name, double value, const std::string &unit = "1")
      {
        evaluation.rows.push_back({ name, value, unit });
      }
      void
      length(const std::string &name, double mm)
      {
        plain(name, mm / um, "um");
      }
      void
      volume(const std::string &name, double mm)
      {
        plain(name, mm / um, "um^3/um^2");
      }
      void
      share(const std::string &name, double value)
      {
        plain(name, 100. * value, "%");
      }
      void
      note(const std::string &text)
      {
        evaluation.notes.push_back(text);
      }

    private:
      Evaluation &evaluation;
    };

    void
    add_heights(Table &table, const HeightMap &map)
    {
      table.plain("pixels_x", static_cast<double>(map.nx));
      table.plain("pixels_y", static_cast<double>(map.ny));
      table.length("pixel_size_x", map.dx);
      table.length("pixel_size_y", map.dy);
      const Roughness r = roughness(map);
      table.length("Sa", r.sa);
      table.length("Sq", r.sq);
      table.plain("Ssk", r.ssk);
      table.plain("Sku", r.sku);
      table.length("Sp", r.sp);
      table.length("Sv", r.sv);
      table.length("Sz", r.sz);
    }

    void
    add_spatial(Table &table, const HeightMap &map)
    {
      const SpatialParameters s        = spatial_parameters(map);
      const auto              optional = [&](const std::string &name, const std::optional<double> &value) {
        if (value)
          table.length(name, *value);
        else
          table.note(name
                                  + " does not exist: the autocorrelation function does not fall far enough within half the map");
      };
      optional("autocorrelation_length_x", s.length_x);
      optional("autocorrelation_length_y", s.length_y);
      optional("half_autocorrelation_length_x", s.half_length_x);
      optional("half_autocorrelation_length_y", s.half_length_y);
      if (s.peklenik)
        table.plain("peklenik_gamma", *s.peklenik);
      optional("Sal", s.sal);
      if (s.str)
        table.plain("Str", *s.str);
      else
        table.note(
            "Str does not exist: the autocorrelation function does not fall to 0.2 in all directions within half "
            "the map");
      table.plain("Std", s.std_angle, "deg");
    }

    void
    add_slopes(Table &table, const HeightMap &map)
    {
      if (map.nx < 7 || map.ny < 7)
        return table.note("Sdq, Sdr and the spectral moments do not exist: they need 7 x 7 pixels");
      const SlopeParameters s = slope_parameters(map);
      table.plain("Sdq", s.sdq);
      table.share("Sdr", s.sdr);
      table.plain("m0", s.m0 / (um * um), "um^2");
      table.plain("m2", s.m2());
      table.plain("m2_x", s.m2_x);
      table.plain("m2_y", s.m2_y);
      table.plain("m4", s.m4() * um * um, "1/um^2");
      table.plain("m4_x", s.m4_x * um * um, "1/um^2");
      table.plain("m4_y", s.m4_y * um * um, "1/um^2");
    }

    void
    add_functional(Table &table, const HeightMap &map, const EvaluationSettings &settings)
    {
      const MaterialRatioCurve   curve(map);
      const FunctionalParameters f = curve.functional_parameters();
      table.length("Sk", f.sk);
      table.length("Spk", f.spk);
      table.length("Svk", f.svk);
      table.share("Smr1", f.smr1);
      table.share("Smr2", f.smr2);
      table.share("Smr", curve.ratio(settings.smr_height));
      table.length("Smr_height", settings.smr_height);
      table.volume("Vmp", f.vmp);
      table.volume("Vmc", f.vmc);
      table.volume("Vvc", f.vvc);
      table.volume("Vvv", f.vvv);
    }

    void
    add_voids(Table &table, const std::vector<VoidState> &states, double contact_fraction)
    {
      const VoidState s = state_at(states, contact_fraction);
      table.volume("Vcl", s.closed_volume);
      table.share("closed_void_area", s.closed_area);
      table.share("closed_void_contact_fraction", contact_fraction);
      const auto largest = std::max_element(states.begin(), states.end(), [](const VoidState &a, const VoidState &b) {
        return a.closed_area < b.closed_area;
      });
      table.share("largest_closed_void_area", largest->closed_area);
    }

    void
    add_profiles(Table &table, const HeightMap &map, const ProfileSettings &settings)
    {
      const ProfileParameters p  = profile_parameters(map, settings);
      constexpr double        cm = 10.;
      if (p.ra)
        {
          table.length("Ra", *p.ra);
          table.plain("RPc", *p.rpc * cm, "1/cm");
          table.plain("profile_cut_off", settings.cut_off, "mm");
          table.length("profile_noise_cut_off", p.noise_cut_off);
          table.length("RPc_section_height", settings.peak_height);
        }
      if (p.no_roughness)
        table.note("Ra and RPc with cut-off " + units::format(settings.cut_off, "mm") + " do not exist: the standard "
                   + *p.no_roughness + "; a shorter cut-off can be set with `Evaluation/Profile cut-off`");
      if (p.wsa)
        table.length("Wsa", *p.wsa);
      if (p.no_waviness)
        table.note("Wsa(1-5) does not exist: the standard " + *p.no_waviness);
    }
  } // namespace

  EvaluationSettings
  read_evaluation(Parameters &parameters)
  {
    const auto         scope = parameters.section("Evaluation");
    EvaluationSettings s;
    s.smr_height            = parameters.quantity("Smr height", "um", Range::any().usual(-100., 100.),
                                                  "Height c above the mean at which the material ratio Smr(c) is given.",
                                                  Default{ "0 um", "the mean plane" });
    s.void_contact_fraction = parameters.quantity(
        "Void contact fraction", "", Range::between(0.01, 0.99),
        "Share of the area above a flat counter-surface for which the closed void volume Vcl is given.",
        Default{ "0.5", "near it the voids of random surfaces cease to be connected; the whole curve is in "
                        "closed_voids.csv" });
    s.profiles.along_x
        = parameters.choice("Profile direction", { "x", "y" }, "Direction of the profiles for Ra, RPc and Wsa.",
                            Default{ "y", "across the rolling direction, where a lay of ground rolls shows most" })
          == "x";
    s.profiles.cut_off = parameters.quantity(
        "Profile cut-off", "mm", Range::positive().usual(0.025, 8.),
        "Cut-off of the roughness profile for Ra and RPc. Five cut-offs must fit into the map, and another one for the "
        "run-in of the filter unless the map is periodic; otherwise no value is given.",
        Default{ "2.5 mm", "usual for sheet according to EN 10049; smaller maps need a smaller one" });
    s.profiles.peak_height = parameters.quantity("Peak count height", "um", Range::positive().usual(0.05, 5.),
                                                 "Distance of the two section levels of RPc from the mean line.",
                                                 Default{ "0.5 um", "usual for sheet according to EN 10049" });
    return s;
  }

  double
  Evaluation::value(const std::string &parameter) const
  {
    for (const ParameterRow &row : rows)
      if (row.parameter == parameter)
        return row.value;
    return std::numeric_limits<double>::quiet_NaN();
  }

  Evaluation
  evaluate_surface(const HeightMap &map, const EvaluationSettings &settings)
  {
    Evaluation evaluation;
    Table      table(evaluation);
    add_heights(table, map);
    add_spatial(table, map);
    add_slopes(table, map);
    add_functional(table, map, settings);
    evaluation.voids = closed_voids(map);
    add_voids(table, evaluation.voids, settings.void_contact_fraction);
    add_profiles(table, map, settings.profiles);
    return evaluation;
  }
} // namespace tribodraw
