#include <tribodraw/application/sheet_test.h>
#include <tribodraw/base/csv.h>
#include <tribodraw/base/log.h>
#include <tribodraw/base/parallel.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/base/units.h>
#include <tribodraw/material/material_point.h>
#include <tribodraw/output/plot.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

namespace tribodraw
{
  namespace
  {
    constexpr double pi = 3.14159265358979323846, degree = pi / 180;

    const std::map<std::string, PointTest> &
    point_tests()
    {
      static const std::map<std::string, PointTest> tests{ { "uniaxial", PointTest::uniaxial },
                                                           { "plane strain", PointTest::plane_strain },
                                                           { "equibiaxial", PointTest::equibiaxial },
                                                           { "shear", PointTest::shear } };
      return tests;
    }
    const std::string strain_path = "strain path";

    /// A load case that has been run.
    struct Curve
    {
      std::string             load_case;
      double                  angle; ///< [rad]
      std::vector<PointState> states;

      std::string
      name() const
      {
        if (load_case == strain_path || load_case == "equibiaxial")
          return load_case;
        return load_case + " " + units::number(std::round(angle / degree * 100) / 100) + "°";
      }
    };

    /// The material at one point: what tests of the sheet would measure.
    class MaterialPointTest : public SheetTest
    {
    public:
      explicit MaterialPointTest(Parameters &parameters);
      std::string describe() const override;
      void        run(const RunContext &context) override;

    private:
      void               read_cases(Parameters &parameters);
      std::vector<Curve> run_cases() const;
      void               write_curves(const std::vector<Curve> &curves, const RunContext &context) const;
      void               write_directions(CsvTable &results, const RunContext &context) const;
      void               write_locus(const std::vector<Curve> &curves, const RunContext &context) const;
      void               add_results(const Curve &curve, CsvTable &results) const;

      std::shared_ptr<const SheetMaterial> material;
      std::vector<std::string>             cases;
      std::vector<double>                  angles;
      double                               largest_strain = 0, strain_rate = 0;
      long                                 increments = 0;
      std::vector<PrescribedStrain>        path;
    };

    void
    MaterialPointTest::read_cases(Parameters &parameters)
    {
      const std::string list = parameters.text(
          "Load cases", "Tests to run, separated by commas: uniaxial, plane strain, equibiaxial, shear, strain path.");
      for (std::size_t from = 0; from < list.size();)
        {
          const std::size_t comma = std::min(list.find(',', from), list.size());
          std::string       name  = list.substr(from, comma - from);
          name.erase(0, name.find_first_not_of(" \t"));
          name.erase(name.find_last_not_of(" \t") + 1);
          from = comma + 1;
          if (point_tests().count(name) == 0 && name != strain_path)
            parameters.problem("Load cases", "there is no load case '" + name + "'",
                               "uniaxial, plane strain, equibiaxial, shear, strain path");
          else
            cases.push_back(name);
        }
    }

    MaterialPointTest::MaterialPointTest(Parameters &parameters)
    {
      {
        const auto scope = parameters.top_section("Sheet material");
        material         = std::make_shared<SheetMaterial>(SheetMaterial::read(parameters));
      }
      read_cases(parameters);
      const bool documentation = parameters.documentation_mode();
      const bool with_path     = std::count(cases.begin(), cases.end(), strain_path) > 0;
      // Mistyped cases must not make the entries of tests unknown too.
      const bool with_tests = cases.empty() || cases.size() > static_cast<std::size_t>(with_path);
      if (with_tests || documentation)
        {
          angles = parameters.quantity_list(
              "Angles", "deg", Range::between(0., 180.),
              "Directions of uniaxial, plane strain and shear tests from the rolling direction.");
          largest_strain
              = parameters.quantity("Largest strain", "", Range::positive().usual(1e-4, 1.5),
                                    "Logarithmic strain along at the end of a test; in shear the engineering "
                                    "shear strain.");
          strain_rate = parameters.quantity("Strain rate", "1/s", Range::positive().usual(1e-6, 1e4),
                                            "Rate of that strain, constant.");
          increments
              = parameters.integer("Increments", Range::between(1, 100000), "Increments of a test.",
                                   Default{ "200", "backward Euler: the error falls with the increment, and a curve "
                                                   "of 200 points looks smooth" });
        }
      if (with_path || documentation)
        {
          const auto file = parameters.input_file(
              "Strain path file",
              "CSV file with the columns time_s, eps_xx, eps_yy, eps_xy: logarithmic strains in the "
              "axes of the sheet (x: rolling direction; tensor component of the shear).");
          if (!documentation && !file.empty())
            path = read_strain_path(file);
        }
      else
        parameters.mark_unselected("Strain path file");
    }

    std::string
    MaterialPointTest::describe() const
    {
      std::string list;
      for (const std::string &name : cases)
        list += (list.empty() ? "" : ", ") + name;
      return "The sheet material at one point: " + list + ".";
    }

    std::vector<Curve>
    MaterialPointTest::run_cases() const
    {
      std::vector<Curve> curves;
      for (const std::string &name : cases)
        if (name == strain_path)
          curves.push_back({ name, 0., follow_strain_path(*material, path) });
        else
          // Equibiaxial tension knows no direction.
          for (const double angle : name == "equibiaxial" ? std::vector<double>{ 0. } : angles)
            curves.push_back({ name, angle,
                               run_point_test(*material, point_tests().at(name), angle, largest_strain, strain_rate,
                                              static_cast<unsigned>(increments)) });
      return curves;
    }

    void
    MaterialPointTest::write_curves(const std::vector<Curve> &curves, const RunContext &context) const
    {
      CsvTable        table({ "load_case", "angle_deg", "time_s", "eps_xx", "eps_yy", "eps_xy", "stress_xx_mpa",
                              "stress_yy_mpa", "stress_xy_mpa", "strain_along", "stress_along_mpa", "thickness_strain",
                              "eps_p", "elastic_energy_n_per_mm2", "plastic_work_n_per_mm2", "stress_power_n_per_mm2" });
      plot::LineChart chart{ "Stress over strain", "Logarithmic strain along the test", "True stress along / MPa" };
      chart.y_from_zero = true;
      for (const Curve &curve : curves)
        {
          const Matrix3 Q = strain_rotation(curve.angle), to_local = Q.inverse().transpose();
          const int     k = curve.load_case == "shear" ? 2 : 0;
          plot::Series  series;
          series.label = curve.name();
          for (const PointState &s : curve.states)
            {
              const double strain = (Q * s.strain)[k], stress = (to_local * s.stress)[k];
              series.x.push_back(strain);
              series.y.push_back(stress);
              table.add_row({ curve.load_case, curve.angle / degree, s.time, s.strain[0], s.strain[1],
                              0.5 * s.strain[2], s.stress[0], s.stress[1], s.stress[2], strain, stress,
                              material->thickness_strain(s.strain, s.plastic), s.plastic.eps_p, s.elastic_energy,
                              s.plastic_work, s.stress_power });
            }
          chart.series.push_back(std::move(series));
        }
      table.save(context.file("stress_strain.csv"));
      plot::draw(chart, context.file("stress_strain"));
    }

    void
    MaterialPointTest::write_directions(CsvTable &results, const RunContext &context) const
    {
      CsvTable     directions({ "angle_deg", "stress_ratio", "r_value" });
      plot::Series stress, R;
      for (int degrees = 0; degrees <= 90; ++degrees)
        {
          // Tension in this direction: unit stress, and the flow direction in turned axes.
          const Matrix3 Q = strain_rotation(degrees * degree);
          Vector3       n;
          Matrix3       H;
          const double  ratio = 1 / material->locus().evaluate(Q.transpose().col(0), n, H);
          const Vector3 flow  = Q * n;
          const double  r     = -flow[1] / (flow[0] + flow[1]);
          directions.add_row({ static_cast<double>(degrees), ratio, r });
          stress.x.push_back(degrees);
          stress.y.push_back(ratio);
          R.x.push_back(degrees);
          R.y.push_back(r);
          if (degrees % 45 == 0)
            {
              results.add_row({ "stress_ratio_" + std::to_string(degrees), ratio, std::string("1") });
              results.add_row({ "r_value_" + std::to_string(degrees), r, std::string("1") });
            }
        }
      directions.save(context.file("directions.csv"));
      Vector3      n;
      Matrix3      H;
      const double e = material->locus().evaluate({ 1, 1, 0 }, n, H);
      results.add_row({ std::string("equibiaxial_stress_ratio"), 1 / e, std::string("1") });
      results.add_row({ std::string("equibiaxial_strain_ratio"), n[1] / n[0], std::string("1") });
      const std::string angle = "Angle from the rolling direction / °";
      plot::draw(plot::LineChart{ "Yield stress in tension",
                                  angle,
                                  "Yield stress / that in rolling direction",
                                  false,
                                  false,
                                  false,
                                  false,
                                  { stress } },
                 context.file("yield_stress_over_angle"));
      plot::draw(plot::LineChart{ "R-value", angle, "R-value", false, false, true, false, { R } },
                 context.file("r_value_over_angle"));
    }

    // Sections of the locus at constant shear stress, by bisection along rays, and the last states of the load cases.
    void
    MaterialPointTest::write_locus(const std::vector<Curve> &curves, const RunContext &context) const
    {
      CsvTable          table({ "shear_stress_ratio", "stress_xx_ratio", "stress_yy_ratio" });
      plot::LineChart   chart{ "Yield locus, sections at constant shear stress", "σxx / σ0", "σyy / σ0" };
      const YieldLocus &locus  = material->locus();
      const double      limit  = 1 / locus.equivalent_stress({ 0, 0, 1 });
      const int         n_rays = 360;
      for (const double share : { 0., 0.5, 0.8 })
        {
          plot::Series series;
          const double shear = share * limit;
          series.label = share == 0 ? "no shear stress" : "σxy / σ0 = " + units::number(std::round(1e3 * shear) / 1e3);
          for (int i = 0; i <= n_rays; ++i)
            {
              const double c = std::cos(2 * pi * i / n_rays), s = std::sin(2 * pi * i / n_rays);
              double       low = 0, high = 4;
              for (int k = 0; k < 60; ++k)
                {
                  const double middle                                                           = 0.5 * (low + high);
                  (locus.equivalent_stress({ middle * c, middle * s, shear }) < 1 ? low : high) = middle;
                }
              series.x.push_back(low * c);
              series.y.push_back(low * s);
              table.add_row({ shear, low * c, low * s });
            }
          chart.series.push_back(std::move(series));
        }
      for (const Curve &curve : curves)
        {
          const Vector3 &stress = curve.states.back().stress;
          const double   e      = locus.equivalent_stress(stress);
          if (e > 0)
            chart.series.push_back({ curve.name(), { stress[0] / e }, { stress[1] / e }, plot::Series::Style::points });
        }
      chart.equal_axes = true;
      table.save(context.file("yield_locus.csv"));
      plot::draw(chart, context.file("yield_locus"));
    }

    void
    MaterialPointTest::add_results(const Curve &curve, CsvTable &results) const
    {
      std::string prefix = curve.load_case;
      std::replace(prefix.begin(), prefix.end(), ' ', '_');
      if (curve.load_case != strain_path && curve.load_case != "equibiaxial")
        prefix += "_" + units::number(std::round(curve.angle / degree * 100) / 100);
      const auto add = [&](const char *what, const double value, const char *unit) {
        results.add_row({ prefix + "_" + what, value, std::string(unit) });
      };
      const PointState &last   = curve.states.back();
      const Matrix3     Q      = strain_rotation(curve.angle);
      const Vector3     stress = Q.inverse().transpose() * last.stress, plastic = Q * last.plastic.plastic_strain;
      add("stress", stress[curve.load_case == "shear" ? 2 : 0], "MPa");
      add("eps_p", last.plastic.eps_p, "1");
      add("thickness_strain", material->thickness_strain(last.strain, last.plastic), "1");
      if (curve.load_case == "uniaxial" && last.plastic.eps_p > 0)
        add("r_value", -plastic[1] / (plastic[0] + plastic[1]), "1");
      if (curve.load_case == "equibiaxial" && last.plastic.eps_p > 0)
        add("strain_ratio", plastic[1] / plastic[0], "1");
      // What the trapezoidal rule over the states and the backward Euler steps leave open.
      if (last.stress_power > 0)
        add("energy_error", (last.elastic_energy + last.plastic_work) / last.stress_power - 1, "1");
      add("sub_steps", last.sub_steps, "1");
    }

    void
    MaterialPointTest::run(const RunContext &context)
    {
      if (parallel::rank() != 0)
        return;
      CsvTable results({ "quantity", "value", "unit" });
      write_directions(results, context);
      results.save(context.file("results.csv"));
      const std::vector<Curve> curves = run_cases();
      for (const Curve &curve : curves)
        add_results(curve, results);
      results.save(context.file("results.csv"));
      write_curves(curves, context);
      write_locus(curves, context);
      log::info(std::to_string(curves.size()) + " load cases.");
    }
  } // namespace

  TRIBODRAW_REGISTER(SheetTest, MaterialPointTest, "material point",
                     "The sheet material at one point: tension in all directions, plane strain, equibiaxial tension, "
                     "shear, or a strain path from a file; yield locus and R-values.",
                     "")
} // namespace tribodraw
