#include <tribodraw/base/files.h>
#include <tribodraw/output/paraview.h>

namespace tribodraw
{
  namespace
  {
    // ParaView's own state files (.pvsm) name every setting of one version and hold absolute paths. Its Python
    // interface is kept stable.
    constexpr const char *before_the_views
        = R"(# Views of this run: in ParaView (5.9 or later) File > Load State, or as a picture `pvpython view.py picture.png`.
import math, os, sys
from paraview.simple import *

try:
    folder = os.path.dirname(os.path.abspath(__file__))
except NameError:  # `paraview --script=view.py` does not say where the script is
    folder = os.getcwd()
views = [  # title of the colour bar, field, direction to the camera
)";

    constexpr const char *after_the_views = R"(]


def cells(layout, cell, parts, split):
    """Split a cell of the layout into equal parts."""
    if parts == 1:
        return [cell]
    split(cell, parts // 2 / parts)
    return cells(layout, 2 * cell + 1, parts // 2, split) + cells(layout, 2 * cell + 2, parts - parts // 2, split)


solution = PVDReader(registrationName='solution', FileName=os.path.join(folder, 'solution.pvd'))
solution.UpdatePipeline()
tools = None
if os.path.exists(os.path.join(folder, 'tools.pvd')):
    tools = PVDReader(registrationName='tools', FileName=os.path.join(folder, 'tools.pvd'))
scene = GetAnimationScene()
scene.UpdateAnimationUsingDataTimeSteps()
scene.GoToLast()
bounds = solution.GetDataInformation().GetBounds()
centre = [0.5 * (bounds[k] + bounds[k + 1]) for k in (0, 2, 4)]
radius = 0.5 * math.dist(bounds[0::2], bounds[1::2])

layout = CreateLayout('tribodraw')
rows = max(1, round(math.sqrt(len(views) / 1.5)))
places = []
for row, cell in enumerate(cells(layout, 0, rows, layout.SplitVertical)):
    columns = len(views) // rows + (row < len(views) % rows)
    places += cells(layout, cell, columns, layout.SplitHorizontal)

drawn = []
for place, (title, field, towards_camera) in zip(places, views):
    view = CreateView('RenderView')
    layout.AssignView(place, view)
    view.UseColorPaletteForBackground = 0
    view.BackgroundColorMode = 'Single Color'
    view.Background = [1, 1, 1]
    view.OrientationAxesLabelColor = [0.2, 0.2, 0.2]
    display = Show(solution, view)
    display.Representation = 'Surface'
    display.Ambient, display.Diffuse = 0.6, 0.45  # the colours count, from below too
    ColorBy(display, ('POINTS', field))
    colours = GetColorTransferFunction(field)
    colours.ApplyPreset('Viridis (matplotlib)', True)
    colours.NanColor = [0.7, 0.7, 0.7]
    display.RescaleTransferFunctionToDataRangeOverTime()
    bar = GetScalarBar(colours, view)
    bar.Title = title
    bar.ComponentTitle = ''
    bar.TitleColor = bar.LabelColor = [0.1, 0.1, 0.1]
    bar.Orientation = 'Horizontal'
    bar.WindowLocation = 'Lower Center'
    bar.ScalarBarLength = 0.5
    bar.TitleFontSize = bar.LabelFontSize = 12
    bar.AutomaticLabelFormat = 0
    bar.LabelFormat = bar.RangeLabelFormat = '%.3g'
    display.SetScalarBarVisibility(view, True)
    # The camera is placed by the sheet alone (tools go on beyond it), a little low for the colour bar below the sheet.
    up = [0, 1, 0] if towards_camera[:2] == [0, 0] else [0, 0, 1]
    aim = [c - 0.3 * radius * u for c, u in zip(centre, up)]
    view.CameraParallelProjection = 1
    view.CameraParallelScale = 1.1 * radius
    view.CameraFocalPoint = aim
    view.CameraPosition = [a + 3 * radius * d for a, d in zip(aim, towards_camera)]
    view.CameraViewUp = up
    if tools:
        shape = Show(tools, view)
        shape.ColorArrayName = ['POINTS', '']
        shape.Representation = 'Surface'
        shape.Opacity = 0.15
        shape.DiffuseColor = shape.AmbientColor = [0.3, 0.35, 0.4]
    for other, direction in drawn:
        if direction == towards_camera:
            AddCameraLink(view, other, '%s and %s' % (field, len(drawn)))
            break
    drawn.append((view, towards_camera))

RenderAllViews()
if len(sys.argv) > 1 and sys.argv[1].endswith('.png'):
    SaveScreenshot(sys.argv[1], layout, ImageResolution=[1800, 600 * rows])
)";

    const char *
    direction(const ParaviewView::From from)
    {
      switch (from)
        {
        case ParaviewView::From::inside_above:
          return "[-1, -1.4, 1.2]";
        case ParaviewView::From::outside_below:
          return "[1, 1.4, -1.2]";
        case ParaviewView::From::above:
          return "[0, 0, 1]";
        }
      return "";
    }
  } // namespace

  void
  write_paraview_state(const std::filesystem::path &folder, const std::vector<ParaviewView> &views)
  {
    std::string text = before_the_views;
    for (const ParaviewView &view : views)
      text += "    ('" + view.title + "', '" + view.field + "', " + direction(view.from) + "),\n";
    write_file(folder / "view.py", text + after_the_views);
  }
} // namespace tribodraw
