#ifndef tribodraw_tests_surface_format_samples_h
#define tribodraw_tests_surface_format_samples_h

// Surface files written from the descriptions of the formats alone (doc/formats.md and the sources named there), byte
// by byte, without any code of the program: what the readers are tested on.

#include <tribodraw/surface/surface_reader.h>

#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

namespace format_samples
{
  /// A file and the map that must come out of it.
  struct Sample
  {
    std::string            format;  ///< for statistics
    std::string            variant; ///< for messages
    std::string            content;
    tribodraw::GivenScales given;                ///< for formats that lack them
    std::vector<double>    z;                    ///< [mm], 5 x 4, row by row upwards, NaN: missing
    double                 dx = 2e-3, dy = 3e-3; ///< [mm]
    double                 tolerance = 1e-12;    ///< relative to 1 um
  };

  // The map of all samples: 5 columns, 4 rows, heights whole multiples of 10 nm between -1 and 1 um that fit into a
  // byte and differ under every reflection and rotation. Pixels of 2 um x 3 um.
  constexpr int nx = 5, ny = 4;
  /// Height in units of 10 nm; row 0 is the one with the smallest y.
  int height(int ix, int iy);
  /// The samples with missing points lack these two.
  bool missing(int ix, int iy);
  /// The heights in mm.
  std::vector<double> expected(bool with_missing);

  template <class T>
  T
  not_a_number()
  {
    if constexpr (std::is_floating_point_v<T>)
      return std::numeric_limits<T>::quiet_NaN();
    else
      return T(0);
  }

  /// Bytes put together number by number.
  class Bytes
  {
  public:
    std::string text;

    template <class T>
    Bytes &
    little(T value)
    {
      return number(value, false);
    }
    template <class T>
    Bytes &
    big(T value)
    {
      return number(value, true);
    }
    Bytes &
    add(const std::string &bytes)
    {
      text += bytes;
      return *this;
    }
    /// Text of fixed length.
    Bytes &
    field(std::string bytes, std::size_t n, char pad = ' ')
    {
      bytes.resize(n, pad);
      text += bytes;
      return *this;
    }

  private:
    template <class T>
    Bytes &
    number(T value, bool highest_first)
    {
      char raw[sizeof(T)];
      std::memcpy(raw, &value, sizeof(T));
      const std::uint16_t probe = 1;
      char                first = 0;
      std::memcpy(&first, &probe, 1);
      const bool machine_is_little = first == 1;
      for (std::size_t i = 0; i < sizeof(T); ++i)
        text += raw[machine_is_little == highest_first ? sizeof(T) - 1 - i : i];
      return *this;
    }
  };

  std::vector<Sample> sdf_samples();
  std::vector<Sample> sur_samples();
  std::vector<Sample> x3p_samples();
  std::vector<Sample> simple_binary_samples(); ///< GSF, AL3D, NPY
  std::vector<Sample> text_samples();          ///< matrices and lists of points
  std::vector<Sample> all_samples();

  // Building blocks that hostile files are made of too.
  std::string sdf_binary(const std::string &mark, int type, bool with_missing);
  std::string sur(int bits, bool compressed, int blocks, bool special);
  struct ZipEntry
  {
    std::string name, content;
    bool        deflated = true;
  };
  std::string zip(const std::vector<ZipEntry> &entries);
  std::string deflated(const std::string &content, bool with_zlib_header);
  std::string md5(const std::string &content);
  std::string x3p_main(const std::string &cz_type, const std::string &data, const std::string &digest);
  std::string x3p_data(const std::string &cz_type, bool with_missing);
} // namespace format_samples

#endif
