#include <tribodraw/flow_factors/graph_coarsening.h>

#include <algorithm>
#include <numeric>

namespace tribodraw
{
  namespace
  {
    // Part of its couplings that a dropped node must have to kept nodes, directly or by way of dropped neighbours, and
    // the least ratio of the neighbour's onward coupling to that between the two for this way to count. Of 0.1 to 0.5
    // and 0.02 to 0.3 these take the fewest iterations, from no contact to percolation.
    constexpr double least_seen = 0.5, least_onward = 0.3;

    // Collects rows of a sparse matrix, adding up entries of the same column. No branch depends on whether an entry is
    // new: that could not be predicted.
    class RowCollector
    {
    public:
      RowCollector(std::vector<int> &column_in, std::vector<double> &value_in, const int n_columns)
          : column(column_in), value(value_in), place(n_columns, -1)
      {
      }
      /// Next row; makes room for @p most entries.
      void
      start(const int most)
      {
        first = end;
        if (column.size() < static_cast<std::size_t>(end) + most)
          {
            const std::size_t size = column.size() + column.size() / 2 + most;
            column.resize(size);
            value.resize(size);
          }
      }
      void
      add(const int to, const double v)
      {
        const int  old   = place[to];
        const bool found = old >= first;
        const int  p     = found ? old : end;
        place[to]        = p;
        column[p]        = to;
        value[p]         = (found ? value[p] : 0.) + v;
        end += !found;
      }
      int
      size() const
      {
        return end;
      }
      void
      finish()
      {
        column.resize(end);
        value.resize(end);
      }

    private:
      std::vector<int>    &column;
      std::vector<double> &value;
      std::vector<int>     place; // last entry of each column
      int                  first = 0, end = 0;
    };
  } // namespace

  void
  GraphMatrix::assemble(const std::vector<Triplet> &triplets)
  {
    const int n = size();
    begin.assign(n + 1, 0);
    for (const Triplet &t : triplets)
      {
        ++begin[t.a + 1];
        ++begin[t.b + 1];
      }
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    column.resize(begin[n]);
    coupling.resize(begin[n]);
    std::vector<int> place(begin.begin(), begin.end() - 1);
    for (const Triplet &t : triplets)
      {
        column[place[t.a]]     = t.b;
        coupling[place[t.a]++] = t.coupling;
        column[place[t.b]]     = t.a;
        coupling[place[t.b]++] = t.coupling;
      }
    // Join entries of the same pair; `place` becomes the entry of each column in the present row.
    std::fill(place.begin(), place.end(), -1);
    int out = 0;
    for (int i = 0; i < n; ++i)
      {
        const int first = begin[i], start = out;
        begin[i] = start;
        for (int e = first; e < begin[i + 1]; ++e)
          if (place[column[e]] >= start)
            coupling[place[column[e]]] += coupling[e];
          else
            {
              place[column[e]] = out;
              column[out]      = column[e];
              coupling[out++]  = coupling[e];
            }
      }
    begin[n] = out;
    column.resize(out);
    coupling.resize(out);
  }

  GraphCoarsening::GraphCoarsening(const GraphMatrix &matrix, const int spacing)
      : m(matrix), coarse_number(matrix.size(), -1), seen_from(matrix.size(), -1)
  {
    select(spacing);
    interpolate();
  }

  void
  GraphCoarsening::mark_kept_neighbours(const int i)
  {
    for (int e = m.begin[i]; e < m.begin[i + 1]; ++e)
      if (kept(m.column[e]) && m.coupling[e] > 0)
        seen_from[m.column[e]] = i;
  }

  // Coupling of j to the kept neighbours of i.
  double
  GraphCoarsening::coupling_to_marked(const int i, const int j) const
  {
    double sum = 0;
    for (int e = m.begin[j]; e < m.begin[j + 1]; ++e)
      sum += seen_from[m.column[e]] == i && m.coupling[e] > 0 ? m.coupling[e] : 0.;
    return sum;
  }

  bool
  GraphCoarsening::well_seen(const int i)
  {
    double all = m.ground[i], seen = m.ground[i];
    for (int e = m.begin[i]; e < m.begin[i + 1]; ++e)
      if (m.coupling[e] > 0)
        {
          all += m.coupling[e];
          if (kept(m.column[e]))
            seen += m.coupling[e];
        }
    const double needed = least_seen * all;
    if (seen >= needed)
      return true;
    mark_kept_neighbours(i);
    for (int e = m.begin[i]; e < m.begin[i + 1] && seen < needed; ++e)
      if (!kept(m.column[e]) && m.coupling[e] > 0 && coupling_to_marked(i, m.column[e]) >= least_onward * m.coupling[e])
        seen += m.coupling[e];
    return seen >= needed;
  }

  void
  GraphCoarsening::select(const int spacing)
  {
    for (int i = 0; i < m.size(); ++i)
      if (m.x[i] % (2 * spacing) == 0 && m.y[i] % (2 * spacing) == 0 && m.begin[i] < m.begin[i + 1])
        coarse_number[i] = 0;
    for (int i = 0; i < m.size(); ++i)
      if (!kept(i) && !well_seen(i))
        coarse_number[i] = 0;
    for (int &c : coarse_number)
      if (c >= 0)
        c = n_coarse++;
    std::fill(seen_from.begin(), seen_from.end(), -1);
  }

  void
  GraphCoarsening::interpolate()
  {
    begin.reserve(m.size() + 1);
    column.reserve(2 * m.size());
    weight.reserve(2 * m.size());
    std::vector<int> place(m.size()); // entry of each kept node in the present row
    const auto       add = [this](const int node, const double w) {
      column.push_back(coarse_number[node]);
      weight.push_back(w);
    };
    for (int i = 0; i < m.size(); ++i)
      {
        const std::size_t start = column.size();
        begin.push_back(static_cast<int>(start));
        if (kept(i))
          {
            add(i, 1.);
            continue;
          }
        mark_kept_neighbours(i);
        for (int e = m.begin[i]; e < m.begin[i + 1]; ++e)
          if (kept(m.column[e]) && m.coupling[e] > 0)
            {
              place[m.column[e]] = static_cast<int>(column.size());
              add(m.column[e], m.coupling[e]);
            }
        for (int e = m.begin[i]; e < m.begin[i + 1] && column.size() > start; ++e)
          {
            const int j = m.column[e];
            if (kept(j) || !(m.coupling[e] > 0))
              continue;
            const double onward = coupling_to_marked(i, j);
            if (!(onward >= least_onward * m.coupling[e]))
              continue; // follows i
            for (int f = m.begin[j]; f < m.begin[j + 1]; ++f)
              if (seen_from[m.column[f]] == i && m.coupling[f] > 0)
                weight[place[m.column[f]]] += m.coupling[e] * m.coupling[f] / onward;
          }
        const double sum
            = std::accumulate(weight.begin() + static_cast<std::ptrdiff_t>(start), weight.end(), m.ground[i]);
        for (std::size_t e = start; e < weight.size(); ++e)
          weight[e] /= sum;
      }
    begin.push_back(static_cast<int>(column.size()));
  }

  GraphCoarsening::Rows
  GraphCoarsening::transposed() const
  {
    Rows t;
    t.begin.assign(n_coarse + 1, 0);
    t.column.resize(column.size());
    t.value.resize(column.size());
    for (const int q : column)
      ++t.begin[q + 1];
    std::partial_sum(t.begin.begin(), t.begin.end(), t.begin.begin());
    std::vector<int> next(t.begin.begin(), t.begin.end() - 1);
    for (int i = 0; i < m.size(); ++i)
      for (int e = begin[i]; e < begin[i + 1]; ++e)
        {
          t.column[next[column[e]]]  = i;
          t.value[next[column[e]]++] = weight[e];
        }
    return t;
  }

  // Matrix times interpolation.
  GraphCoarsening::Rows
  GraphCoarsening::image() const
  {
    Rows a;
    a.begin.reserve(m.size() + 1);
    a.begin.push_back(0);
    a.column.resize(m.column.size());
    a.value.resize(m.column.size());
    RowCollector row(a.column, a.value, n_coarse);
    for (int i = 0; i < m.size(); ++i)
      {
        int most = begin[i + 1] - begin[i];
        for (int e = m.begin[i]; e < m.begin[i + 1]; ++e)
          most += begin[m.column[e] + 1] - begin[m.column[e]];
        row.start(most + 1);
        const auto add = [&](const int j, const double factor) {
          for (int e = begin[j]; e < begin[j + 1]; ++e)
            row.add(column[e], factor * weight[e]);
        };
        add(i, m.diagonal(i));
        for (int e = m.begin[i]; e < m.begin[i + 1]; ++e)
          add(m.column[e], -m.coupling[e]);
        a.begin.push_back(row.size());
      }
    row.finish();
    return a;
  }

  // Ground of the coarse nodes: image of ones, from differences of the row sums of the interpolation. They are one
  // except near the ground and where nothing is kept.
  void
  GraphCoarsening::set_ground(GraphMatrix &coarse, const Rows &transposed) const
  {
    std::vector<double> sum(m.size(), 1.), leak(m.size(), 0.);
    for (int i = 0; i < m.size(); ++i)
      if (m.ground[i] != 0 || begin[i] == begin[i + 1])
        {
          sum[i] = 0;
          for (int e = begin[i]; e < begin[i + 1]; ++e)
            sum[i] += weight[e];
        }
    for (int i = 0; i < m.size(); ++i)
      {
        leak[i] = m.ground[i] * sum[i];
        for (int e = m.begin[i]; e < m.begin[i + 1]; ++e)
          leak[i] += m.coupling[e] * (sum[i] - sum[m.column[e]]);
      }
    for (int q = 0; q < n_coarse; ++q)
      for (int e = transposed.begin[q]; e < transposed.begin[q + 1]; ++e)
        coarse.ground[q] += transposed.value[e] * leak[transposed.column[e]];
  }

  GraphMatrix
  GraphCoarsening::coarse_matrix() const
  {
    const Rows  t = transposed(), a = image();
    GraphMatrix coarse;
    coarse.ground.assign(n_coarse, 0.);
    coarse.x.resize(n_coarse);
    coarse.y.resize(n_coarse);
    for (int i = 0; i < m.size(); ++i)
      if (kept(i))
        {
          coarse.x[coarse_number[i]] = m.x[i];
          coarse.y[coarse_number[i]] = m.y[i];
        }
    set_ground(coarse, t);
    coarse.begin.push_back(0);
    coarse.column.resize(9 * static_cast<std::size_t>(n_coarse));
    coarse.coupling.resize(9 * static_cast<std::size_t>(n_coarse));
    RowCollector row(coarse.column, coarse.coupling, n_coarse);
    for (int q = 0; q < n_coarse; ++q)
      {
        int most = 1;
        for (int f = t.begin[q]; f < t.begin[q + 1]; ++f)
          most += a.begin[t.column[f] + 1] - a.begin[t.column[f]];
        row.start(most);
        for (int f = t.begin[q]; f < t.begin[q + 1]; ++f)
          for (int e = a.begin[t.column[f]]; e < a.begin[t.column[f] + 1]; ++e)
            if (a.column[e] != q)
              row.add(a.column[e], -t.value[f] * a.value[e]);
        coarse.begin.push_back(row.size());
      }
    row.finish();
    return coarse;
  }
} // namespace tribodraw
