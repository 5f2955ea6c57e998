#include <tribodraw/base/errors.h>

namespace tribodraw
{
  namespace
  {
    std::string
    printable(const std::string &text)
    {
      static const char digits[] = "0123456789ABCDEF";
      std::string       result;
      for (const char c : text)
        {
          const auto byte = static_cast<unsigned char>(c);
          if ((byte < 0x20 && c != '\n' && c != '\t') || byte == 0x7F)
            result += std::string("\\x") + digits[byte >> 4] + digits[byte & 15];
          else
            result += c;
        }
      return result;
    }
  } // namespace

  InputError::InputError(const std::string &text) : std::runtime_error(printable(text)) {}

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
