#include <tribodraw/base/errors.h>

namespace tribodraw
{
  std::string
  describe_error(const std::string &what,
                 const std::string &where,
                 const std::string &value,
                 const std::string &allowed,
                 const std::string &hint)
  {
    std::string text = where.empty() ? what : where + ": " + what;
    if (!value.empty())
      text += " Value: " + value + ".";
    if (!allowed.empty())
      text += " Allowed: " + allowed + ".";
    if (!hint.empty())
      text += " " + hint;
    return text;
  }
} // namespace tribodraw
