#include <tribodraw/flow_factors/cell_multigrid.h>

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <array>
#include <cmath>

namespace tribodraw
{
  namespace
  {
    using Matrix = CellMultigrid::Matrix;
    using Layout = CellMultigrid::Layout;

    // Step from one pixel to a neighbour, -1, 0 or 1, across the periodic border too.
    int
    step(const int from, const int to, const int n)
    {
      const int d = to - from;
      return d > 1 ? d - n : d < -1 ? d + n : d;
    }

    // Row of the interpolation: coarse unknowns with weights, at most four.
    struct Weights
    {
      std::array<int, 4>    to{};
      std::array<double, 4> value{};
      int                   size = 0;

      void
      add(const int coarse, const double w)
      {
        for (int k = 0; k < size; ++k)
          if (to[k] == coarse)
            {
              value[k] += w;
              return;
            }
        if (size < 4)
          {
            to[size]      = coarse;
            value[size++] = w;
          }
      }
      void
      scale(const double factor)
      {
        for (int k = 0; k < size; ++k)
          value[k] *= factor;
      }
    };

    // Interpolation of one level, pixel class by pixel class.
    class Interpolation
    {
    public:
      Interpolation(const Matrix &matrix_in, const Layout &layout_in)
          : matrix(matrix_in), layout(layout_in), rows(static_cast<std::size_t>(matrix_in.rows()))
      {
        keep_even_pixels();
        const auto class_of = [this](const int i) { return (layout.x[i] % 2) + (layout.y[i] % 2); };
        for (const int wanted : { 1, 2 }) // pixels between two kept ones, then pixels between four
          for (int i = 0; i < matrix.rows(); ++i)
            if (class_of(i) == wanted)
              wanted == 1 ? interpolate_on_edge(i) : interpolate_in_middle(i);
      }

      Matrix
      prolongation() const
      {
        std::vector<Eigen::Triplet<double>> entries;
        entries.reserve(rows.size() * 2);
        for (std::size_t i = 0; i < rows.size(); ++i)
          for (int k = 0; k < rows[i].size; ++k)
            entries.emplace_back(static_cast<int>(i), rows[i].to[k], rows[i].value[k]);
        Matrix result(matrix.rows(), static_cast<Eigen::Index>(coarse.x.size()));
        result.setFromTriplets(entries.begin(), entries.end());
        return result;
      }

      Layout coarse;

    private:
      const Matrix        &matrix;
      const Layout        &layout;
      std::vector<Weights> rows;

      void
      keep_even_pixels()
      {
        coarse.nx       = (layout.nx + 1) / 2;
        coarse.ny       = (layout.ny + 1) / 2;
        coarse.periodic = layout.periodic;
        for (std::size_t i = 0; i < rows.size(); ++i)
          if (layout.x[i] % 2 == 0 && layout.y[i] % 2 == 0)
            {
              rows[i].add(static_cast<int>(coarse.x.size()), 1.);
              coarse.x.push_back(layout.x[i] / 2);
              coarse.y.push_back(layout.y[i] / 2);
            }
      }

      // Between two kept pixels the values do not vary across the line that joins them: couplings are summed over
      // the columns (or rows) of the 3 x 3 stencil. What leads to a missing pixel is left out.
      void
      interpolate_on_edge(const int i)
      {
        const bool            along_x = layout.x[i] % 2 == 1;
        std::array<int, 3>    kept{ -1, -1, -1 };
        std::array<double, 3> coupling{};
        double                centre = 0;
        for (Matrix::InnerIterator entry(matrix, i); entry; ++entry)
          {
            const int j  = static_cast<int>(entry.col());
            const int dx = step(layout.x[i], layout.x[j], layout.nx), dy = step(layout.y[i], layout.y[j], layout.ny);
            const int d = along_x ? dx : dy, across = along_x ? dy : dx;
            coupling[d + 1] -= entry.value();
            if (d != 0 && across == 0)
              kept[d + 1] = rows[j].to[0];
          }
        centre = -coupling[1];
        for (const int side : { 0, 2 })
          if (kept[side] >= 0)
            rows[i].add(kept[side], coupling[side]);
          else
            centre -= coupling[side];
        finish(i, centre);
      }

      void
      interpolate_in_middle(const int i)
      {
        double centre = 0;
        for (Matrix::InnerIterator entry(matrix, i); entry; ++entry)
          {
            const Weights &other = rows[entry.col()];
            if (entry.col() == i || other.size == 0)
              centre += entry.value();
            else
              for (int k = 0; k < other.size; ++k)
                rows[i].add(other.to[k], -entry.value() * other.value[k]);
          }
        finish(i, centre);
      }

      // Divide by the diagonal; a pixel that hangs on dropped pixels only is left to the smoother.
      void
      finish(const int i, const double centre)
      {
        if (rows[i].size == 0 || !(centre > 0))
          rows[i].size = 0;
        else
          rows[i].scale(1 / centre);
      }
    };
  } // namespace

  struct CellMultigrid::Level
  {
    Matrix          matrix, prolongation;
    Eigen::VectorXd inverse_diagonal;

    explicit Level(Matrix m) : matrix(std::move(m)), inverse_diagonal(matrix.diagonal().cwiseInverse()) {}

    void
    relax(const int i, const Eigen::VectorXd &rhs, Eigen::VectorXd &x) const
    {
      const int    *column = matrix.innerIndexPtr();
      const double *value  = matrix.valuePtr();
      double        r      = rhs[i];
      for (int k = matrix.outerIndexPtr()[i]; k < matrix.outerIndexPtr()[i + 1]; ++k)
        r -= value[k] * x[column[k]];
      x[i] += r * inverse_diagonal[i];
    }
  };

  struct CellMultigrid::Coarsest
  {
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> ldlt;
  };

  CellMultigrid::CellMultigrid(Matrix matrix, Layout layout) : coarsest(std::make_unique<Coarsest>())
  {
    constexpr int smallest_width = 12; // a direct solution of some hundred unknowns costs next to nothing
    levels.push_back(std::make_unique<Level>(std::move(matrix)));
    while (std::min(layout.nx, layout.ny) > smallest_width)
      {
        Level              &fine = *levels.back();
        const Interpolation interpolation(fine.matrix, layout);
        fine.prolongation = interpolation.prolongation();
        if (fine.prolongation.cols() == 0)
          break;
        const Matrix restriction = fine.prolongation.transpose();
        const Matrix product     = fine.matrix * fine.prolongation;
        levels.push_back(std::make_unique<Level>(Matrix(restriction * product)));
        layout = interpolation.coarse;
      }
    coarsest->ldlt.compute(Eigen::SparseMatrix<double>(levels.back()->matrix));
  }

  CellMultigrid::~CellMultigrid() = default;

  void
  CellMultigrid::cycle(const std::size_t l, const Eigen::VectorXd &rhs, Eigen::VectorXd &x) const
  {
    if (l + 1 == levels.size())
      {
        x = coarsest->ldlt.solve(rhs);
        return;
      }
    const Level &level = *levels[l];
    const int    n     = static_cast<int>(rhs.size());
    x                  = Eigen::VectorXd::Zero(n);
    for (int i = 0; i < n; ++i)
      level.relax(i, rhs, x);
    const Eigen::VectorXd residual        = rhs - level.matrix * x;
    const Eigen::VectorXd coarse_residual = level.prolongation.transpose() * residual;
    Eigen::VectorXd       coarse_x;
    cycle(l + 1, coarse_residual, coarse_x);
    x += level.prolongation * coarse_x;
    for (int i = n - 1; i >= 0; --i)
      level.relax(i, rhs, x);
  }

  Eigen::VectorXd
  CellMultigrid::precondition(const Eigen::VectorXd &residual) const
  {
    Eigen::VectorXd x;
    cycle(0, residual, x);
    return x;
  }

  unsigned
  CellMultigrid::solve(const Eigen::VectorXd &rhs, Eigen::VectorXd &solution, const double tolerance,
                       const unsigned max_iterations) const
  {
    const Matrix &matrix     = levels.front()->matrix;
    solution                 = Eigen::VectorXd::Zero(rhs.size());
    Eigen::VectorXd residual = rhs, direction = precondition(rhs);
    double          energy = residual.dot(direction);
    const double    goal   = tolerance * tolerance * energy;
    if (!(energy > 0))
      return 1; // nothing drives the flow
    for (unsigned iteration = 1; iteration <= max_iterations; ++iteration)
      {
        const Eigen::VectorXd image = matrix * direction;
        const double          alpha = energy / direction.dot(image);
        solution += alpha * direction;
        residual -= alpha * image;
        const Eigen::VectorXd z    = precondition(residual);
        const double          next = residual.dot(z);
        if (!std::isfinite(next))
          return 0;
        if (next <= goal)
          return iteration;
        direction = z + (next / energy) * direction;
        energy    = next;
      }
    return 0;
  }
} // namespace tribodraw
