#include "fuzz/hdf5_seeds.h"
#include "fuzz/scratch_file.h"

#include <tribodraw/base/files.h>

#include <hdf5.h>

namespace
{
  constexpr hsize_t n_rows = 3;

  struct Row // without gaps, whose content would be arbitrary
  {
    double force;
    float  travel;
    char   comment[12];
  };

  /// Settings for data sets without the time of writing.
  hid_t
  timeless()
  {
    const hid_t settings = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_obj_track_times(settings, false);
    return settings;
  }

  void
  write_compound(const hid_t group, const hid_t space)
  {
    const hid_t text = H5Tcopy(H5T_C_S1), type = H5Tcreate(H5T_COMPOUND, sizeof(Row)), settings = timeless();
    H5Tset_size(text, sizeof Row::comment);
    H5Tinsert(type, "punch_travel_mm", HOFFSET(Row, travel), H5T_NATIVE_FLOAT);
    H5Tinsert(type, "punch_force_kn", HOFFSET(Row, force), H5T_NATIVE_DOUBLE);
    H5Tinsert(type, "comment", HOFFSET(Row, comment), text);
    const Row   rows[n_rows] = { { 2.5, 1, "a" }, { 4.5, 2, "b" }, { 6.5, 3, "c" } };
    const hid_t data         = H5Dcreate2(group, "curve", type, space, H5P_DEFAULT, settings, H5P_DEFAULT);
    H5Dwrite(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, rows);
    H5Dclose(data);
    H5Pclose(settings);
    H5Tclose(type);
    H5Tclose(text);
  }

  void
  write_columns(const hid_t group, const hid_t space)
  {
    const hid_t   settings       = timeless();
    const int     times[n_rows]  = { 1, 2, 3 };
    const double  forces[n_rows] = { 10, 20, 30 };
    const hsize_t chunk          = 2;
    H5Pset_chunk(settings, 1, &chunk);
    H5Pset_shuffle(settings);
    H5Pset_deflate(settings, 6);
    const hid_t time  = H5Dcreate2(group, "time_s", H5T_STD_I32BE, space, H5P_DEFAULT, settings, H5P_DEFAULT);
    const hid_t force = H5Dcreate2(group, "force_n", H5T_IEEE_F64LE, space, H5P_DEFAULT, settings, H5P_DEFAULT);
    H5Dwrite(time, H5T_NATIVE_INT, H5S_ALL, H5S_ALL, H5P_DEFAULT, times);
    H5Dwrite(force, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, forces);
    H5Dclose(time);
    H5Dclose(force);
    H5Pclose(settings);
  }

  std::string
  written(void (*write)(hid_t, hid_t), const bool newest)
  {
    const ScratchFile file("", ".h5");
    const hid_t       access = H5Pcreate(H5P_FILE_ACCESS);
    if (newest)
      H5Pset_libver_bounds(access, H5F_LIBVER_LATEST, H5F_LIBVER_LATEST);
    const hid_t h5    = H5Fcreate(file.path().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
    const hid_t group = H5Gcreate2(h5, "parts", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    const hid_t space = H5Screate_simple(1, &n_rows, nullptr);
    write(group, space);
    H5Sclose(space);
    H5Gclose(group);
    H5Fclose(h5);
    H5Pclose(access);
    return tribodraw::read_file(file.path());
  }
} // namespace

std::vector<std::string>
hdf5_seeds()
{
  return { written(write_compound, false), written(write_columns, false), written(write_compound, true),
           written(write_columns, true) };
}
