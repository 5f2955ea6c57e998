#include <tribodraw/base/suggest.h>

#include <algorithm>
#include <cctype>

namespace tribodraw
{
  namespace
  {
    std::size_t edit_distance(const std::string &a, const std::string &b)
    {
      std::vector<std::size_t> row(b.size() + 1);
      for (std::size_t j = 0; j <= b.size(); ++j)
        row[j] = j;
      for (std::size_t i = 1; i <= a.size(); ++i)
        {
          std::size_t diagonal = row[0];
          row[0]               = i;
          for (std::size_t j = 1; j <= b.size(); ++j)
            {
              const bool        same = std::tolower(static_cast<unsigned char>(a[i - 1])) == std::tolower(static_cast<unsigned char>(b[j - 1]));
              const std::size_t next = std::min({row[j] + 1, row[j - 1] + 1, diagonal + (same ? 0 : 1)});
              diagonal               = row[j];
              row[j]                 = next;
            }
        }
      return row[b.size()];
    }
  } // namespace

  std::string
  nearest(const std::string &word, const std::vector<std::string> &candidates)
  {
    std::string best;
    std::size_t smallest = std::max<std::size_t>(2, word.size() / 3) + 1;
    for (const auto &candidate : candidates)
      {
        const std::size_t distance = edit_distance(word, candidate);
        if (distance < smallest)
          {
            smallest = distance;
            best     = candidate;
          }
      }
    return best;
  }
} // namespace tribodraw
