#include <tribodraw/application/task.h>
#include <tribodraw/base/csv.h>
#include <tribodraw/base/errors.h>
#include <tribodraw/base/log.h>
#include <tribodraw/base/parallel.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/base/timing.h>
#include <tribodraw/base/units.h>
#include <tribodraw/fluid/lubricant.h>
#include <tribodraw/friction_table/builder.h>
#include <tribodraw/friction_table/coefficient_table.h>
#include <tribodraw/lubrication/strip_contact.h>

#include <algorithm>
#include <functional>
#include <sstream>

namespace tribodraw
{
  namespace
  {
    using Result = StripContact::Result;

    /// An operating point with the viscosity, which a sweep may change too.
    struct Point
    {
      StripContact::Conditions conditions;
      double                   viscosity = 0; ///< at ambient pressure [MPa s]
    };

    /// One swept quantity: its file and how a value enters the operating point.
    struct Sweep
    {
      std::string                          name;
      std::vector<double>                  values;
      std::function<void(Point &, double)> apply;
    };

    constexpr std::size_t n_numbers = 17; // of a result, as sent between ranks

    /// What the tables of sweeps need of a result.
    std::vector<double>
    numbers(const Result &r)
    {
      return { r.friction_coefficient,
               r.solid_friction,
               r.viscous_friction,
               r.solid_share,
               r.lubricant_share,
               r.mean_film,
               r.film_ratio,
               r.contact_fraction,
               r.max_lubricant_pressure,
               r.starved_fraction,
               r.flow_error,
               r.load_error,
               static_cast<double>(r.regime),
               static_cast<double>(r.load_iterations),
               static_cast<double>(r.film_iterations) };
    }

    /// The virtual tribometer.
    class StripDrawTask : public Task
    {
    public:
      explicit StripDrawTask(Parameters &p)
      {
        {
          const auto scope = p.section("Strip draw");
          geometry         = StripContact::Geometry::read(p);
          read_conditions(p);
        }
        {
          const auto scope = p.section("Coupling");
          settings.read_micro_settings(p);
        }
        {
          const auto scope              = p.section("Lubricant");
          lubricant                     = Lubricant::read(p, false);
          base.conditions.supplied_film = lubricant.supplied_film();
          base.viscosity                = lubricant.viscosity_law ? lubricant.viscosity_law->reference_viscosity() : 0.;
        }
        {
          const auto scope = p.section("Strip draw");
          read_sweeps(p);
        }
        {
          const auto scope = p.section("Friction table");
          if (p.has("File"))
            {
              table_file = p.input_file(
                  "File",
                  "friction_table.json of the pair; without it the table is built from the surfaces described here.");
              p.mark_unselected(""); // what else stands in this section serves to build a table
            }
          read_band(p);
        }
        if (table_file.empty() || p.documentation_mode())
          builder = std::make_unique<FrictionTableBuilder>(FrictionTableBuilder::read(p));
        else
          for (const char *section :
               { "Sheet surface", "Tool surface", "Sheet material", "Flattening", "Flow factors", "Boundary friction" })
            p.mark_unselected(section);
      }

      std::string
      describe() const override
      {
        std::size_t points = 1;
        for (const Sweep &sweep : sweeps)
          points += sweep.values.size();
        if (coefficient_table)
          points += pressures.size() * speeds.size() * strains.size();
        return "Virtual strip draw at " + units::format(base.conditions.pressure, "MPa") + " and "
               + units::format(base.conditions.speed, "mm/s") + ", " + std::to_string(points)
               + " operating points in all.";
      }

      void
      run(const RunContext &context) override
      {
        table = get_table(context.output_folder.parent_path());
        const StripContact contact(geometry, table, lubricant.viscosity_law, settings.boundary_layer_pressure,
                                   settings.phi_p_floor);
        lubricant.viscosity_law->set_reference_viscosity(base.viscosity);
        const Result result = contact.solve(base.conditions);
        for (const auto &file : band_files)
          band.push_back(std::make_unique<StripContact>(
              geometry, std::make_shared<FrictionTable>(FrictionTable::read(file)), lubricant.viscosity_law,
              settings.boundary_layer_pressure, settings.phi_p_floor));
        log::info("Friction coefficient " + units::number(result.friction_coefficient) + ", the lubricant carries "
                  + units::number(100. * result.lubricant_share) + " % of the load, " + regime_name(result.regime)
                  + " lubrication");
        if (parallel::rank() == 0)
          {
            write_results(result, band_of(base), context);
            write_profile(result, context);
          }
        for (const Sweep &sweep : sweeps)
          run_sweep(contact, sweep, context);
        if (coefficient_table)
          make_coefficient_table(contact, context);
        table->warn_of_look_ups_beyond();
      }

    private:
      void
      read_conditions(Parameters &p)
      {
        base.conditions.pressure = p.quantity("Pressure", "MPa", Range::positive().usual(0.01, 500),
                                              "Nominal contact pressure: load over length times width.");
        base.conditions.speed
            = p.quantity("Speed", "mm/s", Range::non_negative().usual(0, 1e4), "Speed of the strip under the tool.");
        base.conditions.strain
            = p.quantity("Strain", "", Range::between(0, 5), "Equivalent plastic strain of the strip under the tool.");
      }

      std::vector<double>
      sweep_list(Parameters &p, const std::string &entry, const std::string &unit, const Range &range,
                 const std::string &documentation)
      {
        std::vector<double> values = p.quantity_list(
            entry, unit, range, documentation + " Without this entry it is not varied.", Default{ "", "no sweep" });
        for (std::size_t i = 1; i < values.size(); ++i)
          if (!(values[i] > values[i - 1]) && !p.documentation_mode())
            {
              p.problem(entry, "value " + std::to_string(i + 1) + " is not greater than the one before it",
                        "an ascending list");
              break;
            }
        return values;
      }

      void
      read_sweeps(Parameters &p)
      {
        const auto scope = p.section("Sweep");
        pressures        = sweep_list(p, "Pressures", "MPa", Range::positive().usual(0.01, 500), "Nominal pressures.");
        speeds           = sweep_list(p, "Speeds", "mm/s", Range::non_negative().usual(0, 1e5),
                                      "Speeds of the strip: the Stribeck curve.");
        strains          = sweep_list(p, "Strains", "", Range::between(0, 5), "Equivalent plastic strains.");
        const auto amounts
            = sweep_list(p, "Amounts", "g/m^2", Range::non_negative().usual(0, 20), "Amounts of lubricant.");
        const auto   viscosities = sweep_list(p, "Viscosities", "mPa s", Range::positive().usual(0.5, 5000),
                                              "Viscosities at ambient pressure.");
        const double density     = lubricant.density;
        const auto   add         = [&](const char *name, const std::vector<double> &values, auto apply) {
          if (!values.empty())
            sweeps.push_back({ name, values, apply });
        };
        add("pressure", pressures, [](Point &at, const double v) { at.conditions.pressure = v; });
        add("speed", speeds, [](Point &at, const double v) { at.conditions.speed = v; });
        add("strain", strains, [](Point &at, const double v) { at.conditions.strain = v; });
        add("amount", amounts, [density](Point &at, const double v) { at.conditions.supplied_film = v / density; });
        add("viscosity", viscosities, [](Point &at, const double v) { at.viscosity = v; });
        coefficient_table
            = p.flag("Coefficient table",
                     "Write friction_coefficient.json: the coefficient over all pressures, speeds and strains "
                     "of the lists above, which `tribodraw export` translates for other programs. A list "
                     "that is missing counts as the one value of the operating point.",
                     Default{ "false", "each combination costs some hundredths of a second" });
        if (pressures.empty())
          pressures = { base.conditions.pressure };
        if (speeds.empty())
          speeds = { base.conditions.speed };
        if (strains.empty())
          strains = { base.conditions.strain };
      }

      void
      read_band(Parameters &p)
      {
        std::istringstream list(
            p.text("Band files",
                   "Friction tables of single maps of the sheet (friction_table_map_<n>.json), separated "
                   "by commas: the scatter of the surface becomes a band of the friction coefficient.",
                   Default{ "", "no band" }));
        for (std::string file; std::getline(list, file, ',');)
          {
            const auto first = file.find_first_not_of(' '), last = file.find_last_not_of(' ');
            if (first == std::string::npos)
              continue;
            band_files.push_back(p.base_folder() / file.substr(first, last - first + 1));
            if (!std::filesystem::exists(band_files.back()) && !p.documentation_mode())
              p.problem("Band files", "The file `" + band_files.back().string() + "` does not exist.");
          }
      }

      std::shared_ptr<const FrictionTable>
      get_table(const std::filesystem::path &cache)
      {
        if (!builder)
          return std::make_shared<FrictionTable>(FrictionTable::read(table_file));
        Progress progress("Friction table", 1.);
        auto     made = std::make_shared<FrictionTable>(
            builder->load_or_build(cache, [&](const double done) { progress.update(done); }));
        progress.finish((builder->was_cached() ? "found in " : "kept in ") + builder->cached_file(cache).string());
        return made;
      }

      /// Friction coefficients with the tables of the single maps.
      std::vector<double>
      band_of(const Point &point)
      {
        lubricant.viscosity_law->set_reference_viscosity(point.viscosity);
        std::vector<double> mu;
        for (const auto &member : band)
          mu.push_back(member->solve(point.conditions).friction_coefficient);
        return mu;
      }

      static void
      write_results(const Result &r, const std::vector<double> &mu_band, const RunContext &context)
      {
        CsvTable csv({ "quantity", "value", "unit" });
        csv.add_row({ "friction_coefficient", r.friction_coefficient, "1" });
        if (!mu_band.empty())
          {
            csv.add_row({ "friction_coefficient_lowest", *std::min_element(mu_band.begin(), mu_band.end()), "1" });
            csv.add_row({ "friction_coefficient_highest", *std::max_element(mu_band.begin(), mu_band.end()), "1" });
          }
        csv.add_row({ "solid_friction", r.solid_friction, "1" });
        csv.add_row({ "viscous_friction", r.viscous_friction, "1" });
        csv.add_row({ "solid_share", r.solid_share, "1" });
        csv.add_row({ "lubricant_share", r.lubricant_share, "1" });
        csv.add_row({ "regime", regime_name(r.regime), "-" });
        csv.add_row({ "mean_film", r.mean_film / units::factor("um"), "um" });
        csv.add_row({ "film_over_sq", r.film_ratio, "1" });
        csv.add_row({ "contact_fraction", r.contact_fraction, "1" });
        csv.add_row({ "max_lubricant_pressure", r.max_lubricant_pressure, "MPa" });
        csv.add_row({ "starved_fraction", r.starved_fraction, "1" });
        csv.add_row({ "tool_height", r.tool_height / units::factor("um"), "um" });
        csv.add_row({ "flow_in", r.flow_in, "mm^3/s" });
        csv.add_row({ "flow_rejected_at_inlet", r.rejected, "mm^3/s" });
        csv.add_row({ "flow_out", r.flow_out, "mm^3/s" });
        csv.add_row({ "flow_sides", r.flow_sides, "mm^3/s" });
        csv.add_row({ "flow_error", r.flow_error, "1" });
        csv.add_row({ "load_error", r.load_error, "1" });
        csv.save(context.file("results.csv"));
      }

      static void
      write_profile(const Result &r, const RunContext &context)
      {
        CsvTable csv(
            { "x_mm", "gap_um", "solid_pressure_mpa", "lubricant_pressure_mpa", "film_fraction", "contact_fraction" });
        const auto &profile = r.profile;
        for (std::size_t i = 0; i < profile.x.size(); ++i)
          csv.add_row({ profile.x[i], profile.gap[i] / units::factor("um"), profile.solid_pressure[i],
                        profile.lubricant_pressure[i], profile.fill[i], profile.contact_fraction[i] });
        csv.save(context.file("strip_profile.csv"));
      }

      template <class Error>
      static void
      throw_on_all_ranks(const std::string &failure)
      {
        for (unsigned rank = 0; rank < parallel::size(); ++rank)
          {
            std::string text = rank == parallel::rank() ? failure : "";
            parallel::broadcast(text, rank);
            if (!text.empty())
              throw Error(text);
          }
      }

      /// The points are shared out among the ranks; every rank gets all results.
      std::vector<double>
      solve_all(const StripContact &contact, const std::vector<Point> &points, const std::string &name)
      {
        Progress            progress(name, static_cast<double>(points.size()));
        std::vector<double> all(points.size() * n_numbers, 0.);
        std::string         wrong_input, not_converged;
        for (std::size_t i = parallel::rank(); i < points.size() && wrong_input.empty(); i += parallel::size())
          {
            try
              {
                lubricant.viscosity_law->set_reference_viscosity(points[i].viscosity);
                auto row = numbers(contact.solve(points[i].conditions));
                auto mu  = band_of(points[i]);
                mu.push_back(row[0]);
                row.push_back(*std::min_element(mu.begin(), mu.end()));
                row.push_back(*std::max_element(mu.begin(), mu.end()));
                std::copy(row.begin(), row.end(), all.begin() + static_cast<std::ptrdiff_t>(i * n_numbers));
              }
            catch (const InputError &e)
              {
                wrong_input = e.what();
              }
            catch (const ConvergenceError &e)
              {
                not_converged = e.what();
              }
            progress.update(static_cast<double>(i + 1));
          }
        throw_on_all_ranks<InputError>(wrong_input);
        throw_on_all_ranks<ConvergenceError>(not_converged);
        parallel::sum(all);
        progress.finish();
        return all;
      }

      void
      run_sweep(const StripContact &contact, const Sweep &sweep, const RunContext &context)
      {
        std::vector<Point> points;
        for (const double value : sweep.values)
          {
            points.push_back(base);
            sweep.apply(points.back(), value);
          }
        const auto all = solve_all(contact, points, "Sweep over " + sweep.name);
        if (parallel::rank() != 0)
          return;
        CsvTable csv({ "pressure_mpa",
                       "speed_mm_per_s",
                       "eps_p",
                       "amount_g_per_m2",
                       "viscosity_mpa_s",
                       "hersey_number",
                       "mu",
                       "solid_friction",
                       "viscous_friction",
                       "solid_share",
                       "lubricant_share",
                       "mean_film_um",
                       "film_over_sq",
                       "contact_fraction",
                       "max_lubricant_pressure_mpa",
                       "starved_fraction",
                       "flow_error",
                       "load_error",
                       "mu_lowest",
                       "mu_highest",
                       "regime" });
        for (std::size_t i = 0; i < points.size(); ++i)
          {
            const double *r = &all[i * n_numbers];
            const auto   &c = points[i].conditions;
            csv.add_row({ c.pressure,
                          c.speed,
                          c.strain,
                          c.supplied_film * lubricant.density / units::factor("g/m^2"),
                          points[i].viscosity / units::factor("mPa s"),
                          points[i].viscosity * c.speed / (c.pressure * table->sq),
                          r[0],
                          r[1],
                          r[2],
                          r[3],
                          r[4],
                          r[5] / units::factor("um"),
                          r[6],
                          r[7],
                          r[8],
                          r[9],
                          r[10],
                          r[11],
                          r[15],
                          r[16],
                          regime_name(static_cast<Result::Regime>(static_cast<int>(r[12]))) });
          }
        csv.save(context.file("sweep_" + sweep.name + ".csv"));
      }

      void
      make_coefficient_table(const StripContact &contact, const RunContext &context)
      {
        CoefficientTable coefficients;
        coefficients.pressures = pressures;
        coefficients.speeds    = speeds;
        coefficients.strains   = strains;
        std::vector<Point> points;
        for (const double p : pressures)
          for (const double v : speeds)
            for (const double e : strains)
              {
                points.push_back(base);
                points.back().conditions.pressure = p;
                points.back().conditions.speed    = v;
                points.back().conditions.strain   = e;
              }
        const auto all = solve_all(contact, points, "Friction coefficients");
        if (parallel::rank() != 0)
          return;
        for (std::size_t i = 0; i < points.size(); ++i)
          coefficients.values.push_back(all[i * n_numbers]);
        coefficients.provenance = { { "source", "virtual strip draw" },
                                    { "program", "tribodraw" },
                                    { "parameters", context.effective_parameters },
                                    { "contact length mm", geometry.length },
                                    { "contact width mm", geometry.width },
                                    { "lubricant film um", base.conditions.supplied_film / units::factor("um") },
                                    { "friction table", table->provenance } };
        coefficients.write(context.file("friction_coefficient.json"), context.file("friction_coefficient.csv"));
      }

      StripContact::Geometry                     geometry;
      Point                                      base;
      LubricationSettings                        settings;
      Lubricant                                  lubricant;
      std::vector<double>                        pressures, speeds, strains;
      std::vector<Sweep>                         sweeps;
      bool                                       coefficient_table = false;
      std::filesystem::path                      table_file;
      std::unique_ptr<FrictionTableBuilder>      builder;
      std::shared_ptr<const FrictionTable>       table;
      std::vector<std::filesystem::path>         band_files;
      std::vector<std::unique_ptr<StripContact>> band;
    };
  } // namespace

  TRIBODRAW_REGISTER(
      Task, StripDrawTask, "strip draw",
      "Virtual tribometer: a flat tool on a drawn strip, friction coefficient over pressure, speed, strain, "
      "lubricant amount and viscosity.",
      "")
} // namespace tribodraw
