#include <tribodraw/flow_factors/graph_coarsening.h>
#include <tribodraw/flow_factors/graph_multigrid.h>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <algorithm>
#include <numeric>

namespace tribodraw
{
  template <class Real>
  struct GraphMultigrid::Level
  {
    // Couplings; in each row those to earlier nodes stand first, up to `middle`
    std::vector<int>  begin, middle, column;
    std::vector<Real> coupling, diagonal, inverse_diagonal;
    // Interpolation
    std::vector<int>  p_begin, p_column;
    std::vector<Real> p_weight;
    int               n_coarse;

    Level(const GraphMatrix &m, const GraphCoarsening &coarsening);
    int
    size() const
    {
      return static_cast<int>(inverse_diagonal.size());
    }

    template <int n>
    void
    relax(const int i, const int end, const Real *rhs, Real *x) const
    {
      Real s[n];
      for (int r = 0; r < n; ++r)
        s[r] = rhs[i * n + r];
      for (int e = begin[i]; e < end; ++e)
        for (int r = 0; r < n; ++r)
          s[r] += coupling[e] * x[column[e] * n + r];
      for (int r = 0; r < n; ++r)
        x[i * n + r] = s[r] * inverse_diagonal[i];
    }

    // Forward from zero: only earlier nodes count, and only later ones leave a residual.
    template <int n, class CoarseReal>
    void
    relax_and_restrict(const Real *rhs, Real *x, CoarseReal *coarse_rhs) const
    {
      for (int i = 0; i < size(); ++i)
        relax<n>(i, middle[i], rhs, x);
      for (int i = 0; i < size(); ++i)
        {
          Real residual[n] = {};
          for (int e = middle[i]; e < begin[i + 1]; ++e)
            for (int r = 0; r < n; ++r)
              residual[r] += coupling[e] * x[column[e] * n + r];
          for (int e = p_begin[i]; e < p_begin[i + 1]; ++e)
            for (int r = 0; r < n; ++r)
              coarse_rhs[p_column[e] * n + r] += p_weight[e] * residual[r];
        }
    }

    template <int n, class CoarseReal>
    void
    correct_and_relax(const Real *rhs, Real *x, const CoarseReal *coarse_x) const
    {
      for (int i = 0; i < size(); ++i)
        for (int e = p_begin[i]; e < p_begin[i + 1]; ++e)
          for (int r = 0; r < n; ++r)
            x[i * n + r] += p_weight[e] * static_cast<Real>(coarse_x[p_column[e] * n + r]);
      for (int i = size() - 1; i >= 0; --i)
        relax<n>(i, begin[i + 1], rhs, x);
    }

    template <int n>
    void
    subtract_image(const Real *x, Real *rhs) const
    {
      for (int i = 0; i < size(); ++i)
        {
          Real s[n];
          for (int r = 0; r < n; ++r)
            s[r] = rhs[i * n + r] - diagonal[i] * x[i * n + r];
          for (int e = begin[i]; e < begin[i + 1]; ++e)
            for (int r = 0; r < n; ++r)
              s[r] += coupling[e] * x[column[e] * n + r];
          for (int r = 0; r < n; ++r)
            rhs[i * n + r] = s[r];
        }
    }
  };

  template <class Real>
  GraphMultigrid::Level<Real>::Level(const GraphMatrix &m, const GraphCoarsening &coarsening)
      : begin(m.begin), column(m.column.size()), coupling(m.column.size()), p_begin(coarsening.begin),
        p_column(coarsening.column), p_weight(coarsening.weight.begin(), coarsening.weight.end()),
        n_coarse(coarsening.n_coarse)
  {
    middle.reserve(m.size());
    inverse_diagonal.reserve(m.size());
    diagonal.reserve(m.size());
    std::vector<int> later;
    for (int i = 0; i < m.size(); ++i)
      {
        // Without a branch, which could not be predicted: the later ones are put aside.
        int out = m.begin[i], n_later = 0;
        if (static_cast<int>(later.size()) < m.begin[i + 1] - m.begin[i])
          later.resize(m.begin[i + 1] - m.begin[i]);
        for (int e = m.begin[i]; e < m.begin[i + 1]; ++e)
          {
            const bool earlier = m.column[e] < i;
            column[out]        = m.column[e];
            coupling[out]      = static_cast<Real>(m.coupling[e]);
            later[n_later]     = e;
            out += earlier;
            n_later += !earlier;
          }
        middle.push_back(out);
        for (int e = 0; e < n_later; ++e, ++out)
          {
            column[out]   = m.column[later[e]];
            coupling[out] = static_cast<Real>(m.coupling[later[e]]);
          }
        constexpr double least_conductance = 1e-30; // below is nothing, and single precision ends at 1e-38
        const double     d                 = m.diagonal(i);
        inverse_diagonal.push_back(d > least_conductance ? static_cast<Real>(1 / d) : Real(0));
        diagonal.push_back(static_cast<Real>(d));
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
        if (!finest)
          finest = std::make_unique<Level<float>>(matrix, coarsening);
        else
          levels.push_back(std::make_unique<Level<double>>(matrix, coarsening));
        matrix = coarsening.coarse_matrix();
        spacing *= 2;
      }
    coarsest = std::make_unique<Coarsest>(matrix);
  }

  GraphMultigrid::~GraphMultigrid() = default;

  template <int n>
  void
  GraphMultigrid::solve_coarsest(const double *rhs, double *x) const
  {
    using Values            = Eigen::Matrix<double, Eigen::Dynamic, n, n == 1 ? Eigen::ColMajor : Eigen::RowMajor>;
    const Eigen::MatrixXd b = Eigen::Map<const Values>(rhs, coarsest->n, n);
    Eigen::Map<Values>(x, coarsest->n, n) = coarsest->ldlt.solve(b);
  }

  template <int n>
  void
  GraphMultigrid::cycle_at(const std::size_t l, const double *rhs, double *x) const
  {
    if (l == levels.size())
      {
        solve_coarsest<n>(rhs, x);
        return;
      }
    const Level<double> &level = *levels[l];
    std::vector<double>  coarse_rhs(static_cast<std::size_t>(level.n_coarse) * n, 0.), coarse_x(coarse_rhs.size());
    level.template relax_and_restrict<n>(rhs, x, coarse_rhs.data());
    cycle_at<n>(l + 1, coarse_rhs.data(), coarse_x.data());
    if (l + 1 < levels.size())
      {
        // W-cycle: once more for what is left
        levels[l + 1]->template subtract_image<n>(coarse_x.data(), coarse_rhs.data());
        std::vector<double> more(coarse_x.size());
        cycle_at<n>(l + 1, coarse_rhs.data(), more.data());
        for (std::size_t i = 0; i < more.size(); ++i)
          coarse_x[i] += more[i];
      }
    level.template correct_and_relax<n>(rhs, x, coarse_x.data());
  }

  template <int n>
  void
  GraphMultigrid::cycle_from_finest(const float *rhs, float *x) const
  {
    if (!finest)
      {
        const std::vector<double> b(rhs, rhs + static_cast<std::size_t>(coarsest->n) * n);
        std::vector<double>       solution(b.size());
        solve_coarsest<n>(b.data(), solution.data());
        std::copy(solution.begin(), solution.end(), x);
        return;
      }
    std::vector<double> coarse_rhs(static_cast<std::size_t>(finest->n_coarse) * n, 0.), coarse_x(coarse_rhs.size());
    finest->template relax_and_restrict<n>(rhs, x, coarse_rhs.data());
    cycle_at<n>(0, coarse_rhs.data(), coarse_x.data());
    finest->template correct_and_relax<n>(rhs, x, coarse_x.data());
  }

  void
  GraphMultigrid::cycle(const int n, const float *rhs, float *x) const
  {
    if (n == 1)
      cycle_from_finest<1>(rhs, x);
    else if (n == 2)
      cycle_from_finest<2>(rhs, x);
    else
      cycle_from_finest<4>(rhs, x);
  }
} // namespace tribodraw
