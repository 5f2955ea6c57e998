#include <tribodraw/base/csv.h>
#include <tribodraw/base/errors.h>
#include <tribodraw/base/log.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/base/table.h>
#include <tribodraw/base/units.h>
#include <tribodraw/flattening/height_distribution.h>
#include <tribodraw/flow_factors/flow_factors.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tribodraw
{
  namespace
  {
    constexpr const char *components[] = { "_xx", "_xy", "_yx", "_yy" };

    class TableOfFactors : public FlowFactorModel
    {
    public:
      explicit TableOfFactors(Parameters &parameters)
      {
        const auto file = parameters.input_file(
            "File",
            "CSV with the columns `h_avg_over_sq`, `phi_p_xx` ... `phi_p_yy` and `phi_s_xx` ... `phi_s_yy`, as task "
            "`flow factors` writes it; others are ignored. Linear between the rows. Above the last one the pressure "
            "factor approaches 1 with the square of the mean gap and the shear factor 0 with its inverse, below the "
            "first one both go to zero with the mean gap.");
        if (!parameters.documentation_mode() && !file.empty())
          read(read_csv(file));
      }

      std::vector<FlowFactors>
      compute(const HeightMap &sheet, const HeightMap &tool, const double sq_reference,
              const std::vector<double> &cut_heights, const std::function<void(double)> &progress) const override
      {
        HeightMap sum = sheet;
        for (std::size_t i = 0; i < tool.z.size(); ++i)
          sum.z[i] += tool.z[i];
        const HeightDistribution distribution(sum);
        std::vector<FlowFactors> results;
        bool                     outside = false;
        for (const double cut_height : cut_heights)
          {
            FlowFactors f;
            f.cut_height       = cut_height;
            f.h_avg            = distribution.mean_gap(cut_height);
            f.contact_fraction = distribution.contact_fraction(cut_height);
            if (sq_reference > 0)
              outside |= look_up(f.h_avg / sq_reference, f);
            results.push_back(f);
          }
        if (outside)
          log::info("Flow factors: the table ends at h_avg/Sq " + units::number(separation.points.front()) + " and "
                    + units::number(separation.points.back()) + "; it is continued beyond.");
        if (progress)
          progress(1.);
        return results;
      }

      std::string
      fingerprint() const override
      {
        std::string text = "table of factors 1";
        for (std::size_t row = 0; row < separation.points.size(); ++row)
          {
            text += "; " + units::number(separation.points[row]);
            for (const auto *factor : { &phi_p, &phi_s })
              for (const auto &component : *factor)
                text += " " + units::number(component[row]);
          }
        return text;
      }

    private:
      Axis                               separation;
      std::array<std::vector<double>, 4> phi_p, phi_s;

      void
      read(const CsvData &data)
      {
        separation.points = data.numbers("h_avg_over_sq");
        std::vector<std::size_t> order(separation.points.size());
        std::iota(order.begin(), order.end(), std::size_t(0));
        std::sort(order.begin(), order.end(), [&](const std::size_t a, const std::size_t b) {
          return separation.points[a] < separation.points[b];
        });
        const auto sorted = [&order](const std::vector<double> &column) {
          std::vector<double> result;
          for (const std::size_t row : order)
            result.push_back(column[row]);
          return result;
        };
        separation.points = sorted(separation.points);
        separation.scale  = AxisScale::logarithmic; // demands positive values
        if (separation.points.size() < 2)
          throw InputError(describe_error("A table of flow factors needs at least two rows", data.file));
        separation.check("h_avg_over_sq in " + data.file);
        separation.scale = AxisScale::linear;
        for (std::size_t k = 0; k < 4; ++k)
          {
            phi_p[k] = sorted(data.numbers(std::string("phi_p") + components[k]));
            phi_s[k] = sorted(data.numbers(std::string("phi_s") + components[k]));
            for (const double value : phi_p[k])
              if (!std::isfinite(value) || (k % 3 == 0 && value < 0))
                throw InputError(describe_error("A pressure factor is not possible",
                                                data.file + ", column phi_p" + components[k], units::number(value),
                                                k % 3 == 0 ? "not negative, finite" : "finite"));
            for (const double value : phi_s[k])
              if (!std::isfinite(value))
                throw InputError(describe_error("A shear factor is not a number",
                                                data.file + ", column phi_s" + components[k], units::number(value)));
          }
      }

      // True if the table had to be continued.
      bool
      look_up(const double h, FlowFactors &f) const
      {
        const Axis::Location at   = separation.locate(h);
        const double         last = separation.points.back(), first = separation.points.front();
        const double         shrink_p = h > last ? std::pow(last / h, 2) : 1., shrink_s = h > last ? last / h : 1.;
        const double         closing = h < first ? h / first : 1.;
        for (std::size_t k = 0; k < 4; ++k)
          {
            const auto value = [&](const std::vector<double> &column) {
              return (1 - at.weight) * column[at.cell] + at.weight * column[at.cell + 1];
            };
            const double limit = k % 3 == 0 ? 1. : 0.;
            f.phi_p[k]         = (limit + (value(phi_p[k]) - limit) * shrink_p) * closing;
            f.phi_s[k]         = value(phi_s[k]) * shrink_s * closing;
          }
        return h > last || h < first;
      }
    };
  } // namespace

  TRIBODRAW_REGISTER(FlowFactorModel, TableOfFactors, "table", "Factors over the mean gap from a file", "")
} // namespace tribodraw
