#include <tribodraw/base/parameters.h>
#include <tribodraw/material/hardening_law.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <vector>

#include "csv_rows.h"

namespace tribodraw
{
  namespace
  {
    struct Sample
    {
      double      strain, stress;
      std::size_t row; ///< for messages
    };

    /// Samples by rate, and what a message calls a row.
    struct Table
    {
      std::map<double, std::vector<Sample>>   samples;
      std::function<std::string(std::size_t)> place;
    };

    /// A smooth curve through points that overshoots nowhere: cubic between the points, with slopes after F. N. Fritsch
    /// and J. Butland (SIAM J. Sci. Stat. Comput. 5 (1984) 300): harmonic means, zero at an extremum. Beyond the last
    /// point straight on, constant if the curve falls there.
    class Curve
    {
    public:
      explicit Curve(const std::vector<Sample> &samples)
      {
        for (const Sample &s : samples)
          {
            x.push_back(s.strain);
            y.push_back(s.stress);
          }
        const std::size_t   n = x.size();
        std::vector<double> secant(n - 1);
        for (std::size_t i = 0; i + 1 < n; ++i)
          secant[i] = (y[i + 1] - y[i]) / (x[i + 1] - x[i]);
        slope.resize(n);
        slope.front() = secant.front();
        slope.back()  = secant.back();
        for (std::size_t i = 1; i + 1 < n; ++i)
          if (secant[i - 1] * secant[i] > 0)
            {
              const double h0 = x[i] - x[i - 1], h1 = x[i + 1] - x[i];
              slope[i] = 3 * (h0 + h1) / ((2 * h1 + h0) / secant[i - 1] + (h1 + 2 * h0) / secant[i]);
            }
      }

      struct Value
      {
        double value, slope;
      };
      Value
      operator()(const double strain) const
      {
        if (strain >= x.back())
          {
            const double further = std::max(0., slope.back());
            return { y.back() + further * (strain - x.back()), further };
          }
        const auto        after = std::upper_bound(x.begin(), x.end(), strain);
        const std::size_t i     = after == x.begin() ? 0 : static_cast<std::size_t>(after - x.begin()) - 1;
        const double      h = x[i + 1] - x[i], t = std::max(0., strain - x[i]) / h;
        const double      rise = (y[i + 1] - y[i]) / h;
        const double      c = 3 * rise - 2 * slope[i] - slope[i + 1], d = slope[i] + slope[i + 1] - 2 * rise;
        return { y[i] + h * t * (slope[i] + t * (c + t * d)), slope[i] + t * (2 * c + 3 * t * d) };
      }

    private:
      std::vector<double> x, y, slope;
    };

    /// Flow stress from a table over plastic strain and, if wanted, strain rate. Between rates linear in the logarithm
    /// of the rate, outside the rates of the table constant.
    class Tabulated : public HardeningLaw
    {
    public:
      explicit Tabulated(Parameters &parameters);
      FlowStress flow_stress(double strain, double rate) const override;

    private:
      static Table read_lists(Parameters &parameters);
      static Table read_table(const std::filesystem::path &file);
      static void  check(const Table &table, bool may_fall);
      static void  check_rates(const Table &table, const std::vector<Curve> &curves);

      std::vector<Curve>  curves;
      std::vector<double> log_rate; ///< of the curves
    };

    Table
    Tabulated::read_lists(Parameters &parameters)
    {
      const auto strain = parameters.quantity_list("Plastic strains", "", Range::non_negative().usual(0., 3.),
                                                   "Rising plastic strains, the first 0.");
      const auto stress = parameters.quantity_list("Flow stresses", "MPa", Range::positive().usual(10., 5000.),
                                                   "Flow stress (true stress) at each of the strains.");
      Table      table;
      table.place = [path = parameters.path()](const std::size_t i) {
        return path + "/Flow stresses, number " + std::to_string(i + 1);
      };
      if (parameters.documentation_mode() || strain.empty() || stress.empty())
        return table;
      if (strain.size() != stress.size())
        parameters.problem("Flow stresses", std::to_string(stress.size()) + " numbers were given",
                           std::to_string(strain.size()) + ", as many as `Plastic strains`");
      else
        for (std::size_t i = 0; i < strain.size(); ++i)
          table.samples[0.].push_back({ strain[i], stress[i], i });
      return table;
    }

    Table
    Tabulated::read_table(const std::filesystem::path &file)
    {
      constexpr std::uintmax_t largest = 4u << 20;
      const CsvData            data    = read_small_csv(file, largest);
      const auto strain = finite_numbers(data, "plastic_strain"), stress = finite_numbers(data, "flow_stress_mpa");
      const auto rate
          = data.has("rate_1_per_s") ? finite_numbers(data, "rate_1_per_s") : std::vector<double>(strain.size(), 1.);
      Table table;
      table.place = [name = data.file](const std::size_t i) { return place_of_row(name, i); };
      for (std::size_t i = 0; i < strain.size(); ++i)
        {
          if (!(rate[i] > 0))
            throw InputError(
                describe_error("the strain rate is not positive.", table.place(i), std::to_string(rate[i])));
          table.samples[rate[i]].push_back({ strain[i], stress[i], i });
        }
      if (table.samples.empty())
        throw InputError(describe_error("the table has no rows.", data.file));
      return table;
    }

    void
    Tabulated::check(const Table &table, const bool may_fall)
    {
      for (const auto &[rate, samples] : table.samples)
        {
          if (samples.size() < 2)
            throw InputError(describe_error("a flow curve needs at least two points.", table.place(samples[0].row)));
          if (samples[0].strain != 0)
            throw InputError(describe_error("the first plastic strain of a curve is not 0.",
                                            table.place(samples[0].row), std::to_string(samples[0].strain)));
          for (std::size_t i = 0; i < samples.size(); ++i)
            {
              const Sample &s = samples[i];
              if (!(s.stress > 0))
                throw InputError(
                    describe_error("the flow stress is not positive.", table.place(s.row), std::to_string(s.stress)));
              if (i == 0)
                continue;
              if (!(s.strain > samples[i - 1].strain))
                throw InputError(
                    describe_error("the plastic strain does not rise.", table.place(s.row), std::to_string(s.strain)));
              if (!may_fall && s.stress < samples[i - 1].stress)
                throw InputError(describe_error("the flow stress falls.", table.place(s.row), std::to_string(s.stress),
                                                "at least " + std::to_string(samples[i - 1].stress),
                                                "Choose `Falling stress = allowed` if it is meant."));
            }
        }
    }

    // A flow stress that falls with the rate has no stable solution.
    void
    Tabulated::check_rates(const Table &table, const std::vector<Curve> &curves)
    {
      std::size_t k = 0;
      for (const auto &[rate, samples] : table.samples)
        {
          if (k > 0)
            for (const Sample &s : samples)
              if (s.stress < curves[k - 1](s.strain).value * (1 - 1e-12))
                throw InputError(describe_error("the flow stress is lower than that of the next lower strain rate.",
                                                table.place(s.row), std::to_string(s.stress)));
          ++k;
        }
    }

    Tabulated::Tabulated(Parameters &parameters)
    {
      const bool documentation = parameters.documentation_mode();
      const bool from_file
          = parameters.choice("Source", { "list", "file" }, "Where the flow curve stands: in lists here or in a file.")
            == "file";
      const bool may_fall
          = parameters.choice("Falling stress", { "refused", "allowed" },
                              "Whether the flow stress may fall with the strain.",
                              Default{ "refused", "with a falling flow stress the result depends on the mesh" })
            == "allowed";
      Table table;
      if (!from_file || documentation)
        table = read_lists(parameters);
      else
        for (const char *entry : { "Plastic strains", "Flow stresses" })
          parameters.mark_unselected(entry);
      if (from_file || documentation)
        {
          const auto file = parameters.input_file(
              "File", "CSV file with the columns plastic_strain and flow_stress_mpa and, for several strain rates, "
                      "rate_1_per_s (at least two points for each rate). Linear in the logarithm of the rate, constant "
                      "outside the rates; beyond the last strain straight on with the last slope.");
          if (!documentation && !file.empty())
            table = read_table(file);
        }
      else
        parameters.mark_unselected("File");
      if (documentation || table.samples.empty())
        return;
      check(table, may_fall);
      for (const auto &[rate, samples] : table.samples)
        {
          curves.emplace_back(samples);
          log_rate.push_back(table.samples.size() > 1 ? std::log(rate) : 0.);
        }
      check_rates(table, curves);
    }

    HardeningLaw::FlowStress
    Tabulated::flow_stress(const double strain, const double rate) const
    {
      const double logarithm = rate > 0 ? std::log(rate) : -1e300;
      if (curves.size() == 1 || logarithm <= log_rate.front())
        {
          const auto c = curves.front()(strain);
          return { c.value, c.slope, 0. };
        }
      if (logarithm >= log_rate.back())
        {
          const auto c = curves.back()(strain);
          return { c.value, c.slope, 0. };
        }
      const auto        after = std::upper_bound(log_rate.begin(), log_rate.end(), logarithm);
      const std::size_t i     = static_cast<std::size_t>(after - log_rate.begin()) - 1;
      const double      width = log_rate[i + 1] - log_rate[i], w = (logarithm - log_rate[i]) / width;
      const auto        low = curves[i](strain), high = curves[i + 1](strain);
      return { (1 - w) * low.value + w * high.value, (1 - w) * low.slope + w * high.slope,
               (high.value - low.value) / (width * rate) };
    }
  } // namespace

  TRIBODRAW_REGISTER(HardeningLaw, Tabulated, "tabulated",
                     "Flow stress from a list or file over plastic strain and, if given, strain rate.",
                     "F. N. Fritsch, J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300-304")
} // namespace tribodraw
