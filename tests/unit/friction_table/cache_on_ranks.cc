#include "sample_pair.h"

#include <tribodraw/base/files.h>
#include <tribodraw/base/parallel.h>

#include <gtest/gtest.h>

#include <filesystem>

using namespace tribodraw;

// All ranks get the same table, built together with the real cell problem, kept once and found again by all.
TEST(FrictionTableCache, IsSharedByAllRanks)
{
  const std::string text
      = "subsection Sheet surface\n" + test::bimodal_sheet(64) + "end\nsubsection Tool surface\n"
        + test::ground_tool(64)
        + "end\nsubsection Flattening\n"
          " set Model = Wilson-Sheu\n set Asperity half spacing = 25 um\n set Strain rate = 0.1 1/s\nend\n"
          "subsection Boundary friction\n"
          " set Model = power law\n subsection Power law\n  set c0 = 11.2 Pa^0.25\n  set m = 0.75\n end\nend\n"
          "subsection Friction table\n"
          " set Pressures = 1, 10, 50 MPa\n set Strains = 0, 0.1, 0.4\n set Cut heights = 6\nend\n"
          "subsection Sheet material\n"
          " set Young's modulus = 210 GPa\n set Poisson's ratio = 0.3\n set Yield locus = von Mises\n"
          " set Hardening = Swift\n subsection Swift\n  set Strength coefficient = 500 MPa\n"
          "  set Initial strain = 0.005\n  set Hardening exponent = 0.22\n end\nend\n";
  const auto folder
      = std::filesystem::temp_directory_path() / ("tribodraw_shared_tables_" + std::to_string(parallel::size()));
  if (parallel::rank() == 0)
    {
      std::filesystem::remove_all(folder);
      std::filesystem::create_directories(folder);
    }
  parallel::barrier();

  std::string first;
  for (const bool cached : { false, true })
    {
      Parameters           parameters = Parameters::from_text(text);
      FrictionTableBuilder builder    = FrictionTableBuilder::read(parameters);
      parameters.finish();
      const FrictionTable table = builder.load_or_build(folder);
      EXPECT_EQ(builder.was_cached(), cached);
      const std::string here = hash_text(table.to_json().dump());
      std::string       root = here;
      parallel::broadcast(root);
      EXPECT_EQ(here, root) << "rank " << parallel::rank();
      if (cached)
        {
          EXPECT_EQ(here, first);
        }
      first = here;
      // Flow factors of a gap with contact: between closed and free.
      const auto film = table.film(1e-3);
      EXPECT_GT(film.phi_p(0, 0) + film.phi_p(1, 1), 0.);
      EXPECT_LT(film.phi_p(0, 0), 1.);
      EXPECT_GT(film.phi_s(0, 0), 0.);
      parallel::barrier();
    }
  if (parallel::rank() == 0)
    std::filesystem::remove_all(folder);
}
