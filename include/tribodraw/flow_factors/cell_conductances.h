#ifndef tribodraw_flow_factors_cell_conductances_h
#define tribodraw_flow_factors_cell_conductances_h

#include <tribodraw/flow_factors/aligned_array.h>

#include <cstddef>

namespace tribodraw
{
  /// Arrays over the pixels of a map, row by row, with room for one more value before and after each row. The rows of
  /// several right-hand sides lie side by side, so that they share the coefficients in the cache.
  struct CellLayout
  {
    /// Values before each row: the first pixel stands at the beginning of a cache line.
    static constexpr std::size_t margin = 16;

    int  nx = 0, ny = 0;
    bool periodic = false;

    std::size_t
    stride() const
    {
      return (margin + static_cast<std::size_t>(nx) + 1 + 15) / 16 * 16; // whole cache lines
    }
    /// First pixel of row @p iy of right-hand side @p r out of @p n.
    std::size_t
    row(const int n, const int iy, const int r) const
    {
      return (static_cast<std::size_t>(iy) * n + r) * stride() + margin;
    }
    std::size_t
    size(const int n) const
    {
      return stride() * n * ny;
    }
    /// Row or column number after a step over the end; -1 outside a map that is not periodic.
    static int
    wrapped(const int i, const int n, const bool periodic)
    {
      return i < 0 ? (periodic ? n - 1 : -1) : i < n ? i : periodic ? 0 : -1;
    }
  };

  /// The five-point system of a local Reynolds cell: conductances of the faces between pixels, 0 where nothing flows.
  ///
  /// x_row(iy)[ix] belongs to the face below pixel (ix, iy) in x, y_row(iy)[ix] to the one below it in y; the indices
  /// nx and ny are the faces at the upper ends of the map, on a periodic map the same faces as 0. On another map the
  /// faces at the ends lead to a pressure of zero.
  class CellConductances
  {
  public:
    explicit CellConductances(const CellLayout &layout_in)
        : layout(layout_in), x(layout.stride() * layout.ny, 0.), y(layout.stride() * (layout.ny + 1), 0.)
    {
    }

    const CellLayout layout;

    double *
    x_row(const int iy)
    {
      return &x[layout.row(1, iy, 0)];
    }
    double *
    y_row(const int iy)
    {
      return &y[layout.row(1, iy, 0)];
    }
    const double *
    x_row(const int iy) const
    {
      return &x[layout.row(1, iy, 0)];
    }
    const double *
    y_row(const int iy) const
    {
      return &y[layout.row(1, iy, 0)];
    }

  private:
    AlignedArray<double> x, y;
  };
} // namespace tribodraw

#endif
