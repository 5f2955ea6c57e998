#ifndef tribodraw_base_registry_h
#define tribodraw_base_registry_h

#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace tribodraw
{
  class Parameters;

  /// What the program tells of a registered model: name in parameter files,
  /// one sentence, and the publication it follows.
  struct ModelInfo
  {
    std::string kind;
    std::string name;
    std::string description;
    std::string citation;
  };

  /// All registered models of all kinds, for `tribodraw list`.
  std::vector<ModelInfo> &all_registered_models();

  /// The only factory of the house. A law registers itself at the end of its own
  /// file with TRIBODRAW_REGISTER and is created by name from a parameter file.
  /// @tparam Interface abstract base; must have `static const char *kind()`, a
  /// human-readable name of the family such as "yield locus".
  template <class Interface>
  class Registry
  {
  public:
    using Creator = std::function<std::unique_ptr<Interface>(Parameters &)>;

    struct Entry
    {
      ModelInfo info;
      Creator   create;
    };

    static std::map<std::string, Entry> &entries()
    {
      static std::map<std::string, Entry> map;
      return map;
    }

    static bool add(const std::string &name,
                    const std::string &description,
                    const std::string &citation,
                    Creator            create)
    {
      const ModelInfo info{Interface::kind(), name, description, citation};
      if (!entries().emplace(name, Entry{info, std::move(create)}).second)
        throw std::logic_error("Two models of kind '" + info.kind + "' are called '" + name + "'.");
      all_registered_models().push_back(info);
      return true;
    }
  };
} // namespace tribodraw

/// Register class @p Class (constructible from Parameters&) as a model of @p Interface.
#define TRIBODRAW_REGISTER(Interface, Class, name, description, citation)                     \
  namespace                                                                                    \
  {                                                                                            \
    [[maybe_unused]] const bool registered_##Class = ::tribodraw::Registry<Interface>::add(    \
      name, description, citation, [](::tribodraw::Parameters &parameters) {                   \
        return std::unique_ptr<Interface>(new Class(parameters));                              \
      });                                                                                      \
  }

#endif
