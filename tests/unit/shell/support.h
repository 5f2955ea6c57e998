#ifndef tests_unit_shell_support_h
#define tests_unit_shell_support_h

#include <tribodraw/base/parallel.h>
#include <tribodraw/shell/shell.h>

#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

/// Materials and a bare Newton iteration for the tests of the shell.
namespace shell_test
{
  using namespace tribodraw;

  /// Flow stress initial (1 + strain / reference)^exponent.
  class PowerHardening : public HardeningLaw
  {
  public:
    PowerHardening(double initial_stress, double reference_strain, double hardening_exponent)
        : initial(initial_stress), reference(reference_strain), exponent(hardening_exponent)
    {
    }
    FlowStress
    flow_stress(double strain, double) const override
    {
      const double base = 1 + strain / reference;
      return { initial * std::pow(base, exponent), initial * exponent / reference * std::pow(base, exponent - 1), 0. };
    }

  private:
    double initial, reference, exponent;
  };

  /// von Mises in plane stress: sigma^2 = xx^2 - xx yy + yy^2 + 3 xy^2.
  class MisesLocus : public YieldLocus
  {
  public:
    double
    equivalent_stress(const Vector3 &s) const override
    {
      return std::sqrt(s.dot(matrix() * s));
    }
    double
    evaluate(const Vector3 &s, Vector3 &gradient, Matrix3 &hessian) const override
    {
      const double value = equivalent_stress(s);
      gradient           = matrix() * s / value;
      hessian            = (matrix() - gradient * gradient.transpose()) / value;
      return value;
    }

  private:
    static Matrix3
    matrix()
    {
      Matrix3 P;
      P << 1, -0.5, 0, -0.5, 1, 0, 0, 0, 3;
      return P;
    }
  };

  inline std::shared_ptr<const SheetMaterial>
  plastic_material(double E, double nu, double initial, double reference, double exponent)
  {
    return std::make_shared<SheetMaterial>(E, nu, std::make_shared<MisesLocus>(),
                                           std::make_shared<PowerHardening>(initial, reference, exponent));
  }

  /// Never yields.
  inline std::shared_ptr<const SheetMaterial>
  elastic_material(double E, double nu)
  {
    return plastic_material(E, nu, 1e6 * E, 1, 0);
  }

  /// A grid over [0, lx] x [0, ly] in the plane z = 0.
  inline BlankMesh
  rectangle(double lx, double ly, unsigned n_x, unsigned n_y)
  {
    std::vector<Eigen::Vector3d> points;
    for (unsigned j = 0; j <= n_y; ++j)
      for (unsigned i = 0; i <= n_x; ++i)
        points.emplace_back(lx * i / n_x, ly * j / n_y, 0.);
    return make_mapped_grid(n_x, n_y, points);
  }

  /// The same with inner nodes out of place by up to a quarter of the spacing.
  inline BlankMesh
  distorted_rectangle(double lx, double ly, unsigned n_x, unsigned n_y)
  {
    BlankMesh mesh = rectangle(lx, ly, n_x, n_y);
    for (std::size_t node = 0; node < mesh.nodes.size(); ++node)
      if (!mesh.on_outer_edge[node])
        {
          mesh.nodes[node].x() += 0.25 * lx / n_x * std::sin(7. * static_cast<double>(node));
          mesh.nodes[node].y() += 0.25 * ly / n_y * std::cos(11. * static_cast<double>(node));
        }
    return mesh;
  }

  /// Equilibrium of a shell under dead loads with some unknowns held.
  class StaticProblem
  {
  public:
    explicit StaticProblem(Shell &the_shell)
        : fixed(the_shell.n_dofs(), false), shell(the_shell), K(the_shell.make_matrix()),
          solver(DirectSolver::Symmetry::symmetric)
    {
    }

    std::vector<bool> fixed;
    void
    fix(unsigned node, std::initializer_list<unsigned> components)
    {
      for (const unsigned c : components)
        fixed[shell.dof(node, c)] = true;
    }

    /// Tangent of the trial configuration, without and with the supports.
    const SparseMatrix &
    tangent(bool supported)
    {
      assemble(true);
      if (supported)
        K.eliminate(fixed, parallel::rank() == 0 ? 1. : 0.);
      return K;
    }

    /// Internal minus external forces of the trial configuration.
    Eigen::VectorXd
    residual(const Eigen::VectorXd &load)
    {
      assemble(false);
      return force - load;
    }

    /// Solution of the linear problem at the trial configuration.
    Eigen::VectorXd
    solve_linear(Eigen::VectorXd load)
    {
      tangent(true);
      return solve_eliminated(load);
    }

    /// Newton iteration from the trial configuration; the norms of the residual.
    /// @param jump prescribed increments of the fixed unknowns, applied with the tangent of the first iteration
    std::vector<double>
    solve(const Eigen::VectorXd &load, double tolerance, const Eigen::VectorXd *jump = nullptr)
    {
      std::vector<double> norms;
      for (unsigned iteration = 0; iteration < 30; ++iteration)
        {
          // Committed points lie on the yield surface, by round-off on this side or that: the movement of the supports
          // needs the tangent of those that will flow, or it gathers in elements that happen to be soft.
          assemble(true, iteration == 0 && jump);
          reaction                   = force - load;
          Eigen::VectorXd unbalanced = reaction;
          const bool      moving     = iteration == 0 && jump;
          if (moving)
            unbalanced += global_product(*jump);
          clear_fixed(unbalanced);
          norms.push_back(unbalanced.norm());
          if (!moving && norms.back() < tolerance)
            return norms;
          K.eliminate(fixed, parallel::rank() == 0 ? 1. : 0.);
          Eigen::VectorXd step = solve_eliminated(-unbalanced);
          if (moving)
            step += *jump;
          shell.move(step);
        }
      throw std::runtime_error("Newton iteration of the test did not converge.");
    }

    /// Internal minus external forces of the last iteration: reactions at fixed unknowns.
    Eigen::VectorXd reaction;

    Eigen::VectorXd
    global_product(const Eigen::VectorXd &x) const
    {
      const Eigen::VectorXd part = K.multiply(x);
      std::vector<double>   sum(part.data(), part.data() + part.size());
      parallel::sum(sum);
      return Eigen::Map<Eigen::VectorXd>(sum.data(), part.size());
    }

  private:
    Shell          &shell;
    SparseMatrix    K;
    DirectSolver    solver;
    Eigen::VectorXd force;

    void
    assemble(bool with_tangent, bool predictor = false)
    {
      K.set_zero();
      Shell::AssemblyOptions options;
      options.loading_tangent = predictor;
      if (!shell.assemble(1., options, force, with_tangent ? &K : nullptr))
        throw std::runtime_error("Assembly failed.");
    }
    void
    clear_fixed(Eigen::VectorXd &v) const
    {
      for (std::size_t i = 0; i < fixed.size(); ++i)
        if (fixed[i])
          v[static_cast<Eigen::Index>(i)] = 0;
    }
    Eigen::VectorXd
    solve_eliminated(Eigen::VectorXd b)
    {
      clear_fixed(b);
      if (!solver.factor(K))
        throw std::runtime_error("Singular tangent.");
      solver.solve(b);
      return b;
    }
  };
} // namespace shell_test

#endif
