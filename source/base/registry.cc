#include <tribodraw/base/registry.h>

namespace tribodraw
{
  std::vector<ModelInfo> &
  all_registered_models()
  {
    // Function-local, because registrations run before main() in an unspecified order.
    static std::vector<ModelInfo> models;
    return models;
  }
} // namespace tribodraw
