#ifndef tribodraw_shell_shell_h
#define tribodraw_shell_shell_h

#include <tribodraw/base/archive.h>
#include <tribodraw/base/sparse_system.h>
#include <tribodraw/material/sheet_material.h>
#include <tribodraw/shell/blank_mesh.h>

#include <memory>
#include <vector>

namespace tribodraw
{
  /// The sheet: 3-node Kirchhoff triangles (edge-smoothed membrane, discrete-Kirchhoff bending with a director at
  /// each node), total Lagrangian, large rotations and strains, plasticity through the thickness. Mesh, unknowns,
  /// sparsity and partition are deal.II's (parallel::shared::Triangulation<2,3>, FESystem(FE_SimplexP(1), 5)); the
  /// element is plain C++.
  ///
  /// Unknowns of a node: displacement x, y, z and two increments of its director (components 3, 4), in mm and rad.
  /// Positions and directors are replicated on every rank; each rank integrates its own elements.
  class Shell
  {
  public:
    static constexpr unsigned dofs_per_node = 5;

    struct AssemblyOptions
    {
      bool   tension_only    = false; ///< membrane geometric stiffness from tensile forces only (far from the solution)
      double elastic_blend   = 0;     ///< share of the elastic in the plastic tangent (far from the solution)
      bool   loading_tangent = false; ///< plastic tangent for points on the yield surface (predictor)
    };

    enum class ThicknessPoints
    {
      gauss,   ///< most exact for a given number
      lobatto, ///< with points on the surfaces, where yielding in bending begins
      halves   ///< Gauss points in each half (an even number): most exact for plastic bending and springback
    };

    enum class Membrane
    {
      edge_smoothed,  ///< metric at a side: mean of the two triangles that share it (see doc/theory/sheet.md)
      constant_strain ///< metric of the single triangle; stiff on coarse meshes, for comparison
    };

    /// @param n_thickness_points 3 to 11
    Shell(const BlankMesh &mesh, double thickness, std::shared_ptr<const SheetMaterial> material,
          unsigned n_thickness_points, ThicknessPoints kind = ThicknessPoints::gauss,
          Membrane membrane = Membrane::edge_smoothed);
    ~Shell();

    const BlankMesh &mesh() const;
    unsigned         n_nodes() const;
    unsigned         n_elements() const;
    unsigned         n_dofs() const;
    /// Global number of component 0..4 of a node (deal.II's numbering).
    unsigned dof(unsigned node, unsigned component) const;

    /// Tangent pattern; @p n_extra further unknowns couple with the displacements of all nodes.
    SparseMatrix make_matrix(unsigned n_extra = 0) const;

    /// Let component 3 of the node's director increment point along @p axis (symmetry planes, clamped edges).
    void align_director_frame(unsigned node, const Eigen::Vector3d &axis);

    // ---- trial configuration ----
    /// Add an increment (n_dofs or more entries) to the trial configuration: positions by addition, directors by
    /// rotation.
    void move(const Eigen::VectorXd &increment);
    /// Forget the trial configuration: back to the committed one.
    void revert();
    /// Save and restore the trial configuration (line search).
    struct Configuration
    {
      std::vector<Eigen::Vector3d>                position, director;
      std::vector<std::array<Eigen::Vector3d, 2>> frame; ///< e_1, e_2 perpendicular to the director
    };
    const Configuration &trial() const;
    void                 set_trial(const Configuration &configuration);
    const Configuration &committed() const;

    /// Internal forces of the trial configuration, from the committed history; sums over ranks.
    /// Adds the tangent of this rank's elements to @p tangent if given (not summed over ranks).
    /// Returns false if a material point did not converge or an element is inverted.
    /// In that case neither the forces nor the tangent are of use.
    /// @param internal_force resized to n_dofs (plus the matrix's extra unknowns if a tangent is given) and overwritten
    bool assemble(double time_increment, const AssemblyOptions &options, Eigen::VectorXd &internal_force,
                  SparseMatrix *tangent);
    /// Equivalent plastic strain at the nodes as node_eps_p(), after the last assemble(), which must have succeeded with
    /// the trial configuration. Collective.
    std::vector<double> trial_node_eps_p() const;
    /// Accept the trial configuration and the history of the last assemble(), which must have succeeded with this
    /// configuration; updates thickness and energies. Collective.
    void commit();

    // ---- results of the committed state (whole, same on each rank) ----
    const std::vector<double> &node_thickness() const; ///< current, area-averaged [mm]
    const std::vector<double> &node_eps_p() const;     ///< equivalent plastic strain, thickness mean, area-averaged
    /// Reference and current area that belongs to each node [mm^2]; of the trial configuration for current.
    const std::vector<double> &node_reference_area() const;
    std::vector<double>        node_current_area() const;
    /// Unit normals (+z side) of the trial configuration, area-averaged.
    std::vector<Eigen::Vector3d> node_normals() const;
    struct ElementResults
    {
      std::vector<double> thickness, eps_p, max_eps_p; ///< eps_p: thickness mean; max over the thickness points
      std::vector<double> major_strain, minor_strain;  ///< logarithmic, mid-surface
      std::vector<double> membrane_stress_xx, membrane_stress_yy,
          membrane_stress_xy; ///< thickness mean, log. stress [MPa]
    };
    ElementResults element_results() const; ///< collective
    /// Layers of integration points, each the mean over the three points of an element in its plane; for programs that go
    /// on with the sheet.
    struct Layers
    {
      std::vector<double> place; ///< of the layers in the thickness, -1 to 1
      /// Per element and layer (layers fastest): xx, yy, zz, xy, yz, zx along the axes of the model.
      std::vector<std::array<double, 6>> stress, strain; ///< Cauchy stress [MPa]; logarithmic strain
      std::vector<double>                eps_p;
    };
    Layers layers() const;                 ///< collective
    double         elastic_energy() const;  ///< [N mm]
    double         plastic_work() const;    ///< accumulated [N mm]

    void save(Archive &archive) const; ///< collective
    void load(const Archive &archive); ///< committed and trial state from a checkpoint; any number of ranks

  private:
    struct Implementation;
    std::unique_ptr<Implementation> data;
  };
} // namespace tribodraw

#endif
