#include "row_kernels.h"

#include <tribodraw/flow_factors/cell_coarsening.h>
#include <tribodraw/flow_factors/cell_multigrid.h>
#include <tribodraw/flow_factors/graph_multigrid.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace tribodraw
{
  namespace
  {
    // Below this part of the energy of the preconditioned residual, that of the direction is mostly round-off.
    constexpr double least_part = 1e-3;

    template <class T>
    void
    close_row(T *x, const CellLayout &layout)
    {
      x[-1]        = layout.periodic ? x[layout.nx - 1] : T(0);
      x[layout.nx] = layout.periodic ? x[0] : T(0);
    }
  } // namespace

  // The finest level of the V-cycle. Each stage of a row first completes the stage before for the row and its
  // neighbours, so that a row passes through all stages while it is in the cache.
  //
  // With an odd number of pixels, neighbours across the border of a periodic map have the same colour. Within a colour
  // all pixels are relaxed from the old values, which keeps the cycle symmetric.
  class CellMultigrid::Cycle
  {
  public:
    Cycle(const CellMultigrid &m, int n);

    AlignedArray<float>   rhs, result;
    std::array<double, 4> product{}; // of residual and result
    std::array<double, 4> energy{};  // result times matrix times result

    void run();

  private:
    enum Stage : char
    {
      untouched,
      started,
      relaxed,
      restricted,
      corrected,
      relaxed_again
    };

    const CellMultigrid               &m;
    const CellCoarsening              &coarsening;
    const CellLayout                   l;
    const int                          n; // right-hand sides
    AlignedArray<float>                e; // rows in work: what they hand on to the coarse level, then its correction
    AlignedArray<float>                zero, spare;
    AlignedArray<float>                coarse_rhs, coarse_x;
    std::array<AlignedArray<float>, 2> parity; // 1 at even pixels of a row, 1 at odd pixels
    std::vector<Stage>                 stage;
    const bool                         odd_x, odd_y;        // same colour across the border
    AlignedArray<float>                first_row, last_row; // old values of both

    int
    wrapped(const int iy) const
    {
      return CellLayout::wrapped(iy, l.ny, l.periodic);
    }
    bool
    is_odd(const int iy) const
    {
      return wrapped(iy) >= 0 && wrapped(iy) % 2 == 1;
    }
    float *
    row(AlignedArray<float> &field, const int iy, const int r)
    {
      return wrapped(iy) < 0 ? &zero[CellLayout::margin] : &field[l.row(n, wrapped(iy), r)];
    }
    // Rows are worked on in their order, except those at both ends.
    static constexpr int end_rows = 4, rows_in_work = 8;
    float *
    work_row(const int iy, const int r)
    {
      const int w = wrapped(iy);
      if (w < 0)
        return &zero[CellLayout::margin];
      const int place = w < end_rows           ? w
                        : w >= l.ny - end_rows ? w - (l.ny - 2 * end_rows)
                                               : 2 * end_rows + w % rows_in_work;
      return &e[l.row(n, place, r)];
    }
    const float *
    coefficients(const AlignedArray<float> &field, const int iy) const
    {
      return &field[l.row(1, iy, 0)];
    }
    const float *
    colour(const int iy, const int c) const
    {
      return parity[(iy + c) % 2].data();
    }
    bool
    reached(const int iy, const Stage wanted) const
    {
      return iy < 0 || stage[iy] >= wanted;
    }

    void relax(int iy, int c);
    void remember_end_rows();
    void add_border_residual(int iy, int r, float *d);
    void start(int iy);
    void finish_relaxation(int iy);
    void restrict_row(int iy);
    void restrict_values(int iy, int r);
    void correct_row(int iy);
    void relax_again(int iy);
    void finish_row(int iy);
    void add_energy_below(int iy);
  };

  CellMultigrid::Cycle::Cycle(const CellMultigrid &m_in, const int n_in)
      : m(m_in), coarsening(*m_in.coarsening), l(m_in.k.layout), n(n_in), odd_x(l.periodic && l.nx % 2 == 1),
        odd_y(l.periodic && l.ny % 2 == 1), first_row(l.stride() * n, 0.f), last_row(first_row)
  {
    for (AlignedArray<float> *field : { &rhs, &result })
      field->assign(l.size(n), 0.f);
    e.assign(l.row(n, 2 * end_rows + rows_in_work, 0) + 1, 0.f);
    for (AlignedArray<float> *values : { &zero, &spare })
      values->assign(l.stride(), 0.f);
    coarse_rhs.resize(coarsening.site.size() * n);
    coarse_x.resize(coarse_rhs.size());
    for (int i = 0; i < l.nx; ++i)
      for (const int c : { 0, 1 })
        parity[c].push_back(i % 2 == c ? 1.f : 0.f);
    stage.resize(l.ny);
  }

  void
  CellMultigrid::Cycle::relax(const int iy, const int c)
  {
    for (int r = 0; r < n; ++r)
      {
        float *x     = row(result, iy, r);
        float *below = odd_y && iy == 0 ? &last_row[l.row(n, 0, r)] : row(result, iy - 1, r);
        float *above = odd_y && iy == l.ny - 1 ? &first_row[l.row(n, 0, r)] : row(result, iy + 1, r);
        row_kernels::relax(l.nx, x, below, above, row(rhs, iy, r), coefficients(m.kx, iy), coefficients(m.ky, iy),
                           coefficients(m.ky, iy + 1), coefficients(m.inverse, iy), colour(iy, c),
                           &spare[CellLayout::margin]);
        close_row(x, l);
      }
  }

  // Keep the values of both end rows for each other, before either is relaxed.
  void
  CellMultigrid::Cycle::remember_end_rows()
  {
    if (!odd_y)
      return;
    std::copy_n(&result[l.row(n, 0, 0) - CellLayout::margin], first_row.size(), first_row.begin());
    std::copy_n(&result[l.row(n, l.ny - 1, 0) - CellLayout::margin], last_row.size(), last_row.begin());
  }

  // From zero the second colour gets residuals from its own colour across the border only.
  void
  CellMultigrid::Cycle::add_border_residual(const int iy, const int r, float *d)
  {
    const float *x = row(result, iy, r), *kx = coefficients(m.kx, iy), *second = colour(iy, 1);
    if (odd_x)
      {
        d[0] += second[0] * kx[0] * x[l.nx - 1];
        d[l.nx - 1] += second[0] * kx[l.nx] * x[0];
      }
    if (odd_y && (iy == 0 || iy == l.ny - 1))
      {
        const float *ky    = coefficients(m.ky, iy == 0 ? 0 : l.ny);
        const float *other = row(result, iy == 0 ? -1 : l.ny, r);
        for (int i = 0; i < l.nx; ++i)
          d[i] += second[i] * ky[i] * other[i];
      }
  }

  void
  CellMultigrid::Cycle::start(const int row_number)
  {
    const int iy = wrapped(row_number);
    if (reached(iy, started))
      return;
    stage[iy] = started;
    for (int r = 0; r < n; ++r)
      {
        float *x = row(result, iy, r);
        row_kernels::relax_from_zero(l.nx, x, row(rhs, iy, r), coefficients(m.inverse, iy), colour(iy, 0));
        close_row(x, l);
      }
  }

  void
  CellMultigrid::Cycle::finish_relaxation(const int row_number)
  {
    const int iy = wrapped(row_number);
    if (reached(iy, relaxed))
      return;
    for (const int j : { iy - 1, iy, iy + 1 })
      start(j);
    stage[iy] = relaxed;
    relax(iy, 1);
  }

  void
  CellMultigrid::Cycle::restrict_row(const int row_number)
  {
    const int iy = wrapped(row_number);
    if (reached(iy, restricted))
      return;
    for (const int j : { iy - 1, iy, iy + 1 })
      finish_relaxation(j);
    stage[iy] = restricted;
    if (!is_odd(iy))
      for (const int j : { iy - 1, iy + 1 })
        if (is_odd(j))
          restrict_row(j);
    for (int r = 0; r < n; ++r)
      restrict_values(iy, r);
  }

  // Residual, handed on from dropped pixels to kept ones: in odd rows from centres to edges, in even rows from both
  // in the odd rows beside, then from edges to corners. `e` of odd rows ends as what they give to even rows.
  void
  CellMultigrid::Cycle::restrict_values(const int iy, const int r)
  {
    const float *kx = coefficients(m.kx, iy), *ky = coefficients(m.ky, iy), *above = coefficients(m.ky, iy + 1),
                *weight = coefficients(coarsening.weight, iy);
    float *d = work_row(iy, r), *w = &spare[CellLayout::margin];
    row_kernels::from_neighbours(l.nx, d, row(result, iy, r), row(result, iy - 1, r), row(result, iy + 1, r), kx, ky,
                                 above, colour(iy, 0));
    add_border_residual(iy, r, d);
    if (!is_odd(iy))
      row_kernels::add_from_column(l.nx, d, is_odd(iy - 1) ? work_row(iy - 1, r) : &zero[CellLayout::margin],
                                   is_odd(iy + 1) ? work_row(iy + 1, r) : &zero[CellLayout::margin], ky, above);
    row_kernels::scale(l.nx, w, d, weight, parity[1].data());
    close_row(w, l);
    row_kernels::add_from_row(l.nx, d, w, kx);
    for (int c = coarsening.first_site[iy]; c < coarsening.first_site[iy + 1]; ++c)
      coarse_rhs[static_cast<std::size_t>(c) * n + r] = d[coarsening.site[c]];
    if (is_odd(iy))
      row_kernels::scale_and_add(l.nx, d, weight, parity[0].data(), w);
  }

  void
  CellMultigrid::Cycle::correct_row(const int row_number)
  {
    const int iy = wrapped(row_number);
    if (reached(iy, corrected))
      return;
    stage[iy] = corrected;
    if (is_odd(iy))
      for (const int j : { iy - 1, iy + 1 })
        correct_row(j);
    const float *kx = coefficients(m.kx, iy), *weight = coefficients(coarsening.weight, iy);
    for (int r = 0; r < n; ++r)
      {
        float *c = work_row(iy, r);
        std::fill(c, c + l.nx, 0.f);
        for (int s = coarsening.first_site[iy]; s < coarsening.first_site[iy + 1]; ++s)
          c[coarsening.site[s]] = coarse_x[static_cast<std::size_t>(s) * n + r];
        if (is_odd(iy))
          row_kernels::interpolate_in_column(l.nx, c, work_row(iy - 1, r), work_row(iy + 1, r), coefficients(m.ky, iy),
                                             coefficients(m.ky, iy + 1), weight);
        close_row(c, l);
        float *x = row(result, iy, r);
        row_kernels::interpolate_in_row(l.nx, c, x, kx, weight, parity[1].data(), &spare[CellLayout::margin]);
        close_row(x, l);
      }
  }

  void
  CellMultigrid::Cycle::relax_again(const int row_number)
  {
    const int iy = wrapped(row_number);
    if (reached(iy, relaxed_again))
      return;
    for (const int j : { iy - 1, iy, iy + 1 })
      correct_row(j);
    if ((iy == 0 || iy == l.ny - 1) && !reached(l.ny - 1 - iy, relaxed_again))
      remember_end_rows();
    stage[iy] = relaxed_again;
    relax(iy, 1);
  }

  void
  CellMultigrid::Cycle::finish_row(const int iy)
  {
    for (const int j : { iy - 1, iy, iy + 1 })
      relax_again(j);
    if (iy == 0)
      remember_end_rows();
    relax(iy, 0);
    for (int r = 0; r < n; ++r)
      {
        const float *x = row(result, iy, r);
        product[r] += row_kernels::dot(l.nx, row(rhs, iy, r), x);
        energy[r] += row_kernels::energy(l.periodic ? l.nx : l.nx + 1, x, x - 1, coefficients(m.kx, iy));
      }
    if (iy > 0)
      add_energy_below(iy);
  }

  // Of the faces below the row; both rows finished.
  void
  CellMultigrid::Cycle::add_energy_below(const int iy)
  {
    for (int r = 0; r < n; ++r)
      energy[r] += row_kernels::energy(l.nx, iy < l.ny ? row(result, iy, r) : &zero[CellLayout::margin],
                                       row(result, iy - 1, r), coefficients(m.ky, iy));
  }

  void
  CellMultigrid::Cycle::run()
  {
    std::fill(stage.begin(), stage.end(), untouched);
    for (AlignedArray<float> *values : { &first_row, &last_row })
      std::fill(values->begin(), values->end(), 0.f);
    for (int iy = 0; iy < l.ny; ++iy)
      restrict_row(iy);
    m.coarse->cycle(n, coarse_rhs.data(), coarse_x.data());
    product = energy = {};
    for (int iy = 0; iy < l.ny; ++iy)
      finish_row(iy);
    add_energy_below(0);
    if (!l.periodic)
      add_energy_below(l.ny);
  }

  CellMultigrid::CellMultigrid(const CellConductances &conductances)
      : k(conductances), coarsening(std::make_unique<CellCoarsening>(conductances)),
        coarse(std::make_unique<GraphMultigrid>(coarsening->coarse_matrix(), 2))
  {
    // Of the mean film: flows are of order one, what passes less is nothing, and single precision ends at 1e-38.
    constexpr double  least_conductance = 1e-30;
    const CellLayout &l                 = k.layout;
    kx.assign(l.size(1), 0.f);
    ky.assign(l.size(1) + l.stride(), 0.f);
    inverse.assign(l.size(1), 0.f);
    for (int iy = 0; iy < l.ny; ++iy)
      {
        std::copy_n(k.x_row(iy), l.nx + 1, &kx[l.row(1, iy, 0)]);
        std::copy_n(k.y_row(iy), l.nx, &ky[l.row(1, iy, 0)]);
        for (int ix = 0; ix < l.nx; ++ix)
          {
            const double sum = (k.x_row(iy)[ix] + k.x_row(iy)[ix + 1]) + (k.y_row(iy)[ix] + k.y_row(iy + 1)[ix]);
            inverse[l.row(1, iy, 0) + ix] = sum > least_conductance ? static_cast<float>(1 / sum) : 0.f;
          }
      }
    std::copy_n(k.y_row(l.ny), l.nx, &ky[l.row(1, l.ny, 0)]);
  }

  CellMultigrid::~CellMultigrid() = default;

  // Only the residual and the solution need all digits, and they must fit each other. Directions are in single
  // precision, and the lengths of the steps follow from the energy of the preconditioned residual in single precision:
  // this saves a pass through the arrays, which do not fit into the cache.
  unsigned
  CellMultigrid::solve(const int n, AlignedArray<double> &rhs, AlignedArray<double> &x,
                       const std::array<double, 4> &goal, const unsigned max_iterations) const
  {
    const CellLayout &l = k.layout;
    Cycle             cycle(*this, n);
    std::copy(rhs.begin(), rhs.end(), cycle.rhs.begin());
    AlignedArray<float>       direction(l.size(n), 0.f);
    const AlignedArray<float> zero(l.stride(), 0.f);
    const auto                direction_row = [&](const int iy, const int r) {
      const int w = CellLayout::wrapped(iy, l.ny, l.periodic);
      return w < 0 ? &zero[CellLayout::margin] : &direction[l.row(n, w, r)];
    };
    std::array<double, 4> beta{}, length{}, product{};
    std::vector<char>     directed(l.ny);
    const auto            direct = [&](const int row_number) {
      const int iy = CellLayout::wrapped(row_number, l.ny, l.periodic);
      if (iy < 0 || directed[iy])
        return;
      directed[iy] = 1;
      for (int r = 0; r < n; ++r)
        {
          float *d = &direction[l.row(n, iy, r)];
          row_kernels::direct(l.nx, d, &cycle.result[l.row(n, iy, r)], static_cast<float>(beta[r]));
          close_row(d, l);
        }
    };
    for (unsigned iteration = 1; iteration <= max_iterations; ++iteration)
      {
        cycle.run();
        for (int r = 0; r < n; ++r)
          {
            // Energy of the new direction, which is conjugate to the one before
            beta[r]       = product[r] > 0 ? cycle.product[r] / product[r] : 0.;
            double energy = cycle.energy[r] - (beta[r] > 0 ? beta[r] * cycle.product[r] / length[r] : 0.);
            if (!(energy > least_part * cycle.energy[r]))
              {
                beta[r] = 0;
                energy  = cycle.energy[r];
              }
            const double step = cycle.product[r] / energy; // not a number if nothing drives the flow
            length[r]         = std::isfinite(step) ? step : 0.;
          }
        product = cycle.product;
        std::fill(directed.begin(), directed.end(), 0);
        std::array<double, 4> square{};
        for (int iy = 0; iy < l.ny; ++iy)
          {
            for (const int j : { iy - 1, iy, iy + 1 })
              direct(j);
            for (int r = 0; r < n; ++r)
              square[r]
                  += row_kernels::step(l.nx, &x[l.row(n, iy, r)], &rhs[l.row(n, iy, r)], &cycle.rhs[l.row(n, iy, r)],
                                       direction_row(iy, r), direction_row(iy - 1, r), direction_row(iy + 1, r),
                                       k.x_row(iy), k.y_row(iy), k.y_row(iy + 1), length[r]);
          }
        bool done = true;
        for (int r = 0; r < n; ++r)
          done = done && std::sqrt(square[r]) <= goal[r];
        if (done)
          return iteration;
      }
    return max_iterations + 1;
  }
} // namespace tribodraw
