// CPU time of the shell: what an iteration of a forming simulation pays for assembly, factorisation and solution.
// A quarter blank of 130 x 130 x 0.82 mm, 2520 triangles, 5 thickness points, material of the paper (Vegter,
// Bergstroem-van Liempt); stretched and bent so that most points flow.
#include "bench.h"
#include "unit/material/paper_material.h"

#include <tribodraw/shell/shell.h>

#include <deal.II/base/multithread_info.h>

#include <Eigen/SparseCore>
#include <Eigen/SparseLU>

#include <mpi.h>

#include <cmath>

using namespace tribodraw;

namespace
{
  constexpr unsigned n_repeat = 20;

  /// Movement of a stretching punch: 4 % membrane strain and waves of some 2 % bending strain.
  Eigen::VectorXd
  deformation(const Shell &shell, const double size)
  {
    Eigen::VectorXd u(shell.n_dofs());
    for (unsigned node = 0; node < shell.n_nodes(); ++node)
      {
        const Eigen::Vector3d &x    = shell.mesh().nodes[node];
        const double           wave = 2 * M_PI / 40;
        u[shell.dof(node, 0)]       = size * 0.04 * x.x();
        u[shell.dof(node, 1)]       = size * 0.02 * x.y();
        u[shell.dof(node, 2)]       = size * 2 * std::sin(wave * x.x()) * std::sin(wave * x.y());
        u[shell.dof(node, 3)]       = -size * 2 * wave * std::cos(wave * x.x()) * std::sin(wave * x.y());
        u[shell.dof(node, 4)]       = -size * 2 * wave * std::sin(wave * x.x()) * std::cos(wave * x.y());
      }
    return u;
  }

  void
  print(const std::string &name, bench::Measurement m, const std::optional<bench::Reference> &reference = {})
  {
    m.cpu_s /= n_repeat;
    m.wall_s /= n_repeat;
    bench::print_row("shell", name, m, reference);
  }

  void
  assembly(const std::string &locus)
  {
    Shell           shell(make_quarter_rectangle(130, 130, 35, 36), 0.82,
                          std::make_shared<SheetMaterial>(paper::sheet(locus, "Bergstroem-van Liempt")), 5);
    SparseMatrix    K = shell.make_matrix(1);
    Eigen::VectorXd force;
    const auto      step = [&](const double size) {
      shell.move(deformation(shell, size));
      if (!shell.assemble(0.02, {}, force, nullptr))
        std::fprintf(stderr, "assembly failed\n");
    };
    bench::Timer elastic;
    for (unsigned i = 0; i < n_repeat; ++i)
      shell.assemble(0.02, {}, force, &K);
    print(locus + " tangent and forces elastic", elastic.stop());
    step(0.5);
    shell.commit();
    step(0.1);
    const unsigned n_cores = dealii::MultithreadInfo::n_threads();
    for (const unsigned n_threads : { 1u, 2u })
      {
        dealii::MultithreadInfo::set_thread_limit(n_threads);
        bench::Timer tangent;
        for (unsigned i = 0; i < n_repeat; ++i)
          shell.assemble(0.02, {}, force, &K);
        print(locus + " tangent and forces plastic, " + (n_threads == 1 ? "1 thread" : "2 threads"), tangent.stop());
      }
    dealii::MultithreadInfo::set_thread_limit(n_cores);
    bench::Timer forces;
    for (unsigned i = 0; i < n_repeat; ++i)
      shell.assemble(0.02, {}, force, nullptr);
    print(locus + " forces plastic", forces.stop());
    shell.commit();
    const auto results = shell.element_results();
    double     least   = 1;
    for (const double e : results.max_eps_p)
      least = std::min(least, e);
    std::fprintf(stderr, "smallest plastic strain over the elements %g\n", least);
  }

  /// Tangent of the deformed blank on supports, as a forming step has it.
  SparseMatrix
  supported_tangent()
  {
    Shell           shell(make_quarter_rectangle(130, 130, 35, 36), 0.82,
                          std::make_shared<SheetMaterial>(paper::sheet("Vegter", "Bergstroem-van Liempt")), 5);
    SparseMatrix    K = shell.make_matrix();
    Eigen::VectorXd force;
    shell.move(deformation(shell, 0.5));
    Shell::AssemblyOptions options;
    options.tension_only = true;
    shell.assemble(0.02, options, force, &K);
    std::vector<bool> fixed(shell.n_dofs(), false);
    for (unsigned node = 0; node < shell.n_nodes(); ++node)
      for (unsigned c = 0; c < 5; ++c)
        if ((shell.mesh().on_x_plane[node] && (c == 0 || c == 3))
            || (shell.mesh().on_y_plane[node] && (c == 1 || c == 4)) || (shell.mesh().on_outer_edge[node] && c < 3))
          fixed[shell.dof(node, c)] = true;
    K.eliminate(fixed, 1e5);
    return K;
  }

  double
  eigen_lu(const SparseMatrix &K)
  {
    std::vector<Eigen::Triplet<double>> entries;
    for (int row = 0; row < K.size(); ++row)
      for (std::size_t k = K.row_start()[row]; k < K.row_start()[row + 1]; ++k)
        entries.emplace_back(row, K.columns()[k], K.values()[k]);
    Eigen::SparseMatrix<double> A(K.size(), K.size());
    A.setFromTriplets(entries.begin(), entries.end());
    Eigen::SparseLU<Eigen::SparseMatrix<double>> solver;
    solver.analyzePattern(A);
    bench::Timer timer;
    solver.factorize(A);
    return timer.stop().cpu_s;
  }

  void
  solution()
  {
    const SparseMatrix     K = supported_tangent();
    const bench::Reference reference{ "Eigen SparseLU", eigen_lu(K) };
    for (const auto symmetry : { DirectSolver::Symmetry::unsymmetric, DirectSolver::Symmetry::symmetric })
      {
        const std::string name = symmetry == DirectSolver::Symmetry::symmetric ? "LDL^T" : "LU";
        DirectSolver      solver(symmetry);
        if (!solver.factor(K)) // with the analysis
          std::fprintf(stderr, "singular\n");
        bench::Timer factor;
        for (unsigned i = 0; i < n_repeat; ++i)
          solver.factor(K);
        print(name + " factorisation", factor.stop(), reference);
        Eigen::VectorXd b = Eigen::VectorXd::Ones(K.size());
        bench::Timer    solve;
        for (unsigned i = 0; i < n_repeat; ++i)
          solver.solve(b);
        print(name + " solution", solve.stop());
      }
  }
} // namespace

int
main(int argc, char **argv)
{
  int provided;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_SERIALIZED, &provided);
  for (const char *locus : { "von Mises", "Vegter" })
    assembly(locus);
  solution();
  MPI_Finalize();
}
