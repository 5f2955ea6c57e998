#ifndef tribodraw_output_vtu_h
#define tribodraw_output_vtu_h

#include <Eigen/Core>

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace tribodraw
{
  /// Fields on a surface of triangles in space, as they go into a VTU file. NaN marks `no value` (no contact).
  struct SurfaceFields
  {
    std::vector<Eigen::Vector3d>                        points; ///< current positions [mm]
    std::vector<std::array<unsigned, 3>>                triangles;
    std::map<std::string, std::vector<double>>          node_scalars;
    std::map<std::string, std::vector<Eigen::Vector3d>> node_vectors;
    std::map<std::string, std::vector<double>>          cell_scalars;
    std::map<std::string, std::string>                  units;     ///< of fields by name; stated in the file
    double                                              time  = 0; ///< [s]
    unsigned                                            cycle = 0;
  };

  /// Write one step with deal.II's DataOutBase: compressed, no date, each triangle with its own three points (so that
  /// fields that are constant on triangles stay so). Call on one rank with the whole surface. Throws InputError naming
  /// a field whose length does not fit.
  void write_vtu(const std::filesystem::path &file, const SurfaceFields &fields);

  /// The list of the steps of a run, `solution.pvd`. Saved after every step so that ParaView can open a running case.
  class PvdCollection
  {
  public:
    /// @param name file name relative to the folder of the collection
    void add(double time, const std::string &name);
    void save(const std::filesystem::path &file) const;

  private:
    std::vector<std::pair<double, std::string>> entries;
  };
} // namespace tribodraw

#endif
