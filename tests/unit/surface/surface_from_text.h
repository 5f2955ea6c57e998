#ifndef tribodraw_tests_surface_surface_from_text_h
#define tribodraw_tests_surface_surface_from_text_h

#include <tribodraw/base/errors.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/surface/surface.h>

#include <string>

/// The surface that the parameters describe, as the program makes it.
inline tribodraw::HeightMap
make(const std::string &text)
{
  auto       parameters = tribodraw::Parameters::from_text(text);
  const auto surface    = tribodraw::read_surface(parameters);
  parameters.finish();
  return surface();
}

/// What is found wrong in the parameters; empty: nothing.
inline std::string
problems_of(const std::string &text)
{
  auto parameters = tribodraw::Parameters::from_text(text);
  tribodraw::read_surface(parameters);
  try
    {
      parameters.finish();
    }
  catch (const tribodraw::InputError &e)
    {
      return e.what();
    }
  return "";
}

#endif
