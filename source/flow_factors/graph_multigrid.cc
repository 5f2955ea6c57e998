#include <tribodraw/flow_factors/graph_coarsening.h>
#include <tribodraw/flow_factors/graph_multigrid.h>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>
#include <utility>

// Vectors stay inside of this file: how they are passed between differently compiled files does not matter.
#ifdef __GNUC__
#pragma GCC diagnostic ignored "-Wpsabi"
#endif

namespace tribodraw
{
  namespace
  {
    // The values of one node, in one vector register: compilers do not see by themselves that they belong together.
    template <class Real, int n>
    struct ValuesOfNode
    {
      typedef Real Type __attribute__((vector_size(n * sizeof(Real))));
    };
    template <class Real>
    struct ValuesOfNode<Real, 1>
    {
      using Type = Real;
    };
    template <class Real, int n>
    using Values = typename ValuesOfNode<Real, n>::Type;

    template <int n, class Real>
    Values<Real, n>
    values(const Real *x, const int node)
    {
      Values<Real, n> v;
      std::memcpy(&v, x + static_cast<std::size_t>(node) * n, sizeof v);
      return v;
    }
    template <int n, class Real>
    void
    set_values(Real *x, const int node, const Values<Real, n> &v)
    {
      std::memcpy(x + static_cast<std::size_t>(node) * n, &v, sizeof v);
    }
    template <class To, int n, class From>
    Values<To, n>
    converted(const Values<From, n> &v)
    {
      if constexpr (n == 1)
        return static_cast<To>(v);
      else
        return __builtin_convertvector(v, Values<To, n>);
    }
  } // namespace

  // Couplings of a row in two parts, those to earlier nodes and, from `middle`, those to later ones. Each part is
  // filled up with zeros to whole blocks: most take one block then, so that the end of the loop can be predicted.
  template <class Real>
  struct GraphMultigrid::Level
  {
    static constexpr int block = 4;

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

    // Sum of couplings times values, from entry `first` to `last`.
    template <int n>
    Values<Real, n>
    coupled(const int first, const int last, const Real *x) const
    {
      Values<Real, n> sum{};
      for (int e = first; e < last; e += block)
        {
          const Real *c = &coupling[e];
          const int  *q = &column[e];
          sum += (c[0] * values<n>(x, q[0]) + c[1] * values<n>(x, q[1]))
                 + (c[2] * values<n>(x, q[2]) + c[3] * values<n>(x, q[3]));
        }
      return sum;
    }

    template <int n>
    void
    relax(const int i, const int end, const Real *rhs, Real *x) const
    {
      set_values<n>(x, i, (values<n>(rhs, i) + coupled<n>(begin[i], end, x)) * inverse_diagonal[i]);
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
          const Values<CoarseReal, n> residual = converted<CoarseReal, n, Real>(coupled<n>(middle[i], begin[i + 1], x));
          for (int e = p_begin[i]; e < p_begin[i + 1]; ++e)
            set_values<n>(coarse_rhs, p_column[e],
                          values<n>(coarse_rhs, p_column[e]) + static_cast<CoarseReal>(p_weight[e]) * residual);
        }
    }

    template <int n, class CoarseReal>
    void
    correct_and_relax(const Real *rhs, Real *x, const CoarseReal *coarse_x) const
    {
      for (int i = 0; i < size(); ++i)
        {
          Values<Real, n> v = values<n>(x, i);
          for (int e = p_begin[i]; e < p_begin[i + 1]; ++e)
            v += p_weight[e] * converted<Real, n, CoarseReal>(values<n>(coarse_x, p_column[e]));
          set_values<n>(x, i, v);
        }
      for (int i = size() - 1; i >= 0; --i)
        relax<n>(i, begin[i + 1], rhs, x);
    }

    template <int n>
    void
    subtract_image(const Real *x, Real *rhs) const
    {
      for (int i = 0; i < size(); ++i)
        set_values<n>(rhs, i,
                      values<n>(rhs, i) - diagonal[i] * values<n>(x, i) + coupled<n>(begin[i], begin[i + 1], x));
    }
  };

  template <class Real>
  GraphMultigrid::Level<Real>::Level(const GraphMatrix &m, const GraphCoarsening &coarsening)
      : p_begin(coarsening.begin), p_column(coarsening.column),
        p_weight(coarsening.weight.begin(), coarsening.weight.end()), n_coarse(coarsening.n_coarse)
  {
    begin.reserve(m.size() + 1);
    middle.reserve(m.size());
    const auto whole_blocks = [](const int entries) { return (entries + block - 1) / block * block; };
    begin.push_back(0);
    for (int i = 0; i < m.size(); ++i)
      {
        int earlier = 0;
        for (int e = m.begin[i]; e < m.begin[i + 1]; ++e)
          earlier += m.column[e] < i;
        middle.push_back(begin[i] + whole_blocks(earlier));
        begin.push_back(middle[i] + whole_blocks(m.begin[i + 1] - m.begin[i] - earlier));
      }
    column.resize(begin.back());
    coupling.resize(begin.back());
    inverse_diagonal.reserve(m.size());
    diagonal.reserve(m.size());
    for (int i = 0; i < m.size(); ++i)
      {
        // Without a branch, which could not be predicted
        std::array<int, 2> place{ { begin[i], middle[i] } };
        for (int e = m.begin[i]; e < m.begin[i + 1]; ++e)
          {
            int &p      = place[m.column[e] > i];
            column[p]   = m.column[e];
            coupling[p] = static_cast<Real>(m.coupling[e]);
            ++p;
          }
        // What fills up refers to any node that a row has anyway.
        for (const auto &[from, to] : { std::pair(place[0], middle[i]), std::pair(place[1], begin[i + 1]) })
          for (int p = from; p < to; ++p)
            {
              column[p]   = column[p - 1];
              coupling[p] = 0;
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
    constexpr int    smallest        = 2000; // a direct solution costs less than the W-cycle from there
    constexpr double least_reduction = 0.9;  // else the rest is solved directly
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
    using Columns           = Eigen::Matrix<double, Eigen::Dynamic, n, n == 1 ? Eigen::ColMajor : Eigen::RowMajor>;
    const Eigen::MatrixXd b = Eigen::Map<const Columns>(rhs, coarsest->n, n);
    Eigen::Map<Columns>(x, coarsest->n, n) = coarsest->ldlt.solve(b);
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
