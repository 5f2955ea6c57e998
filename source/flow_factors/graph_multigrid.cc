#include <tribodraw/flow_factors/graph_coarsening.h>
#include <tribodraw/flow_factors/graph_multigrid.h>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <algorithm>
#include <numeric>

namespace tribodraw
{
  struct GraphMultigrid::Level
  {
    // Couplings; in each row those to earlier nodes stand first, up to `middle`
    std::vector<int>   begin, middle, column;
    std::vector<float> coupling, inverse_diagonal;
    // Interpolation
    std::vector<int>   p_begin, p_column;
    std::vector<float> p_weight;
    int                n_coarse;

    Level(const GraphMatrix &m, const GraphCoarsening &coarsening);
    int
    size() const
    {
      return static_cast<int>(inverse_diagonal.size());
    }

    template <int n>
    void
    relax(const int i, const int end, const float *rhs, float *x) const
    {
      float s[n];
      for (int r = 0; r < n; ++r)
        s[r] = rhs[i * n + r];
      for (int e = begin[i]; e < end; ++e)
        for (int r = 0; r < n; ++r)
          s[r] += coupling[e] * x[column[e] * n + r];
      for (int r = 0; r < n; ++r)
        x[i * n + r] = s[r] * inverse_diagonal[i];
    }
  };

  GraphMultigrid::Level::Level(const GraphMatrix &m, const GraphCoarsening &coarsening)
      : begin(m.begin), column(m.column.size()), coupling(m.column.size()), p_begin(coarsening.begin),
        p_column(coarsening.column), p_weight(coarsening.weight.begin(), coarsening.weight.end()),
        n_coarse(coarsening.n_coarse)
  {
    middle.reserve(m.size());
    inverse_diagonal.reserve(m.size());
    for (int i = 0; i < m.size(); ++i)
      {
        int        out  = m.begin[i];
        const auto copy = [&](const bool earlier) {
          for (int e = m.begin[i]; e < m.begin[i + 1]; ++e)
            if ((m.column[e] < i) == earlier)
              {
                column[out]     = m.column[e];
                coupling[out++] = static_cast<float>(m.coupling[e]);
              }
        };
        copy(true);
        middle.push_back(out);
        copy(false);
        const double d = m.diagonal(i);
        inverse_diagonal.push_back(d > 0 ? static_cast<float>(1 / d) : 0.f);
      }
  }

  struct GraphMultigrid::Coarsest
  {
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> ldlt;
    int                                                              n;

    // One node of each part without ground is held: doubling its diagonal entry sets it to zero.
    explicit Coarsest(const GraphMatrix &m) : n(m.size())
    {
      std::vector<int> root(n);
      std::iota(root.begin(), root.end(), 0);
      const auto find = [&root](int i) {
        while (root[i] != i)
          i = root[i] = root[root[i]];
        return i;
      };
      std::vector<Eigen::Triplet<double>> entries;
      for (int i = 0; i < n; ++i)
        for (int e = m.begin[i]; e < m.begin[i + 1]; ++e)
          {
            if (m.column[e] < i)
              entries.emplace_back(i, m.column[e], -m.coupling[e]);
            root[find(i)] = find(m.column[e]);
          }
      std::vector<double> ground(n, 0.);
      for (int i = 0; i < n; ++i)
        ground[find(i)] += m.ground[i];
      for (int i = 0; i < n; ++i)
        {
          const double d    = m.diagonal(i);
          const bool   held = root[i] == i && !(ground[i] > 0);
          entries.emplace_back(i, i, !held ? d : d > 0 ? 2 * d : 1.);
        }
      Eigen::SparseMatrix<double> matrix(n, n);
      matrix.setFromTriplets(entries.begin(), entries.end());
      ldlt.compute(matrix);
    }
  };

  GraphMultigrid::GraphMultigrid(GraphMatrix matrix, int spacing)
  {
    constexpr int    smallest        = 300; // a direct solution costs next to nothing
    constexpr double least_reduction = 0.9; // else the rest is solved directly
    while (matrix.size() > smallest)
      {
        const GraphCoarsening coarsening(matrix, spacing);
        if (coarsening.n_coarse > least_reduction * matrix.size())
          break;
        levels.push_back(std::make_unique<Level>(matrix, coarsening));
        matrix = coarsening.coarse_matrix();
        spacing *= 2;
      }
    coarsest = std::make_unique<Coarsest>(matrix);
  }

  GraphMultigrid::~GraphMultigrid() = default;

  template <int n>
  void
  GraphMultigrid::cycle_at(const std::size_t l, const float *rhs, float *x) const
  {
    using Values = Eigen::Map<Eigen::Matrix<float, Eigen::Dynamic, n, n == 1 ? Eigen::ColMajor : Eigen::RowMajor>>;
    if (l == levels.size())
      {
        const Eigen::MatrixXd b
            = Eigen::Map<const typename Values::PlainObject>(rhs, coarsest->n, n).template cast<double>();
        Values(x, coarsest->n, n) = coarsest->ldlt.solve(b).template cast<float>();
        return;
      }
    const Level       &level = *levels[l];
    std::vector<float> coarse_rhs(static_cast<std::size_t>(level.n_coarse) * n, 0.f), coarse_x(coarse_rhs.size());
    // Forward from zero: only earlier nodes count, and only later ones leave a residual.
    for (int i = 0; i < level.size(); ++i)
      level.relax<n>(i, level.middle[i], rhs, x);
    for (int i = 0; i < level.size(); ++i)
      {
        float residual[n] = {};
        for (int e = level.middle[i]; e < level.begin[i + 1]; ++e)
          for (int r = 0; r < n; ++r)
            residual[r] += level.coupling[e] * x[level.column[e] * n + r];
        for (int e = level.p_begin[i]; e < level.p_begin[i + 1]; ++e)
          for (int r = 0; r < n; ++r)
            coarse_rhs[level.p_column[e] * n + r] += level.p_weight[e] * residual[r];
      }
    cycle_at<n>(l + 1, coarse_rhs.data(), coarse_x.data());
    for (int i = 0; i < level.size(); ++i)
      for (int e = level.p_begin[i]; e < level.p_begin[i + 1]; ++e)
        for (int r = 0; r < n; ++r)
          x[i * n + r] += level.p_weight[e] * coarse_x[level.p_column[e] * n + r];
    for (int i = level.size() - 1; i >= 0; --i)
      level.relax<n>(i, level.begin[i + 1], rhs, x);
  }

  void
  GraphMultigrid::cycle(const int n, const float *rhs, float *x) const
  {
    if (n == 1)
      cycle_at<1>(0, rhs, x);
    else if (n == 2)
      cycle_at<2>(0, rhs, x);
    else
      cycle_at<4>(0, rhs, x);
  }
} // namespace tribodraw
