// Entry point of every test program: starts MPI, because any module may use it, and runs GoogleTest.
#include <tribodraw/base/leaks.h>

#include <gtest/gtest.h>
#include <mpi.h>

int
main(int argc, char **argv)
{
  // Threads of deal.II never call MPI; MPI_THREAD_SERIALIZED is what deal.II itself asks for.
  int provided;
  {
    const tribodraw::leaks::Ignored of_mpi;
    MPI_Init_thread(&argc, &argv, MPI_THREAD_SERIALIZED, &provided);
  }
  ::testing::InitGoogleTest(&argc, argv);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank != 0)
    delete ::testing::UnitTest::GetInstance()->listeners().Release(
      ::testing::UnitTest::GetInstance()->listeners().default_result_printer());
  int failed = RUN_ALL_TESTS(), any = 0;
  MPI_Allreduce(&failed, &any, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  tribodraw::leaks::check();
  MPI_Finalize();
  return any;
}
