#ifndef tribodraw_base_parameters_h
#define tribodraw_base_parameters_h

#include <tribodraw/base/registry.h>

#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tribodraw
{
  /// Allowed values of a number, in the unit in which the entry is declared.
  /// Outside [min, max] is an error. Outside [usual_min, usual_max] is an error
  /// too unless the file lists the entry under `Accept unusual values`.
  struct Range
  {
    double min          = -std::numeric_limits<double>::infinity();
    double max          = std::numeric_limits<double>::infinity();
    bool   excludes_min = false;
    double usual_min    = -std::numeric_limits<double>::infinity();
    double usual_max    = std::numeric_limits<double>::infinity();

    static Range any() { return {}; }
    static Range positive() { return {0., std::numeric_limits<double>::infinity(), true}; }
    static Range non_negative() { return {0.}; }
    static Range between(double a, double b) { return {a, b}; }

    /// The same range with the physically usual values stated.
    Range usual(double a, double b) const
    {
      Range r     = *this;
      r.usual_min = a;
      r.usual_max = b;
      return r;
    }

    std::string describe(const std::string &unit) const;
  };

  /// Default of a numerical control, written as in a parameter file (with unit), and the
  /// reason for it. Physical constants have no default.
  struct Default
  {
    std::string value;
    std::string reason;
  };

  /// One declared entry, for the documentation.
  struct EntryInfo
  {
    std::string path;          ///< `Section/Subsection/Entry`
    std::string type;          ///< number with unit, integer, choice, ...
    std::string unit;          ///< empty: dimensionless or not a number
    std::string range;         ///< allowed values in words
    std::string default_value; ///< empty and required, or the default
    bool        required = true;
    std::string documentation;
  };

  /// Strict reading of a deal.II parameter file.
  ///
  /// The file is scanned once into (path, value, line). Code then asks for entries in
  /// any order; asking declares the entry in a dealii::ParameterHandler, checks unit and
  /// range, and returns the value in internal units (mm, N, MPa, s, K). Mistakes do not stop
  /// the reading: they are collected, and finish() throws one InputError that lists all of them,
  /// together with entries that nobody asked for (typing errors, with the nearest known name).
  ///
  /// In documentation mode (no file) the same code visits every model and every entry, so
  /// that the documentation cannot drift from the program; values are then defaults or
  /// the smallest allowed values.
  class Parameters
  {
  public:
    /// @param overrides texts `Section/Entry = value` from `--set`.
    static Parameters from_file(const std::filesystem::path    &file,
                                const std::vector<std::string> &overrides = {});
    static Parameters from_text(const std::string              &text,
                                const std::string              &name      = "input",
                                const std::vector<std::string> &overrides = {});
    static Parameters for_documentation();

    Parameters(Parameters &&) noexcept;
    ~Parameters();

    /// Leaves the subsection when it goes out of scope.
    class Scope
    {
    public:
      Scope(Parameters &parameters, const std::string &name, bool from_top = false);
      ~Scope();
      Scope(const Scope &)            = delete;
      Scope &operator=(const Scope &) = delete;

    private:
      Parameters              &parameters;
      std::vector<std::string> left; ///< the sections to come back to
    };

    /// Enter a subsection: `const auto scope = parameters.section("Blank");`
    Scope section(const std::string &name) { return Scope(*this, name); }
    /// Enter a subsection of the top level, wherever we are: for a model that needs a section of the whole file.
    Scope top_section(const std::string &name) { return Scope(*this, name, /*from_top=*/true); }

    bool documentation_mode() const;
    /// True if the file (or --set) gives this entry of the current subsection.
    bool has(const std::string &entry) const;
    /// True if the file has any entry below subsection @p name of the current one.
    bool has_section(const std::string &name) const;
    /// Names of subsections given below the current one.
    std::vector<std::string> given_sections() const;
    /// Path of the current subsection, `A/B` (empty at the top).
    std::string path() const;
    /// Folder against which file names in the parameter file are resolved.
    std::filesystem::path base_folder() const;

    /// A number with unit, in internal units. @p unit names the dimension and is the unit of @p range.
    double quantity(const std::string            &entry,
                    const std::string            &unit,
                    const Range                  &range,
                    const std::string            &documentation,
                    const std::optional<Default> &default_value = {});
    /// A comma-separated list of numbers; one unit after the last number, or one after each. It may be empty if the
    /// default is.
    std::vector<double> quantity_list(const std::string            &entry,
                                      const std::string            &unit,
                                      const Range                  &range,
                                      const std::string            &documentation,
                                      const std::optional<Default> &default_value = {});
    long        integer(const std::string            &entry,
                        const Range                  &range,
                        const std::string            &documentation,
                        const std::optional<Default> &default_value = {});
    bool        flag(const std::string            &entry,
                     const std::string            &documentation,
                     const std::optional<Default> &default_value = {});
    std::string text(const std::string            &entry,
                     const std::string            &documentation,
                     const std::optional<Default> &default_value = {});
    std::string choice(const std::string              &entry,
                       const std::vector<std::string> &choices,
                       const std::string              &documentation,
                       const std::optional<Default>   &default_value = {});
    /// An existing, readable file; relative names are taken from the folder of the parameter file.
    std::filesystem::path input_file(const std::string &entry, const std::string &documentation);

    /// The model chosen by @p entry ("Model"), created from the subsection named like it.
    /// Returns nullptr if the choice is missing or wrong (the problem is recorded).
    template <class Interface>
    std::unique_ptr<Interface> model(const std::string            &entry,
                                     const std::string            &documentation,
                                     const std::optional<Default> &default_value = {})
    {
      std::vector<std::string> names, descriptions;
      for (const auto &[name, e] : Registry<Interface>::entries())
        {
          names.push_back(name);
          descriptions.push_back("`" + name + "`: " + e.info.description);
        }
      const std::string chosen = choose_model(entry, names, descriptions, documentation, default_value);
      std::unique_ptr<Interface> result;
      for (const auto &[name, e] : Registry<Interface>::entries())
        if (documentation_mode() || name == chosen)
          {
            const auto scope = section(model_section(name));
            auto       made  = guarded_create<Interface>(e.create);
            if (name == chosen || !result)
              result = std::move(made);
          }
        else
          mark_unselected(model_section(name));
      return result;
    }

    /// Subsection or entry @p name of the current subsection has no effect with the choices made elsewhere in the file: if it
    /// is given, that is a warning and not a mistake.
    void mark_unselected(const std::string &name);

    /// Record a mistake of entry @p entry in the current subsection (empty: of the subsection itself).
    void problem(const std::string &entry,
                 const std::string &what,
                 const std::string &allowed = "",
                 const std::string &hint    = "");
    void warning(const std::string &text);
    /// True if a problem has been recorded so far.
    bool has_problems() const;

    /// Ends the reading: throws InputError listing every problem and every entry nobody asked for.
    /// Returns the warnings.
    std::vector<std::string> finish();

    /// The file with every entry that takes effect, defaults included.
    std::string effective() const;
    const std::vector<EntryInfo> &entries() const;
    /// Name of the file or text.
    std::string name() const;

  private:
    Parameters();
    struct Implementation;
    std::unique_ptr<Implementation> data;

    std::string choose_model(const std::string              &entry,
                             const std::vector<std::string> &names,
                             const std::vector<std::string> &descriptions,
                             const std::string              &documentation,
                             const std::optional<Default>   &default_value);
    void        record_exception(const std::string &what);

    /// `von Mises` -> `Von Mises`: subsections are written with a capital.
    static std::string model_section(const std::string &name);

    template <class Interface, class Creator>
    std::unique_ptr<Interface> guarded_create(const Creator &create)
    {
      // Laws may find two entries inconsistent and throw; that is one more problem of the file.
      try
        {
          return create(*this);
        }
      catch (const std::exception &e)
        {
          record_exception(e.what());
          return {};
        }
    }
  };
} // namespace tribodraw

#endif
