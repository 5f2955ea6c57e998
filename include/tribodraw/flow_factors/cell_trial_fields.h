#ifndef tribodraw_flow_factors_cell_trial_fields_h
#define tribodraw_flow_factors_cell_trial_fields_h

#include <tribodraw/flow_factors/cell_gap.h>
#include <tribodraw/flow_factors/cell_grid.h>

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace tribodraw
{
  /// Energies of trial fields, per area of the cell, by pairs of fields (order: CellTrialFields).
  struct CellEnergies
  {
    using Matrix = std::array<std::array<double, 4>, 4>;

    /// <k (g_a + grad u_a) . (g_b + grad u_b)>; not determined where both fields are shear flows.
    Matrix primal{};
    /// <(q_a - k (g_a + grad u_a)) . (q_b - k (g_b + grad u_b)) / k>: what the pair of fields misses of the exact
    /// solution
    Matrix                gap{};
    std::array<double, 4> complementary{};  ///< <q_a . q_a / k>
    std::array<double, 2> mean_flux{};      ///< <q_a . e_a> of the pressure flows
    std::array<double, 2> mean_magnitude{}; ///< <|q_a . e_a|>, to judge the round-off of mean_flux
  };

  /// Admissible fields in the gap that is constant in each pixel, for energy bounds: potentials u that are continuous
  /// and bilinear in each pixel (Q1), and fluxes q with exactly zero divergence and no flow into contact (RT0, one flux
  /// per face).
  ///
  /// Four problems of the form div(k (g + grad u)) = 0 with k = h^3 belong to one gap: pressure flows with g = e_x, e_y
  /// and shear flows with k g = -c e_x, -c e_y (CellFlow, whose flux is -k (g + grad u)). Fields are numbered in this
  /// order. Gaps count in multiples of the mean gap.
  ///
  /// Fluxes are whole multiples of a power of two, so that the balance of a pixel is free of round-off. Pixels outside
  /// conducting regions count as contact: exact, as u can follow -y there (pressure) and nothing flows in the mean.
  /// Where two open pixels meet in a corner only, between two closed ones, each has its own value there.
  class CellTrialFields
  {
  public:
    static constexpr int n_fields = 4;
    using Values                  = Eigen::Array4d; ///< of all fields
    /// Faces of a cell, and local numbers of its corners in x, then y.
    enum Face
    {
      left,
      right,
      bottom,
      top
    };

    /// @param region per cell the number of its conducting region or -1, see CellConnectivity.
    /// @param driven_axis axis whose ends have fixed pressures, on a grid that is not periodic.
    CellTrialFields(const CellGrid &grid, const CellGap &gap, const std::vector<int> &region, int driven_axis);

    static int
    pressure_field(const int axis)
    {
      return axis;
    }
    static int
    shear_field(const int axis)
    {
      return 2 + axis;
    }

    /// Start field number @p field from an approximate solution: pressure of each cell and flux over the upper face of
    /// each cell (CellFlow::Solution). Fields that are not set stay zero and have no drive.
    void start(int field, const std::vector<double> &pressure, const std::array<std::vector<double>, 2> &upper_flux);
    /// Lower the energies by @p steps of conjugate gradients on the corners: of potentials, and of circulations around
    /// each corner that add to the fluxes.
    void improve(unsigned steps);
    /// Make the fluxes balance exactly; to be called last.
    void balance();

    CellEnergies energies() const;

    /// Value of a potential at a corner of an open cell, seen from that cell [mm].
    double potential(int cell, int corner, int field) const;
    /// Flux over a face of a cell, in positive direction of its axis [mm].
    double flux(int cell, Face face, int field) const;
    bool
    open(const int cell) const
    {
      return position[cell] >= 0;
    }

  private:
    using SingleValues = Eigen::Array4f;

    const CellGrid &grid;
    const int       driven_axis;
    std::size_t     mx, my; // corners, and faces, in a row and in a column

    std::vector<int>                cells;    // open ones
    std::vector<std::array<int, 4>> corners;  // of each open cell
    std::vector<double>             k;        // of each open cell
    std::vector<double>             carried;  // of each open cell, over the mean gap
    std::vector<int>                position; // of each cell in the list of open ones, or -1
    std::vector<char>               fixed;    // by corner: value given
    std::vector<char>               closed;   // by corner: not surrounded by open cells
    std::array<bool, n_fields>      set{};

    std::vector<Values>                u;         // by corner
    std::array<std::vector<Values>, 2> face_flux; // by axis
    std::vector<int>                   tree;      // open cells, parents first
    std::vector<std::int8_t>           to_parent; // face of each cell that leads to its parent, -1: root

    std::size_t               face_index(int cell, Face face) const;
    Values                   &face_values(int cell, Face face);
    const Values             &face_values(int cell, Face face) const;
    std::size_t               corner_index(std::size_t ix, std::size_t iy) const;
    void                      number_corners();
    void                      split_corner(std::size_t ix, std::size_t iy);
    void                      mark_corners();
    void                      grow_tree();
    int                       neighbour(int cell, Face face) const;
    std::array<Values, 2>     drive(std::size_t i) const;
    std::vector<SingleValues> potential_residual() const;
    std::vector<SingleValues> circulation_residual() const;
    std::vector<SingleValues> descend(std::vector<SingleValues> residual, bool circulation, unsigned steps) const;
  };
} // namespace tribodraw

#endif
