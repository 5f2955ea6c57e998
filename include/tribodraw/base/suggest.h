#ifndef tribodraw_base_suggest_h
#define tribodraw_base_suggest_h

#include <string>
#include <vector>

namespace tribodraw
{
  /// The candidate nearest to a mistyped word (edit distance, case ignored), or an empty text if none is near.
  std::string nearest(const std::string &word, const std::vector<std::string> &candidates);
} // namespace tribodraw

#endif
