#ifndef tribodraw_application_sheet_test_h
#define tribodraw_application_sheet_test_h

#include <tribodraw/application/task.h>

#include <string>

namespace tribodraw
{
  /// A test of the sheet that the task `sheet` runs: a material point, a shell load case. Chosen by `Sheet test/Model`;
  /// registers itself with TRIBODRAW_REGISTER.
  ///
  /// The constructor takes Parameters& inside its own subsection `Sheet test/<Name>` and only reads. A test that needs
  /// a material reads the section `Sheet material` of the top level:
  ///   const auto scope = parameters.top_section("Sheet material");
  ///   material = std::make_shared<SheetMaterial>(SheetMaterial::read(parameters));
  class SheetTest
  {
  public:
    virtual ~SheetTest() = default;
    static const char *
    kind()
    {
      return "sheet test";
    }

    /// One sentence on what run() would do, for `--validate` and the log.
    virtual std::string describe() const = 0;

    /// Do the work and write at least `results.csv` (`quantity,value,unit`) into the output folder (rank 0 only).
    /// Throws ConvergenceError when a solver gives up, after the results so far have been written.
    virtual void run(const RunContext &context) = 0;
  };
} // namespace tribodraw

#endif
