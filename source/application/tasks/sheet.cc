#include <tribodraw/application/sheet_test.h>
#include <tribodraw/application/task.h>
#include <tribodraw/base/log.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/base/timing.h>

#include <memory>

namespace tribodraw
{
  namespace
  {
    /// Tests of the sheet apart from a forming process.
    class SheetTask : public Task
    {
    public:
      explicit SheetTask(Parameters &parameters)
      {
        const auto scope = parameters.section("Sheet test");
        test             = parameters.model<SheetTest>("Model", "What is done with the sheet.");
      }

      std::string
      describe() const override
      {
        return test->describe();
      }

      void
      run(const RunContext &context) override
      {
        const timing::Scope scope("sheet/test");
        test->run(context);
      }

    private:
      std::unique_ptr<SheetTest> test;
    };
  } // namespace

  TRIBODRAW_REGISTER(Task, SheetTask, "sheet",
                     "Test the sheet alone: the material at a point, or a shell under a prescribed load.", "")
} // namespace tribodraw
