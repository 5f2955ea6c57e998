#include <tribodraw/application/sheet_test.h>
#include <tribodraw/base/csv.h>
#include <tribodraw/base/parallel.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/material/sheet_material.h>

#include <cmath>
#include <memory>

namespace tribodraw
{
  namespace
  {
    /// The material at one point: what tensile tests of the sheet would measure.
    class MaterialPointTest : public SheetTest
    {
    public:
      explicit MaterialPointTest(Parameters &parameters)
      {
        const auto scope = parameters.top_section("Sheet material");
        material         = std::make_shared<SheetMaterial>(SheetMaterial::read(parameters));
      }

      std::string
      describe() const override
      {
        return "The sheet material at one point.";
      }

      void
      run(const RunContext &context) override
      {
        if (parallel::rank() != 0)
          return;
        CsvTable directions({ "angle_deg", "stress_ratio", "r_value" });
        CsvTable results({ "quantity", "value", "unit" });
        for (int degrees = 0; degrees <= 90; ++degrees)
          {
            const double c = std::cos(degrees * M_PI / 180), s = std::sin(degrees * M_PI / 180);
            Vector3      n;
            Matrix3      H;
            const double ratio = 1 / material->locus().evaluate({ c * c, s * s, c * s }, n, H);
            const double width = n[0] * s * s + n[1] * c * c - n[2] * c * s;
            const double R     = -width / (n[0] + n[1]);
            directions.add_row({ static_cast<double>(degrees), ratio, R });
            if (degrees % 45 == 0)
              {
                results.add_row({ "stress_ratio_" + std::to_string(degrees), ratio, std::string("1") });
                results.add_row({ "r_value_" + std::to_string(degrees), R, std::string("1") });
              }
          }
        directions.save(context.file("directions.csv"));
        results.save(context.file("results.csv"));
      }

    private:
      std::shared_ptr<const SheetMaterial> material;
    };
  } // namespace

  TRIBODRAW_REGISTER(SheetTest, MaterialPointTest, "material point",
                     "The sheet material at one point: tension in all directions.", "")
} // namespace tribodraw
