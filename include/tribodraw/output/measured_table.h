#ifndef tribodraw_output_measured_table_h
#define tribodraw_output_measured_table_h

#include <string>
#include <vector>

namespace tribodraw
{
  /// Columns of numbers from a measurement or another program.
  struct MeasuredTable
  {
    struct Column
    {
      std::string         name; ///< with its unit at the end, as in `punch_force_kn`
      std::vector<double> values;
    };
    std::vector<Column> columns; ///< all of the same length
    std::string         source;  ///< for messages

    /// Throws InputError naming the known columns if there is none of that name.
    const Column &column(const std::string &name) const;
  };

  /// Read a CSV file with one header line, or a table of an HDF5 file (`.h5`, `.hdf5`): a one-dimensional data set of a
  /// compound type with named members, or a group of one-dimensional data sets of the same length. Where in the file stands
  /// after a colon, `force.h5:/part 7/curve`; without it the only table of the file is taken. Members and data sets that
  /// hold no numbers are passed over. Cells of a CSV file that are empty become NaN.
  /// Throws InputError naming file and place for anything that does not fit.
  MeasuredTable read_measured_table(const std::string &path);

  namespace hdf5
  {
    bool          is_hdf5_path(const std::string &path);
    MeasuredTable read_table(const std::string &path);
  } // namespace hdf5
} // namespace tribodraw

#endif
