// Entry point of every test program: starts MPI, because any module may use it, and runs GoogleTest.
#include <gtest/gtest.h>
#include <mpi.h>

#if defined(__SANITIZE_ADDRESS__)
#  include <sanitizer/lsan_interface.h>
#endif

int
main(int argc, char **argv)
{
  // Threads of deal.II never call MPI; MPI_THREAD_SERIALIZED is what deal.II itself asks for.
  int provided;
#if defined(__SANITIZE_ADDRESS__)
  __lsan_disable(); // what MPI takes and what its plugins forget is not ours
#endif
  MPI_Init_thread(&argc, &argv, MPI_THREAD_SERIALIZED, &provided);
#if defined(__SANITIZE_ADDRESS__)
  __lsan_enable();
#endif
  ::testing::InitGoogleTest(&argc, argv);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank != 0)
    delete ::testing::UnitTest::GetInstance()->listeners().Release(
      ::testing::UnitTest::GetInstance()->listeners().default_result_printer());
  int failed = RUN_ALL_TESTS(), any = 0;
  MPI_Allreduce(&failed, &any, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
#if defined(__SANITIZE_ADDRESS__)
  __lsan_do_leak_check(); // now: MPI unloads its plugins, and what they keep would look lost
#endif
  MPI_Finalize();
  return any;
}
