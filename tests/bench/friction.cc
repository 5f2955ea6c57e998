// CPU time of flattening and ploughing for a table of 20 pressures x 10 strains of the shipped pair (two surfaces of
// 666 x 666 pixels), for every registered ploughing law; what the laws give is printed to stderr.
#include "bench.h"

#include <tribodraw/base/parameters.h>
#include <tribodraw/boundary_friction/ploughing.h>
#include <tribodraw/friction_table/builder.h>
#include <tribodraw/material/sheet_material.h>

#include <mpi.h>

#include <cmath>

using namespace tribodraw;

namespace
{
  std::vector<std::string>
  ploughing_laws()
  {
    std::vector<std::string> names;
    for (const auto &[name, entry] : Registry<PloughingLaw>::entries())
      names.push_back("set Ploughing = " + name + "\n");
    names.push_back("set Ploughing = paraboloid\nsubsection Paraboloid\nset Depth of patches = volume\nend\n");
    return names;
  }

  void
  run()
  {
    Parameters          p          = Parameters::from_file(TRIBODRAW_SOURCE_DIR "/prm/friction_table.prm");
    auto                builder    = FrictionTableBuilder::read(p);
    const auto          scope      = p.section("Sheet material");
    const SheetMaterial material   = SheetMaterial::read(p);
    const Flattening    flattening = [&] {
      Parameters text = Parameters::from_text("set Model = Wilson-Sheu\nset Asperity half spacing = 25 um\n"
                                                    "set Strain rate = 1 1/s\n");
      return Flattening::read(text);
    }();
    std::vector<double> pressures, strains{ 0, 0.02, 0.05, 0.1, 0.2, 0.3, 0.45, 0.6, 0.75, 0.9 };
    for (unsigned int i = 0; i < 20; ++i)
      pressures.push_back(0.5 * std::pow(200., i / 19.));
    pressures[11] = 12.;

    bench::Timer                     timer;
    const HeightDistribution         heights(builder.sheet());
    std::vector<std::vector<double>> cuts;
    for (const double pressure : pressures)
      cuts.push_back(flattening.monotone_cut_heights(heights, material.hardening(), pressure, strains));
    bench::print_row("friction", "flattening, 200 points", timer.stop());

    for (const std::string &text : ploughing_laws())
      {
        Parameters entries = Parameters::from_text(
            "set Model = power law\nsubsection Power law\nset c0 = 11.2 Pa^0.25\nset m = 0.75\nend\n" + text);
        const BoundaryFriction friction = BoundaryFriction::read(entries);
        bench::Timer           ploughing_timer;
        const ToolSurface      tool(builder.tool(), friction.ploughing_directions);
        std::size_t            full = 0;
        std::fprintf(stderr,
                     "%s  P [MPa], strain: contact fraction, mu boundary = layer + ploughing, touching, patches\n",
                     text.c_str());
        for (std::size_t i = 0; i < pressures.size(); ++i)
          for (std::size_t j = 0; j < strains.size(); ++j)
            {
              const double         s = cuts[i][j], alpha = heights.contact_fraction(s);
              const SheetStrength  strength = flattening.strength(material.hardening(), strains[j]);
              const double         tau      = friction.layer_shear(pressures[i] / alpha, strength.shear_strength);
              const PlateauContact contact(builder.sheet(), tool, s + heights.mean() - 1e-9 * heights.sq());
              const auto           balance = balance_ploughing(contact, *friction.ploughing, pressures[i],
                                                               { flattening.hardness(strength), strength.shear_strength, tau });
              full += balance.full_contact;
              if ((i == 1 || i == 11 || i == 18) && (j == 0 || j == 2 || j == 4 || j == 9))
                std::fprintf(stderr, "  %5.1f %4.2f: %.3f, %.4f = %.4f + %.4f, %.3f%s, %zu\n", pressures[i], strains[j],
                             alpha, alpha * tau / pressures[i] + balance.coefficient, alpha * tau / pressures[i],
                             balance.coefficient, balance.patch_fraction, balance.full_contact ? " (all)" : "",
                             balance.n_patches);
            }
        std::fprintf(stderr, "  %zu of 200 points in full contact\n", full);
        bench::print_row("friction", "ploughing, 200 points: " + text.substr(16, text.find('\n') - 16),
                         ploughing_timer.stop());
      }
  }
} // namespace

int
main(int argc, char **argv)
{
  MPI_Init(&argc, &argv);
  run();
  MPI_Finalize();
}
