#include <tribodraw/application/sheet_test.h>
#include <tribodraw/base/csv.h>
#include <tribodraw/base/errors.h>
#include <tribodraw/base/log.h>
#include <tribodraw/base/parallel.h>
#include <tribodraw/base/units.h>
#include <tribodraw/output/paraview.h>
#include <tribodraw/output/plot.h>
#include <tribodraw/output/vtu.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cstdio>
#include <cmath>
#include <limits>
#include <optional>

#include "shell_case.h"

namespace tribodraw
{
  namespace
  {
    enum class Control
    {
      linear,
      load,
      displacement,
      path
    };

    /// What is prescribed, and how far.
    struct Loading
    {
      Control             control = Control::linear;
      std::vector<double> targets; ///< load factors or displacements of the first measure
      double              first_step = 0, largest_step = 0;
      double              time    = 1; ///< to the last target [s]
      bool                release = false;

      static Loading
      read(Parameters &p)
      {
        Loading                        l;
        const std::vector<std::string> controls{ "linear", "load", "displacement", "path" };
        const std::string              chosen
            = p.choice("Control", controls,
                       "linear: one linear solution at load factor one. load: the load factor is prescribed. "
                       "displacement: that of measure 1 is prescribed. path: arc length, past limit points and back.");
        l.control       = static_cast<Control>(std::find(controls.begin(), controls.end(), chosen) - controls.begin());
        const bool load = chosen == "load", displacement = chosen == "displacement" || chosen == "path";
        // Without a choice every entry is asked for, so that mistyped ones are recognised.
        const bool all = p.documentation_mode() || !p.has("Control");
        if (load || all)
          l.read_steps(p, "Load factors", "First load step", "Largest load step", "",
                       "Load factors that are reached exactly, one after the other.");
        else
          for (const char *entry : { "Load factors", "First load step", "Largest load step" })
            p.mark_unselected(entry);
        if (displacement || all)
          l.read_steps(
              p, "Displacements", "First step", "Largest step", "mm",
              "Displacements of measure 1. They are reached exactly, one after the other, under the control "
              "displacement; the control path ends beyond the last one, and its steps are Euclidean norms of the "
              "displacements of all nodes.");
        else
          for (const char *entry : { "Displacements", "First step", "Largest step" })
            p.mark_unselected(entry);
        if (load || displacement || all)
          {
            l.time    = p.quantity("Time", "s", Range::positive(), "Time in which the last of them is reached.",
                                   Default{ "1 s", "without effect for materials that do not depend on the strain rate" });
            l.release = p.flag("Release", "Take all loads and motions off at the end: springback.",
                               Default{ "false", "most load cases end under load" });
          }
        else
          for (const char *entry : { "Time", "Release" })
            p.mark_unselected(entry);
        return l;
      }

    private:
      void
      read_steps(Parameters &p, const std::string &list, const std::string &first, const std::string &largest,
                 const std::string &unit, const std::string &documentation)
      {
        targets      = p.quantity_list(list, unit, Range::between(-1e9, 1e9), documentation);
        first_step   = p.quantity(first, unit, Range::positive(), "First step; the following adapt.");
        largest_step = p.quantity(largest, unit, Range::positive(), "Largest step.");
        if (!p.documentation_mode() && (targets.empty() || targets.back() == 0))
          p.problem(list, "the last value must not be zero.", "", "Use `Release` to unload.");
      }
    };

    /// A shell of any shape under prescribed loads.
    class ShellTest : public SheetTest
    {
    public:
      explicit ShellTest(Parameters &p) : shell_case(ShellCase::read(p)), loading(Loading::read(p))
      {
        {
          const auto scope = p.section("Solver");
          settings         = StaticAnalysis::Settings::read(p);
        }
        const auto scope = p.top_section("Sheet material");
        material         = std::make_shared<SheetMaterial>(SheetMaterial::read(p));
      }

      std::string
      describe() const override
      {
        const auto &s = shell_case.surface;
        return "Static analysis of a shell, " + std::to_string(s.n_u) + " x " + std::to_string(s.n_v)
               + " squares, up to "
               + (loading.control == Control::linear
                      ? std::string("load factor 1, linear")
                      : units::number(loading.targets.back())
                            + (loading.control == Control::load ? " of the load" : " mm"))
               + ".";
      }

      void
      run(const RunContext &context) override
      {
        Run run(*this, context);
        try
          {
            run.load();
          }
        catch (const ConvergenceError &)
          {
            run.write();
            throw;
          }
        run.write();
      }

    private:
      /// The state of one run.
      class Run
      {
      public:
        Run(const ShellTest &the_test, const RunContext &the_context)
            : test(the_test), context(the_context), mesh(test.shell_case.mesh()),
              shell(mesh.mesh, test.shell_case.thickness, test.material, test.shell_case.n_points,
                    test.shell_case.rule),
              loads(test.shell_case.make_loads(mesh))
        {
          std::vector<std::string> columns{ "load_factor" };
          for (const ShellCase::Measure &m : test.shell_case.measures)
            {
              measures.push_back(test.shell_case.measure(m, mesh));
              columns.push_back(m.name + "_mm");
            }
          for (std::size_t k = 0; k < test.shell_case.turned_sides.size(); ++k)
            columns.push_back("moment_per_length_" + std::to_string(k + 1) + "_n");
          if (!test.shell_case.moved_sides.empty())
            columns.push_back("work_conjugate_force_n_mm");
          columns.insert(columns.end(), { "elastic_energy_n_mm", "plastic_work_n_mm", "iterations" });
          curve.emplace(columns);
          displacement.resize(measures.size(), { 0. });
        }

        void
        load()
        {
          const Loading &l        = test.loading;
          const Supports supports = test.shell_case.make_supports(shell, mesh, true);
          StaticAnalysis analysis(shell, supports, loads, Loads(), test.settings);
          if (l.control == Control::linear)
            return solve_linear(analysis);
          save_fields(0);
          analysis.set_speed(std::abs(l.targets.back()) / l.time);
          analysis.observe([this](const StaticAnalysis &a) { record(a); });
          if (l.control == Control::path)
            {
              const double sign = l.targets.back() < 0 ? -1 : 1;
              analysis.along_path(l.first_step, l.largest_step, [&](const StaticAnalysis &a) {
                return sign * a.displacement(measures[0]) >= sign * l.targets.back();
              });
              save_fields(analysis.factor());
            }
          else
            for (const double target : l.targets)
              {
                if (l.control == Control::load)
                  analysis.to_factor(target, l.first_step, l.largest_step);
                else
                  analysis.to_displacement(measures[0], target, l.first_step, l.largest_step);
                save_fields(analysis.factor());
              }
          largest_plastic_strain();
          loaded_turn = turns();
          if (l.release)
            release(analysis);
        }

        void
        write()
        {
          CsvTable results = summary();
          if (parallel::rank() != 0)
            return;
          compare(results);
          results.save(context.file("results.csv"));
          curve->save(context.file("load_displacement.csv"));
          draw();
        }

      private:
        const ShellTest                 &test;
        const RunContext                &context;
        const SurfaceMesh                mesh;
        Shell                            shell;
        const Loads                      loads;
        std::vector<DisplacementMeasure> measures;
        std::optional<CsvTable>          curve;
        std::vector<double>              factor{ 0. }; ///< of the curve
        std::vector<std::vector<double>> displacement; ///< of each measure along the curve
        std::size_t                      n_loaded = 1; ///< points of the curve before the release
        std::vector<double>              moment;       ///< of each turned side, last and loaded
        std::vector<double>              loaded_turn;
        double                           max_eps_p = 0, linear_energy = 0;
        unsigned                         n_fields = 0;
        PvdCollection                    collection;
        Progress                         progress{ "Load path", 1. };

        /// The committed one, or that of the linear solution.
        double
        elastic_energy() const
        {
          return shell.elastic_energy() + linear_energy;
        }

        void
        solve_linear(StaticAnalysis &analysis)
        {
          const Eigen::VectorXd u = analysis.linear_response();
          linear_energy           = analysis.linear_energy(u);
          shell.move(u);
          add_point(1., shell.trial(), {}, 1);
          n_loaded = factor.size();
          save_fields(1);
          shell.revert();
        }

        void
        add_point(const double load_factor, const Shell::Configuration &configuration,
                  const std::vector<CsvTable::Cell> &forces, const unsigned iterations)
        {
          std::vector<CsvTable::Cell> row{ load_factor };
          factor.push_back(load_factor);
          for (std::size_t m = 0; m < measures.size(); ++m)
            {
              displacement[m].push_back(measures[m].value(shell, configuration));
              row.emplace_back(displacement[m].back());
            }
          std::vector<CsvTable::Cell> padded = forces;
          padded.resize(test.shell_case.turned_sides.size() + (test.shell_case.moved_sides.empty() ? 0 : 1),
                        std::numeric_limits<double>::quiet_NaN());
          row.insert(row.end(), padded.begin(), padded.end());
          row.emplace_back(elastic_energy());
          row.emplace_back(shell.plastic_work());
          row.emplace_back(static_cast<long>(iterations));
          curve->add_row(std::move(row));
        }

        void
        record(const StaticAnalysis &analysis)
        {
          std::vector<CsvTable::Cell> forces;
          moment.clear();
          for (const ShellCase::TurnedSide &turned : test.shell_case.turned_sides)
            {
              // The work of turning by the angle one.
              double sum = 0;
              for (std::size_t k = 0; k < mesh.side[turned.side].size(); ++k)
                {
                  const unsigned         node    = mesh.side[turned.side][k];
                  const Eigen::Vector3d  tangent = mesh.tangent[turned.side][k];
                  const Eigen::Vector3d &d       = shell.committed().director[node];
                  for (unsigned t = 0; t < 2; ++t)
                    sum += analysis.reactions()[shell.dof(node, 3 + t)]
                           * tangent.cross(d).dot(shell.committed().frame[node][t]);
                }
              moment.push_back(sum / ShellCase::length(mesh, turned.side));
              forces.emplace_back(moment.back());
            }
          if (!test.shell_case.moved_sides.empty())
            forces.emplace_back(analysis.motion_force());
          add_point(analysis.factor(), shell.committed(), forces, analysis.steps().back().iterations);
          n_loaded = factor.size();
          report(analysis);
        }

        /// One line a step.
        void
        report(const StaticAnalysis &analysis)
        {
          const Loading &l    = test.loading;
          const double   done = (l.control == Control::load ? analysis.factor() : displacement[0].back()) / l.targets.back();
          const auto    &step = analysis.steps().back();
          char           text[300];
          std::snprintf(text, sizeof text, "%5.1f %%  load factor %.6g  step %.3g  %s %.6g mm  its %2u  residual %.0e  ",
                        100 * done, analysis.factor(), factor.back() - factor[factor.size() - 2],
                        test.shell_case.measures[0].name.c_str(), displacement[0].back(), step.iterations,
                        step.residuals.empty() ? 0. : step.residuals.back());
          log::step(text + progress.times(done));
          progress.update(done);
        }

        /// Angle by which the director of each turned side has turned.
        std::vector<double>
        turns() const
        {
          std::vector<double> result;
          for (const ShellCase::TurnedSide &turned : test.shell_case.turned_sides)
            {
              double sum = 0;
              for (std::size_t k = 0; k < mesh.side[turned.side].size(); ++k)
                {
                  const unsigned         node   = mesh.side[turned.side][k];
                  const Eigen::Vector3d &before = mesh.mesh.normals[node], &now = shell.committed().director[node];
                  sum += std::atan2(mesh.tangent[turned.side][k].dot(before.cross(now)), before.dot(now));
                }
              result.push_back(sum / static_cast<double>(mesh.side[turned.side].size()));
            }
          return result;
        }

        void
        release(const StaticAnalysis &loaded)
        {
          const Supports supports = test.shell_case.make_supports(shell, mesh, false);
          // What held the sheet becomes a load and goes to zero.
          const Loads       held  = test.shell_case.holding_loads(shell, mesh, loaded.reactions());
          const bool        moved = !test.shell_case.moved_sides.empty() || !test.shell_case.turned_sides.empty();
          StaticAnalysis    unloading(shell, supports, moved ? held : loads, Loads(), test.settings,
                                   moved ? 1. : loaded.factor());
          const std::size_t before = n_loaded;
          unloading.observe([&](const StaticAnalysis &a) {
            add_point(a.factor(), shell.committed(), {}, a.steps().back().iterations);
          });
          const double start = unloading.factor();
          unloading.to_factor(0., 0.25 * std::abs(start), std::abs(start));
          n_loaded = before;
          save_fields(0);
        }

        void
        largest_plastic_strain()
        {
          const std::vector<double> values = shell.element_results().max_eps_p;
          max_eps_p                        = *std::max_element(values.begin(), values.end());
        }

        void
        save_fields(const double load_factor)
        {
          const Shell::ElementResults elements = shell.element_results();
          if (parallel::rank() != 0)
            return;
          SurfaceFields fields;
          fields.points    = shell.trial().position;
          fields.triangles = mesh.mesh.triangles;
          std::vector<Eigen::Vector3d> u(fields.points.size());
          for (std::size_t i = 0; i < u.size(); ++i)
            u[i] = fields.points[i] - mesh.mesh.nodes[i];
          fields.node_vectors = { { "displacement", u }, { "director", shell.trial().director } };
          fields.node_scalars = { { "thickness", shell.node_thickness() }, { "plastic_strain", shell.node_eps_p() } };
          fields.cell_scalars = { { "largest_plastic_strain", elements.max_eps_p } };
          fields.units        = { { "displacement", "mm" }, { "thickness", "mm" } };
          fields.time         = n_fields;
          const std::string number = std::to_string(n_fields);
          const std::string name
              = "solution-" + std::string(5 - std::min<std::size_t>(5, number.size()), '0') + number + ".vtu";
          if (n_fields == 0)
            write_paraview_state(context.output_folder,
                                 { { "Displacement / mm", "displacement" },
                                   { "Thickness / mm", "thickness" },
                                   { "Largest equivalent plastic strain", "largest_plastic_strain" } });
          write_vtu(context.file(name), fields);
          collection.add(n_fields++, name);
          collection.save(context.file("solution.pvd"));
          log::info("fields at load factor " + units::number(load_factor) + " in " + name);
        }

        CsvTable
        summary() const
        {
          CsvTable results({ "quantity", "value", "unit" });
          results.add_row({ std::string("load_factor"), factor.back(), std::string("1") });
          results.add_row({ std::string("largest_load_factor"), *std::max_element(factor.begin(), factor.end()),
                            std::string("1") });
          for (std::size_t m = 0; m < measures.size(); ++m)
            results.add_row({ test.shell_case.measures[m].name, displacement[m].back(), std::string("mm") });
          const std::vector<double> turn = turns();
          for (std::size_t k = 0; k < moment.size(); ++k)
            {
              const std::string number = std::to_string(k + 1);
              results.add_row({ "moment_per_length_" + number, moment[k], std::string("N") });
              if (k < loaded_turn.size())
                results.add_row({ "angle_loaded_" + number, loaded_turn[k], std::string("rad") });
              results.add_row({ "angle_" + number, turn[k], std::string("rad") });
            }
          results.add_row({ std::string("elastic_energy"), elastic_energy(), std::string("N mm") });
          results.add_row({ std::string("plastic_work"), shell.plastic_work(), std::string("N mm") });
          results.add_row({ std::string("largest_plastic_strain"), max_eps_p, std::string("1") });
          return results;
        }

        /// Displacement of a measure where the loading curve crosses a load factor, of several crossings that nearest
        /// to @p expected; not a number if it never does.
        double
        crossing(const std::size_t m, const double at, const double expected) const
        {
          double best = std::numeric_limits<double>::quiet_NaN();
          for (std::size_t k = 1; k < n_loaded; ++k)
            {
              const double a = factor[k - 1] - at, b = factor[k] - at;
              if (a == b || a * b > 0)
                continue;
              const double u = displacement[m][k - 1] + a / (a - b) * (displacement[m][k] - displacement[m][k - 1]);
              if (!(std::abs(u - expected) >= std::abs(best - expected)))
                best = u;
            }
          return best;
        }

        /// Compare with the published points.
        void
        compare(CsvTable &results) const
        {
          CsvTable table({ "measure", "load_factor", "reference_mm", "displacement_mm", "deviation_of_largest" });
          for (std::size_t m = 0; m < measures.size(); ++m)
            {
              const ShellCase::Measure &reference = test.shell_case.measures[m];
              double                    scale = 0, worst = 0;
              for (const double u : reference.reference_displacement)
                scale = std::max(scale, std::abs(u));
              for (std::size_t k = 0; k < reference.reference_displacement.size(); ++k)
                {
                  const double expected = reference.reference_displacement[k];
                  const double u        = crossing(m, reference.reference_factor[k], expected);
                  table.add_row({ reference.name, reference.reference_factor[k], expected, u, (u - expected) / scale });
                  if (std::isfinite(u))
                    worst = std::max(worst, std::abs(u - expected) / scale);
                }
              if (!reference.reference_displacement.empty())
                results.add_row({ reference.name + "_largest_deviation", worst, std::string("1") });
            }
          if (!table.rows().empty())
            table.save(context.file("reference.csv"));
        }

        void
        draw() const
        {
          plot::LineChart chart;
          chart.title   = "Load over displacement";
          chart.x_label = "Displacement / mm";
          chart.y_label = "Load factor";
          for (std::size_t m = 0; m < measures.size(); ++m)
            {
              const ShellCase::Measure &reference = test.shell_case.measures[m];
              chart.series.push_back({ reference.name, displacement[m], factor, plot::Series::Style::line });
              if (!reference.reference_displacement.empty())
                chart.series.push_back({ reference.name + ", reference", reference.reference_displacement,
                                         reference.reference_factor, plot::Series::Style::points });
            }
          plot::draw(chart, context.file("load_displacement"));
        }
      };

      ShellCase                            shell_case;
      Loading                              loading;
      StaticAnalysis::Settings             settings;
      std::shared_ptr<const SheetMaterial> material;
    };
  } // namespace

  TRIBODRAW_REGISTER(SheetTest, ShellTest, "shell",
                     "A shell of any parametric shape with supports and loads: load over displacement, limit loads, "
                     "springback.",
                     "")
} // namespace tribodraw
