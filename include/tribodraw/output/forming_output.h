#ifndef tribodraw_output_forming_output_h
#define tribodraw_output_forming_output_h

#include <tribodraw/base/csv.h>
#include <tribodraw/forming/simulation.h>
#include <tribodraw/material/forming_limit.h>
#include <tribodraw/output/tool_surfaces.h>
#include <tribodraw/output/vtu.h>

#include <filesystem>
#include <memory>

namespace tribodraw
{
  /// history.csv (one row per committed increment with punch travel or closing), energy.csv (work, energies, force
  /// balance, solver figures) and, with tools beyond die, punch and blank holder, tools.csv (force on and place of every
  /// tool). Forces and energies are of the full part; of a horizontal force on a tool it is the modelled part's.
  class HistoryWriter : public Observer
  {
  public:
    explicit HistoryWriter(std::filesystem::path folder);
    void committed(const Simulation &simulation, const IncrementRecord &record) override;
    void finished(const Simulation &simulation, bool converged) override;
    void save(Archive &archive) const override;
    void load(const Archive &archive) override;

  private:
    void write(const Simulation &simulation) const;

    std::filesystem::path folder;
    CsvTable              history, energy, tools;
  };

  /// solution.pvd with VTU steps every so much punch travel, tools.pvd with the tools at the same times and view.py, which
  /// opens both in ParaView; at the end nodes_final.csv, elements_final.csv and flc.csv, from which the figures are drawn.
  class FieldWriter : public Observer
  {
  public:
    /// @param travel_between punch travel between two VTU steps [mm]; the first and the last state are always written
    FieldWriter(std::filesystem::path folder, double travel_between, std::shared_ptr<const FormingLimitCurve> limit);
    void committed(const Simulation &simulation, const IncrementRecord &record) override;
    void unloading(const Simulation &simulation) override;
    /// not_converged.vtu: the last state with the unbalanced force of each node.
    void failed(const Simulation &simulation, const std::vector<Eigen::Vector3d> &unbalanced) override;
    void finished(const Simulation &simulation, bool converged) override;
    void save(Archive &archive) const override;
    void load(const Archive &archive) override;

  private:
    SurfaceFields collect(const Simulation &simulation) const;
    void          write_step(const Simulation &simulation, const IncrementRecord &record);
    void          write_collections() const;
    void          write_final(const Simulation &simulation) const;
    void          remove_steps_from(unsigned first) const;

    std::filesystem::path                    folder;
    double                                   travel_between, next_travel = 0;
    unsigned                                 step = 0;
    std::shared_ptr<const FormingLimitCurve> limit;
    ToolSurfaces                             tools;
    std::vector<Eigen::Vector3d>             previous_position, velocity, in_the_tools; // the last: before the unloading
    double                                   previous_time = 0, last_written = -1;
    std::vector<double>                      times; // of the steps written
  };

  /// results.csv: the figures one runs the case for, at the end; edge_profile.csv: the outer edge of the blank over the angle
  /// about the punch axis, from which ears are read.
  class ResultsWriter : public Observer
  {
  public:
    explicit ResultsWriter(std::filesystem::path folder);
    void committed(const Simulation &simulation, const IncrementRecord &record) override;
    void unloading(const Simulation &simulation) override;
    void finished(const Simulation &simulation, bool converged) override;
    void save(Archive &archive) const override;
    void load(const Archive &archive) override;

  private:
    void write_results(const Simulation &simulation, bool converged) const;
    void write_edge_profile(const Simulation &simulation) const;

    std::filesystem::path        folder;
    double                       max_force = 0, travel_at_max_force = 0, max_penetration = 0, newton_iterations = 0;
    double                       elastic_energy_in_the_tools = 0;
    std::vector<Eigen::Vector3d> in_the_tools;
  };
} // namespace tribodraw

#endif
