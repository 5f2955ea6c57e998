#include <tribodraw/flow_factors/cell_coarsening.h>

#include <algorithm>
#include <array>

namespace tribodraw
{
  CellCoarsening::CellCoarsening(const CellConductances &conductances) : k(conductances)
  {
    choose_sites();
  }

  void
  CellCoarsening::choose_sites()
  {
    // An edge whose conductance to its corners is below this part of that to its other neighbours is kept. 0.1 to 0.6
    // take the same number of iterations.
    constexpr double  weak    = 0.25;
    constexpr double  largest = 1e30; // of single precision, with room
    const CellLayout &l       = k.layout;
    weight.assign(l.size(1), 0.f);
    for (int iy = 0; iy < l.ny; ++iy)
      {
        first_site.push_back(static_cast<int>(site.size()));
        const double *x = k.x_row(iy), *y = k.y_row(iy), *above = k.y_row(iy + 1);
        float        *w = &weight[l.row(1, iy, 0)];
        for (int ix = 0; ix < l.nx; ++ix)
          {
            const double along_x = x[ix] + x[ix + 1], along_y = y[ix] + above[ix];
            if (!(along_x + along_y > 0))
              continue;
            const bool odd_x = ix % 2 == 1, odd_y = iy % 2 == 1;
            if (odd_x && odd_y)
              {
                w[ix] = static_cast<float>(std::min(1 / (along_x + along_y), largest));
                continue;
              }
            const double along = odd_x ? along_x : along_y, across = odd_x ? along_y : along_x;
            if ((odd_x || odd_y) && along >= weak * across)
              w[ix] = static_cast<float>(std::min(1 / along, largest));
            else
              site.push_back(ix);
          }
      }
    first_site.push_back(static_cast<int>(site.size()));
  }

  // The Galerkin matrix from energies: each face contributes c (a - b)^2 with the interpolated values a and b. Centres
  // are eliminated first, which leaves conductances between the edges around them.
  class CellCoarsening::Assembler
  {
  public:
    explicit Assembler(const CellCoarsening &c_in);
    GraphMatrix matrix();

  private:
    // A value as a mean of at most two kept ones; none: the fixed pressure outside
    struct End
    {
      std::array<int, 2>    node{};
      std::array<double, 2> share{};
      int                   size = 0;

      void
      add(const int to, const double s)
      {
        node[size]    = to;
        share[size++] = s;
      }
    };

    // Couplings of a corner to those right, above, right above and left above
    enum Direction
    {
      right,
      up,
      right_up,
      left_up
    };
    struct Slots
    {
      std::array<double, 4> coupling{};
      std::array<int, 4>    to{ { -1, -1, -1, -1 } };
    };

    const CellCoarsening             &c;
    const CellConductances           &k;
    const CellLayout                  l;
    std::vector<int>                  number; // of the kept pixels, by pixel; -1: not kept
    GraphMatrix                       m;
    std::vector<Slots>                slots;
    std::vector<GraphMatrix::Triplet> triplets;

    int
    node(const int ix, const int iy) const
    {
      return ix < 0 || iy < 0 ? -1 : number[static_cast<std::size_t>(iy) * l.nx + ix];
    }
    int
    next_x(const int ix) const
    {
      return CellLayout::wrapped(ix + 1, l.nx, l.periodic);
    }
    int
    next_y(const int iy) const
    {
      return CellLayout::wrapped(iy + 1, l.ny, l.periodic);
    }
    void
    couple(const int from, const int to, const Direction d, const double coupling)
    {
      if (coupling != 0)
        {
          slots[from].coupling[d] += coupling;
          slots[from].to[d] = to;
        }
    }
    End  end_at(int ix, int iy) const;
    void join(const End &a, const End &b, double coupling);
    void add_star(int ix, int iy);
    void add_general_star(int ix, int iy, const std::array<double, 4> &conductance);
    void add_edge(int ix, int iy);
    void add_border();
  };

  CellCoarsening::Assembler::Assembler(const CellCoarsening &c_in)
      : c(c_in), k(c_in.k), l(c_in.k.layout), number(static_cast<std::size_t>(l.nx) * l.ny, -1), slots(c.site.size())
  {
    m.ground.assign(c.site.size(), 0.);
    m.x = c.site;
    m.y.resize(c.site.size());
    for (int iy = 0; iy < l.ny; ++iy)
      for (int s = c.first_site[iy]; s < c.first_site[iy + 1]; ++s)
        {
          m.y[s]                                                  = iy;
          number[static_cast<std::size_t>(iy) * l.nx + c.site[s]] = s;
        }
  }

  CellCoarsening::Assembler::End
  CellCoarsening::Assembler::end_at(const int ix, const int iy) const
  {
    End end;
    if (node(ix, iy) >= 0)
      {
        end.add(node(ix, iy), 1.);
        return end;
      }
    const bool   along_x = ix % 2 == 1;
    const double below   = along_x ? k.x_row(iy)[ix] : k.y_row(iy)[ix],
                 above   = along_x ? k.x_row(iy)[ix + 1] : k.y_row(iy + 1)[ix];
    const int first      = along_x ? node(ix - 1, iy) : node(ix, iy - 1),
              second     = along_x ? node(next_x(ix), iy) : node(ix, next_y(iy));
    if (below > 0 && first >= 0)
      end.add(first, below / (below + above));
    if (above > 0 && second >= 0)
      end.add(second, above / (below + above));
    return end;
  }

  void
  CellCoarsening::Assembler::join(const End &a, const End &b, const double coupling)
  {
    std::array<int, 4>    to{};
    std::array<double, 4> share{};
    int                   size = 0;
    double                sum  = 0;
    const auto            add  = [&](const int t, const double s) {
      sum += s;
      for (int i = 0; i < size; ++i)
        if (to[i] == t)
          {
            share[i] += s;
            return;
          }
      to[size]      = t;
      share[size++] = s;
    };
    for (int i = 0; i < a.size; ++i)
      add(a.node[i], a.share[i]);
    for (int i = 0; i < b.size; ++i)
      add(b.node[i], -b.share[i]);
    for (int i = 0; i < size; ++i)
      {
        for (int j = 0; j < i; ++j)
          if (share[i] * share[j] != 0)
            triplets.push_back({ to[i], to[j], -coupling * share[i] * share[j] });
        if (!l.periodic) // else the shares of both ends sum to one
          m.ground[to[i]] += coupling * share[i] * sum;
      }
  }

  void
  CellCoarsening::Assembler::add_general_star(const int ix, const int iy, const std::array<double, 4> &conductance)
  {
    const double             sum = (conductance[0] + conductance[1]) + (conductance[2] + conductance[3]);
    const std::array<int, 4> jx{ { ix - 1, next_x(ix), ix, ix } }, jy{ { iy, iy, iy - 1, next_y(iy) } };
    std::array<End, 4>       end;
    for (int a = 0; a < 4; ++a)
      if (conductance[a] > 0)
        {
          if (jx[a] >= 0 && jy[a] >= 0)
            end[a] = end_at(jx[a], jy[a]);
          for (int b = 0; b < a; ++b)
            if (conductance[b] > 0)
              join(end[a], end[b], conductance[a] * conductance[b] / sum);
        }
  }

  // Centre (ix, iy) and the edges w, e, s, n around it.
  void
  CellCoarsening::Assembler::add_star(const int ix, const int iy)
  {
    const double w = k.x_row(iy)[ix], e = k.x_row(iy)[ix + 1], s = k.y_row(iy)[ix], n = k.y_row(iy + 1)[ix];
    const double sum = (w + e) + (s + n);
    if (!(sum > 0))
      return;
    const int  jx = next_x(ix), jy = next_y(iy);
    const bool inside = (jx >= 0 || e == 0) && (jy >= 0 || n == 0);
    const bool plain  = inside && !(w > 0 && node(ix - 1, iy) >= 0) && !(e > 0 && node(jx, iy) >= 0)
                       && !(s > 0 && node(ix, iy - 1) >= 0) && !(n > 0 && node(ix, jy) >= 0);
    if (!plain)
      {
        add_general_star(ix, iy, { { w, e, s, n } });
        return;
      }
    // All edges are means of the corners; shares of the lower and the upper corner
    const auto share = [](const double conductance, const double of, const double other) {
      return conductance > 0 && of > 0 ? of / (of + other) : 0.;
    };
    const double *below = k.y_row(iy), *above = k.y_row(iy + 1), *south = k.x_row(iy - 1);
    const double *north = jy >= 0 ? k.x_row(jy) : south;
    const int     east  = jx >= 0 ? jx : ix;
    const double  w_s = share(w, below[ix - 1], above[ix - 1]), w_n = share(w, above[ix - 1], below[ix - 1]),
                 e_s = share(e, below[east], above[east]), e_n = share(e, above[east], below[east]),
                 s_w = share(s, south[ix], south[ix + 1]), s_e = share(s, south[ix + 1], south[ix]),
                 n_w = share(n, north[ix], north[ix + 1]), n_e = share(n, north[ix + 1], north[ix]);
    // Elimination of the centre: conductances between the edges
    const double we = w * e / sum, ws = w * s / sum, wn = w * n / sum, es = e * s / sum, en = e * n / sum,
                 sn = s * n / sum;
    // Differences of two edges in the corner that they share
    const double sw = w_s - s_w, nw = w_n - n_w, se = e_s - s_e, ne = e_n - n_e;
    const int    i_sw = node(ix - 1, iy - 1), i_se = node(jx, iy - 1), i_nw = node(ix - 1, jy), i_ne = node(jx, jy);
    couple(i_sw, i_se, right, we * w_s * e_s + ws * sw * s_e + es * s_w * se - sn * s_w * s_e);
    couple(i_sw, i_nw, up, sn * s_w * n_w - we * w_s * w_n - ws * sw * w_n - wn * w_s * nw);
    couple(i_sw, i_ne, right_up, we * w_s * e_n + wn * w_s * n_e + es * s_w * e_n + sn * s_w * n_e);
    couple(i_se, i_nw, left_up, we * e_s * w_n + ws * s_e * w_n + en * e_s * n_w + sn * s_e * n_w);
    couple(i_se, i_ne, up, sn * s_e * n_e - we * e_s * e_n - es * se * e_n - en * e_s * ne);
    couple(i_nw, i_ne, right, we * w_n * e_n + wn * nw * n_e + en * n_w * ne - sn * n_w * n_e);
  }

  // Two conductances in series, or a node between them.
  void
  CellCoarsening::Assembler::add_edge(const int ix, const int iy)
  {
    const bool   along_x = ix % 2 == 1;
    const double below   = along_x ? k.x_row(iy)[ix] : k.y_row(iy)[ix],
                 above   = along_x ? k.x_row(iy)[ix + 1] : k.y_row(iy + 1)[ix];
    const int first = along_x ? node(ix - 1, iy) : node(ix, iy - 1), here = node(ix, iy),
              second = along_x ? node(next_x(ix), iy) : node(ix, next_y(iy));
    if (here >= 0)
      {
        if (below > 0)
          triplets.push_back({ here, first, below });
        if (above > 0 && second >= 0)
          triplets.push_back({ here, second, above });
        else
          m.ground[here] += above;
      }
    else if (below > 0 && above > 0)
      {
        const double series = below * above / (below + above);
        if (second >= 0)
          couple(first, second, along_x ? right : up, series);
        else
          m.ground[first] += series;
      }
  }

  // Where an odd number of pixels makes two even rows or columns meet, and fixed pressures beside pixels other than
  // those above edges and centres, which have been treated.
  void
  CellCoarsening::Assembler::add_border()
  {
    const auto face = [this](const int ix, const int iy, const int jx, const int jy, const double conductance) {
      if (conductance > 0)
        join(end_at(ix, iy), jx < 0 ? End() : end_at(jx, jy), conductance);
    };
    for (int iy = 0; iy < l.ny; ++iy)
      if (!l.periodic)
        face(0, iy, -1, -1, k.x_row(iy)[0]);
      else if (l.nx % 2 == 1)
        face(0, iy, l.nx - 1, iy, k.x_row(iy)[0]);
    for (int ix = 0; ix < l.nx; ++ix)
      if (!l.periodic)
        face(ix, 0, -1, -1, k.y_row(0)[ix]);
      else if (l.ny % 2 == 1)
        face(ix, 0, ix, l.ny - 1, k.y_row(0)[ix]);
    if (l.periodic)
      return;
    if (l.nx % 2 == 1)
      for (int iy = 0; iy < l.ny; ++iy)
        face(l.nx - 1, iy, -1, -1, k.x_row(iy)[l.nx]);
    if (l.ny % 2 == 1)
      for (int ix = 0; ix < l.nx; ++ix)
        face(ix, l.ny - 1, -1, -1, k.y_row(l.ny)[ix]);
  }

  GraphMatrix
  CellCoarsening::Assembler::matrix()
  {
    for (int iy = 0; iy < l.ny; ++iy)
      for (int ix = (iy + 1) % 2; ix < l.nx; ix += 2)
        add_edge(ix, iy);
    for (int iy = 1; iy < l.ny; iy += 2)
      for (int ix = 1; ix < l.nx; ix += 2)
        add_star(ix, iy);
    add_border();
    triplets.reserve(triplets.size() + 4 * slots.size());
    for (std::size_t i = 0; i < slots.size(); ++i)
      for (int d = 0; d < 4; ++d)
        if (slots[i].coupling[d] != 0)
          triplets.push_back({ static_cast<int>(i), slots[i].to[d], slots[i].coupling[d] });
    slots.clear();
    slots.shrink_to_fit();
    m.assemble(triplets);
    return std::move(m);
  }

  GraphMatrix
  CellCoarsening::coarse_matrix() const
  {
    return Assembler(*this).matrix();
  }
} // namespace tribodraw
