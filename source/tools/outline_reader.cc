#include <tribodraw/base/parameters.h>
#include <tribodraw/tools/outline_reader.h>

namespace tribodraw
{
  namespace
  {
    // Wide enough for a micro part and for a car's side panel; catches metres and micrometres.
    const Range usual_length = Range::positive().usual(0.1, 5000);

    struct Values
    {
      std::vector<double> outline;
      double              edge_radius;
      double              clearance = 0;
    };

    Values
    read_values(Parameters &parameters, const OutlineFormat &format, const bool has_clearance)
    {
      const bool faultless = !parameters.has_problems();
      bool       complete  = parameters.has("Edge radius") && (!has_clearance || parameters.has("Clearance"));
      Values     values, example;
      for (const auto &entry : format.entries)
        {
          values.outline.push_back(parameters.quantity(entry.name, "mm", usual_length, entry.documentation));
          example.outline.push_back(entry.example);
          complete = complete && parameters.has(entry.name);
        }
      values.edge_radius
          = parameters.quantity("Edge radius", "mm", usual_length,
                                has_clearance ? "Radius of the die's edge, over which the sheet is drawn."
                                              : "Radius between the punch's face and its wall.");
      example.edge_radius = format.example_edge_radius;
      if (has_clearance)
        values.clearance = parameters.quantity(
            "Clearance", "mm", Range::non_negative().usual(0, 50),
            "Distance by which the opening lies outside of the outline above. Give the punch's outline and the "
            "gap between punch and die; or the opening's own outline and 0 mm.");
      // A missing or unreadable entry is one problem of the file. That the outline made with a stand-in value is
      // not valid would be a misleading second one.
      const bool readable = complete && !(faultless && parameters.has_problems()) && !parameters.documentation_mode();
      return readable ? values : example;
    }
  } // namespace

  OutlineFormat
  circle_format()
  {
    return { { { "Diameter", "Diameter of the circle.", 100 } },
             [](const std::vector<double> &v) { return std::make_unique<CircleOutline>(v[0] / 2); },
             5 };
  }

  OutlineFormat
  strip_format()
  {
    return { { { "Width", "Width in x, along the strip; the tool is endless in y.", 50 } },
             [](const std::vector<double> &v) { return std::make_unique<StripOutline>(v[0] / 2); },
             5 };
  }

  OutlineFormat
  rounded_rectangle_format()
  {
    return { { { "Width in x", "Width of the rectangle in the rolling direction.", 100 },
               { "Width in y", "Width of the rectangle across the rolling direction.", 100 },
               { "Corner radius", "Radius of the corners seen from above.", 10 } },
             [](const std::vector<double> &v) {
               return std::make_unique<RoundedRectangleOutline>(v[0] / 2, v[1] / 2, v[2]);
             },
             5 };
  }

  OutlineFormat
  cross_format()
  {
    return { { { "Arm reach", "Distance from the centre to the end of an arm.", 100 },
               { "Half arm width", "Half the width of an arm.", 40 },
               { "Convex corner radius", "Radius of the outer corners of the arms seen from above.", 20 },
               { "Fillet radius", "Radius of the re-entrant corners between the arms seen from above.", 20 } },
             [](const std::vector<double> &v) { return std::make_unique<CrossOutline>(v[0], v[1], v[2], v[3]); },
             5 };
  }

  std::unique_ptr<Outline>
  read_outline(Parameters &parameters)
  {
    const std::vector<std::pair<std::string, OutlineFormat>> formats = { { "Circle", circle_format() },
                                                                         { "Rectangle", rounded_rectangle_format() },
                                                                         { "Cross", cross_format() },
                                                                         { "Strip", strip_format() } };
    std::vector<std::string>                                 names;
    for (const auto &[name, format] : formats)
      names.push_back(name);
    const std::string chosen = parameters.choice(
        "Outline", names, "The line along which the tool runs, seen from above; its subsection follows.");
    std::unique_ptr<Outline> outline;
    for (const auto &[name, format] : formats)
      if (name != chosen && !parameters.documentation_mode())
        parameters.mark_unselected(name);
      else
        {
          const auto          scope     = parameters.section(name);
          const bool          faultless = !parameters.has_problems();
          std::vector<double> values, example;
          for (const auto &entry : format.entries)
            {
              values.push_back(parameters.quantity(entry.name, "mm", usual_length, entry.documentation));
              example.push_back(entry.example);
            }
          const bool readable = faultless && !parameters.has_problems() && !parameters.documentation_mode();
          if (!outline)
            outline = format.make(readable ? values : example);
        }
    return outline ? std::move(outline) : circle_format().make({ 100 });
  }

  DrawingDie
  read_die(Parameters &parameters, const OutlineFormat &format)
  {
    const Values values = read_values(parameters, format, true);
    return DrawingDie(format.make(values.outline)->offset(values.clearance), values.edge_radius);
  }

  DrawingPunch
  read_punch(Parameters &parameters, const OutlineFormat &format)
  {
    const Values values = read_values(parameters, format, false);
    return DrawingPunch(format.make(values.outline), values.edge_radius);
  }
} // namespace tribodraw
