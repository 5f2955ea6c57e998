#include <tribodraw/base/parameters.h>
#include <tribodraw/surface/surface.h>
#include <tribodraw/surface/surface_reader.h>

namespace tribodraw
{
  namespace
  {
    /// A measured map from a file of any registered format.
    class FileSurface : public SurfaceSource
    {
    public:
      explicit FileSurface(Parameters &parameters)
          : path(parameters.input_file("Path", "File with the heights. The format is recognised by the content."))
      {
        // Both entries are for formats that lack them; without a value there is nothing to assume.
        if (parameters.has("Pixel size"))
          read_pixel_size(parameters);
        if (parameters.has("Height unit"))
          read_height_unit(parameters);
      }

      HeightMap
      make() const override
      {
        return read_surface_file(path, given);
      }

    private:
      void
      read_pixel_size(Parameters &parameters)
      {
        const auto sizes
            = parameters.quantity_list("Pixel size", "um", Range::positive().usual(0.05, 20.),
                                       "Edge length of a pixel, one value or two (along x and y). Required if "
                                       "the file does not state it, otherwise not allowed.");
        if (sizes.size() > 2 && !parameters.documentation_mode())
          parameters.problem("Pixel size", std::to_string(sizes.size()) + " values are given.",
                             "one value, or two (x, y)");
        if (!sizes.empty())
          given.pixel_size = { sizes[0], sizes.size() > 1 ? sizes[1] : sizes[0] };
      }

      void
      read_height_unit(Parameters &parameters)
      {
        const std::string unit
            = parameters.text("Height unit", "Unit of the heights in the file, such as `um` or `nm`. Required if the "
                                             "file does not state it, otherwise not allowed.");
        given.height_unit = length_unit(unit);
        if (!given.height_unit && !parameters.documentation_mode())
          parameters.problem("Height unit", "not a unit of length.", "nm, um, mm, m");
      }

      std::filesystem::path path;
      GivenScales           given;
    };
  } // namespace

  TRIBODRAW_REGISTER(SurfaceSource, FileSurface, "file", "A measured surface from a file.", "")
} // namespace tribodraw
