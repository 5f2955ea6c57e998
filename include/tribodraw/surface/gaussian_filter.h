#ifndef tribodraw_surface_gaussian_filter_h
#define tribodraw_surface_gaussian_filter_h

#include <tribodraw/surface/height_map.h>

#include <memory>

namespace tribodraw
{
  /// Gaussian low-pass along one line of equidistant heights (ISO 16610-21): weights
  /// exp(-pi (x / (alpha c))^2) with alpha = sqrt(ln 2 / pi), so that a wave of length c keeps half its amplitude. The
  /// weights end at x = c, where they are 7e-7 of the centre. Lines that repeat themselves are continued; at the ends
  /// of others the weights of the existing points are scaled to the sum 1. Long kernels go through Fourier transforms.
  class LineFilter
  {
  public:
    /// @param n points of a line, @param cut_off the cut-off wavelength c in steps between points.
    LineFilter(std::size_t n, double cut_off, bool periodic);
    ~LineFilter();
    LineFilter(LineFilter &&) noexcept;

    /// Replace both lines by their low-pass (two at once, as a complex transform takes two real lines).
    void apply(double *first, double *second);

  private:
    struct Implementation;
    std::unique_ptr<Implementation> data;
  };

  /// Areal Gaussian low-pass of ISO 16610-61, separably along x and y: the S-filter of nesting index @p cut_off [mm].
  /// The L-filter is the difference between a map and its low-pass. Periodic maps stay periodic.
  void gaussian_low_pass(HeightMap &map, double cut_off);
} // namespace tribodraw

#endif
