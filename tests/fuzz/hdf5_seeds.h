#ifndef tribodraw_tests_fuzz_hdf5_seeds_h
#define tribodraw_tests_fuzz_hdf5_seeds_h

#include <string>
#include <vector>

/// HDF5 files with a table of three rows: a compound data set in a group, in the oldest and in the newest layout of the format, and
/// compressed columns in a group. The same bytes each time.
std::vector<std::string> hdf5_seeds();

#endif
