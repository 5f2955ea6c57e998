#ifndef tribodraw_output_gnuplot_h
#define tribodraw_output_gnuplot_h

#include <filesystem>
#include <string>

namespace tribodraw::gnuplot
{
  /// A temporary folder that is removed with all its files.
  class TemporaryFolder
  {
  public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder &)            = delete;
    TemporaryFolder &operator=(const TemporaryFolder &) = delete;

    const std::filesystem::path &
    path() const
    {
      return folder;
    }

  private:
    std::filesystem::path folder;
  };

  /// Text as a gnuplot string constant in which nothing is interpreted.
  std::string quote(const std::string &text);

  /// Draw `<stem>.svg` and `<stem>.png` with the same commands @p plot, which may use data files in @p folder.
  /// @param width, @p height in points of the SVG; the PNG has twice as many pixels.
  /// @return false if gnuplot is missing (warned once) or failed (warned).
  bool draw(const TemporaryFolder &folder, const std::string &plot, unsigned width, unsigned height,
            const std::filesystem::path &stem);
} // namespace tribodraw::gnuplot

#endif
