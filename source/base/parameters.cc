#include <tribodraw/base/errors.h>
#include <tribodraw/base/files.h>
#include <tribodraw/base/parameters.h>
#include <tribodraw/base/suggest.h>
#include <tribodraw/base/units.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

namespace tribodraw
{
  namespace
  {
    /// An entry as it stands in the file.
    struct RawEntry
    {
      std::string value;
      std::string where; // file:line or --set
      int         order = 0;
      bool        used  = false;
    };

    std::string trim(const std::string &text)
    {
      const auto first = text.find_first_not_of(" \t\r\n");
      if (first == std::string::npos)
        return {};
      return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
    }

    std::vector<std::string> split_list(const std::string &text)
    {
      std::vector<std::string> parts;
      std::istringstream       in(text);
      for (std::string part; std::getline(in, part, ',');)
        parts.push_back(trim(part));
      return parts;
    }

    std::string join(const std::vector<std::string> &words)
    {
      std::string text;
      for (const auto &word : words)
        text += (text.empty() ? "" : " | ") + word;
      return text;
    }
  } // namespace

  struct Parameters::Implementation
  {
    std::string                     name;
    std::filesystem::path           folder;
    bool                            documentation = false;
    std::map<std::string, RawEntry> raw;
    std::vector<std::string>        section;    // where we are
    std::vector<std::string>        unselected; // paths of subsections of models that are not chosen
    std::vector<std::string>        problems, warnings;
    std::vector<EntryInfo>          infos;
    std::set<std::string>           declared;
    std::set<std::string>           unusual; // entries that may leave their usual range
    dealii::ParameterHandler        handler;

    std::string here() const
    {
      std::string path;
      for (const auto &s : section)
        path += (path.empty() ? "" : "/") + s;
      return path;
    }
    std::string full(const std::string &entry) const
    {
      const std::string path = here();
      return path.empty() ? entry : entry.empty() ? path : path + "/" + entry;
    }

    void scan(const std::string &text);
    void apply_override(const std::string &text);
    const std::string *ask(const std::string                              &entry,
                           EntryInfo                                       info,
                           const std::optional<Default>                   &default_value,
                           const std::function<bool(const std::string &)> &accepts);
    void complain(const std::string &entry, const std::string &what, const std::string &value, const std::string &allowed, const std::string &hint);
    bool has_used_entry(const std::string &section_path) const;
    void complain_about_unknown();
  };

  std::string
  Range::describe(const std::string &unit) const
  {
    const std::string u = unit.empty() ? "" : " " + unit;
    std::string       text;
    const bool        has_min = std::isfinite(min), has_max = std::isfinite(max);
    if (has_min && has_max)
      text = units::number(min) + (excludes_min ? " (excluded)" : "") + " to " + units::number(max) + u;
    else if (has_min)
      text = (excludes_min ? "more than " : "at least ") + units::number(min) + u;
    else if (has_max)
      text = "at most " + units::number(max) + u;
    else
      text = "any number";
    if (std::isfinite(usual_min) || std::isfinite(usual_max))
      text += "; usually " + units::number(usual_min) + " to " + units::number(usual_max) + u;
    return text;
  }

  // ---------------------------------------------------------------- scanning

  void
  Parameters::Implementation::scan(const std::string &text)
  {
    std::istringstream       in(text);
    std::vector<std::string> open;
    std::vector<int>         open_line;
    int                      line_number = 0, order = 0;
    for (std::string line; std::getline(in, line);)
      {
        const int first_line = ++line_number;
        line                 = trim(line.substr(0, line.find('#')));
        while (!line.empty() && line.back() == '\\')
          {
            std::string next;
            line.pop_back();
            if (!std::getline(in, next))
              break;
            ++line_number;
            line += trim(next.substr(0, next.find('#')));
          }
        if (line.empty())
          continue;
        const std::string where   = name + ":" + std::to_string(first_line);
        const auto        keyword = line.substr(0, line.find_first_of(" \t"));
        const std::string rest    = trim(line.substr(keyword.size()));
        if (keyword == "subsection" && !rest.empty())
          {
            open.push_back(rest);
            open_line.push_back(first_line);
          }
        else if (line == "end")
          {
            if (open.empty())
              problems.push_back(where + ": 'end' without a subsection.");
            else
              {
                open.pop_back();
                open_line.pop_back();
              }
          }
        else if (keyword == "set" && rest.find('=') != std::string::npos)
          {
            std::string path;
            for (const auto &s : open)
              path += s + "/";
            path += trim(rest.substr(0, rest.find('=')));
            const RawEntry entry{trim(rest.substr(rest.find('=') + 1)), where, order++};
            const auto [old, inserted] = raw.emplace(path, entry);
            if (!inserted)
              problems.push_back(where + ": " + path + " is set twice; the first time at " + old->second.where + ". Remove one of the two.");
          }
        else
          problems.push_back(where + ": cannot read '" + line + "'. Allowed: 'set Entry = value', 'subsection Name', 'end', '# comment'.");
      }
    for (std::size_t i = 0; i < open.size(); ++i)
      problems.push_back(name + ":" + std::to_string(open_line[i]) + ": subsection '" + open[i] + "' has no 'end'.");
  }

  void
  Parameters::Implementation::apply_override(const std::string &text)
  {
    const auto equals = text.find('=');
    if (equals == std::string::npos || trim(text.substr(0, equals)).empty())
      {
        problems.push_back("--set '" + text + "': expected 'Section/Entry = value'.");
        return;
      }
    RawEntry entry{trim(text.substr(equals + 1)), "--set", static_cast<int>(raw.size()) + 100000};
    raw[trim(text.substr(0, equals))] = entry;
  }

  Parameters::Parameters()
    : data(std::make_unique<Implementation>())
  {}
  Parameters::Parameters(Parameters &&) noexcept = default;
  Parameters::~Parameters()                      = default;

  Parameters
  Parameters::from_text(const std::string &text, const std::string &name, const std::vector<std::string> &overrides)
  {
    Parameters p;
    p.data->name   = name;
    p.data->folder = std::filesystem::current_path();
    p.data->scan(text);
    for (const auto &o : overrides)
      p.data->apply_override(o);
    const std::string accepted = p.text("Accept unusual values",
                                        "Paths of entries, separated by commas, whose values may leave the range that is usual "
                                        "for sheet-metal forming (they must still be physically possible).",
                                        Default{"", "no exceptions"});
    for (const auto &path : split_list(accepted))
      p.data->unusual.insert(path);
    return p;
  }

  Parameters
  Parameters::from_file(const std::filesystem::path &file, const std::vector<std::string> &overrides)
  {
    Parameters p = from_text(read_file(file, 64u << 20), file.string(), overrides);
    p.data->folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
    return p;
  }

  Parameters
  Parameters::for_documentation()
  {
    Parameters p            = from_text("", "documentation");
    p.data->documentation   = true;
    return p;
  }

  // ---------------------------------------------------------------- asking

  Parameters::Scope::Scope(Parameters &p, const std::string &name, const bool from_top)
    : parameters(p)
  {
    if (from_top)
      {
        left.swap(p.data->section);
        for (std::size_t i = 0; i < left.size(); ++i)
          p.data->handler.leave_subsection();
      }
    p.data->section.push_back(name);
    p.data->handler.enter_subsection(name);
  }

  Parameters::Scope::~Scope()
  {
    parameters.data->section.pop_back();
    parameters.data->handler.leave_subsection();
    for (const std::string &name : left)
      {
        parameters.data->section.push_back(name);
        parameters.data->handler.enter_subsection(name);
      }
  }

  void
  Parameters::Implementation::complain(const std::string &entry,
                                       const std::string &what,
                                       const std::string &value,
                                       const std::string &allowed,
                                       const std::string &hint)
  {
    if (documentation)
      return;
    const std::string path  = full(entry);
    const auto        found = raw.find(path);
    const std::string where = (found != raw.end() ? found->second.where : name) + (path.empty() ? "" : ": " + path);
    problems.push_back(describe_error(what, where, value, allowed, hint));
  }

  const std::string *
  Parameters::Implementation::ask(const std::string                              &entry,
                                  EntryInfo                                       info,
                                  const std::optional<Default>                   &default_value,
                                  const std::function<bool(const std::string &)> &accepts)
  {
    info.path     = full(entry);
    info.required = !default_value;
    if (default_value)
      {
        info.default_value = default_value->value;
        if (!default_value->reason.empty())
          info.documentation += " Default: " + default_value->reason + ".";
      }
    const bool first_time = declared.insert(info.path).second;
    if (first_time)
      {
        handler.declare_entry(entry, default_value ? default_value->value : "", dealii::Patterns::Anything(), info.documentation);
        infos.push_back(info);
      }
    if (documentation)
      return default_value ? &default_value->value : nullptr;
    const auto found = raw.find(info.path);
    if (found == raw.end())
      {
        if (default_value)
          return &default_value->value;
        complain(entry, "this entry is missing and has no default.", "", info.range, info.documentation);
        return nullptr;
      }
    found->second.used = true;
    if (!accepts(found->second.value))
      return nullptr;
    if (first_time)
      handler.set(entry, found->second.value); // kept for effective.prm
    return &found->second.value;
  }

  namespace
  {
    /// Value in the entry's own unit is compared, with a tolerance for the rounding of the conversion.
    bool inside(const double x, const double min, const double max, const bool excludes_min)
    {
      const double tolerance = 1e-12 * std::abs(x);
      return (excludes_min ? x > min : x >= min - tolerance) && x <= max + tolerance;
    }

    double smallest_allowed(const Range &range)
    {
      if (std::isfinite(range.usual_min))
        return range.usual_min;
      if (std::isfinite(range.min))
        return range.excludes_min ? (std::isfinite(range.max) ? 0.5 * (range.min + range.max) : range.min + 1) : range.min;
      return std::isfinite(range.max) ? range.max : 1;
    }
  } // namespace

  std::vector<double>
  Parameters::quantity_list(const std::string            &entry,
                            const std::string            &unit,
                            const Range                  &range,
                            const std::string            &documentation,
                            const std::optional<Default> &default_value)
  {
    const bool          may_be_empty = default_value && default_value->value.empty();
    std::vector<double> values;
    const auto          read = [&](const std::string &text) {
      values.clear();
      if (may_be_empty && trim(text).empty())
        return true;
      auto              parts     = split_list(text);
      // one unit after the last number holds for all
      const std::string last      = parts.empty() ? "" : parts.back();
      const auto        unit_from = last.find_first_not_of("0123456789.+-eE");
      const std::string shared    = unit_from == std::string::npos ? "" : " " + trim(last.substr(unit_from));
      for (auto &part : parts)
        {
          if (!part.empty() && part.find_first_not_of("0123456789.+-eE") == std::string::npos)
            part += shared;
          try
            {
              values.push_back(units::parse_quantity(part, unit));
            }
          catch (const InputError &e)
            {
              data->complain(entry, e.what(), "", range.describe(unit), "");
              return false;
            }
          const double x = values.back() / units::factor(unit);
          if (!inside(x, range.min, range.max, range.excludes_min))
            {
              data->complain(entry, "the value is out of range.", part, range.describe(unit), "");
              return false;
            }
          if (!inside(x, range.usual_min, range.usual_max, false) && !data->unusual.count(data->full(entry)))
            {
              data->complain(entry, "the value is physically unusual (a wrong unit?).", part, range.describe(unit),
                             "If it is meant, add 'set Accept unusual values = " + data->full(entry) + "' at the top of the file.");
              return false;
            }
        }
      if (values.empty() && !may_be_empty)
        data->complain(entry, "the list is empty.", "", range.describe(unit), "");
      return !values.empty() || may_be_empty;
    };
    const EntryInfo    info{"", "list of numbers", unit, range.describe(unit), "", true, documentation};
    const std::string *text = data->ask(entry, info, default_value, [&](const std::string &t) { return read(t); });
    if (text && values.empty())
      read(*text); // the default
    if (values.empty() && !may_be_empty)
      values.push_back(smallest_allowed(range) * units::factor(unit));
    return values;
  }

  double
  Parameters::quantity(const std::string            &entry,
                       const std::string            &unit,
                       const Range                  &range,
                       const std::string            &documentation,
                       const std::optional<Default> &default_value)
  {
    const std::size_t n_infos  = data->infos.size();
    const auto        values   = quantity_list(entry, unit, range, documentation, default_value);
    if (data->infos.size() > n_infos)
      data->infos.back().type = unit.empty() ? "number" : "number with unit";
    if (values.size() > 1)
      data->complain(entry, "expected one number, found " + std::to_string(values.size()) + ".", "", range.describe(unit), "");
    return values[0];
  }

  long
  Parameters::integer(const std::string            &entry,
                      const Range                  &range,
                      const std::string            &documentation,
                      const std::optional<Default> &default_value)
  {
    const std::size_t n_infos = data->infos.size(), n_problems = data->problems.size();
    const double      value   = quantity(entry, "", range, documentation, default_value);
    if (data->infos.size() > n_infos)
      data->infos.back().type = "integer";
    if (data->problems.size() > n_problems)
      return static_cast<long>(smallest_allowed(range));
    if (value != std::floor(value) || std::abs(value) > 9e15)
      {
        data->complain(entry, "expected a whole number.", units::number(value), range.describe(""), "");
        return static_cast<long>(smallest_allowed(range));
      }
    return static_cast<long>(value);
  }

  std::string
  Parameters::choice(const std::string              &entry,
                     const std::vector<std::string> &choices,
                     const std::string              &documentation,
                     const std::optional<Default>   &default_value)
  {
    const auto accepts = [&](const std::string &value) {
      if (std::find(choices.begin(), choices.end(), value) != choices.end())
        return true;
      const std::string near = nearest(value, choices);
      data->complain(entry, "unknown choice.", "'" + value + "'", join(choices), near.empty() ? "" : "Did you mean '" + near + "'?");
      return false;
    };
    const EntryInfo    info{"", "choice", "", join(choices), "", true, documentation};
    const std::string *value = data->ask(entry, info, default_value, accepts);
    return value ? *value : data->documentation && !choices.empty() ? choices[0] : "";
  }

  bool
  Parameters::flag(const std::string &entry, const std::string &documentation, const std::optional<Default> &default_value)
  {
    return choice(entry, {"true", "false"}, documentation, default_value) == "true";
  }

  std::string
  Parameters::text(const std::string &entry, const std::string &documentation, const std::optional<Default> &default_value)
  {
    const EntryInfo    info{"", "text", "", "any text", "", true, documentation};
    const std::string *value = data->ask(entry, info, default_value, [](const std::string &) { return true; });
    return value ? *value : "";
  }

  std::filesystem::path
  Parameters::input_file(const std::string &entry, const std::string &documentation)
  {
    std::filesystem::path result;
    const auto            accepts = [&](const std::string &value) {
      if (value.empty())
        {
          data->complain(entry, "the file name is empty.", "", "", "");
          return false;
        }
      result = std::filesystem::path(value).is_absolute() ? std::filesystem::path(value) : data->folder / value;
      std::error_code error;
      if (!std::filesystem::is_regular_file(result, error))
        {
          data->complain(entry, "the file does not exist.", "'" + result.string() + "'", "", "Relative names start from the folder of the parameter file.");
          return false;
        }
      return true;
    };
    const EntryInfo info{"", "file name", "", "an existing file", "", true, documentation};
    data->ask(entry, info, {}, accepts);
    return result;
  }

  std::string
  Parameters::choose_model(const std::string              &entry,
                           const std::vector<std::string> &names,
                           const std::vector<std::string> &descriptions,
                           const std::string              &documentation,
                           const std::optional<Default>   &default_value)
  {
    std::string text = documentation;
    for (const auto &d : descriptions)
      text += " " + d;
    return choice(entry, names, text, default_value);
  }

  std::string
  Parameters::model_section(const std::string &name)
  {
    std::string section = name;
    if (!section.empty())
      section[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(section[0])));
    return section;
  }

  void
  Parameters::mark_unselected(const std::string &section)
  {
    data->unselected.push_back(data->full(section));
  }

  void
  Parameters::record_exception(const std::string &what)
  {
    data->complain("", what, "", "", "");
  }

  bool
  Parameters::documentation_mode() const
  {
    return data->documentation;
  }

  bool
  Parameters::has(const std::string &entry) const
  {
    return data->documentation || data->raw.count(data->full(entry)) > 0;
  }

  bool
  Parameters::has_section(const std::string &section) const
  {
    const std::string prefix = data->full(section) + "/";
    const auto        at     = data->raw.lower_bound(prefix);
    return data->documentation || (at != data->raw.end() && at->first.compare(0, prefix.size(), prefix) == 0);
  }

  std::vector<std::string>
  Parameters::given_sections() const
  {
    const std::string        prefix = data->section.empty() ? "" : data->here() + "/";
    std::vector<std::string> names;
    for (const auto &[path, entry] : data->raw)
      if (path.compare(0, prefix.size(), prefix) == 0)
        {
          const auto slash = path.find('/', prefix.size());
          if (slash == std::string::npos)
            continue;
          const std::string section_name = path.substr(prefix.size(), slash - prefix.size());
          if (std::find(names.begin(), names.end(), section_name) == names.end())
            names.push_back(section_name);
        }
    return names;
  }

  std::string
  Parameters::path() const
  {
    return data->here();
  }

  std::filesystem::path
  Parameters::base_folder() const
  {
    return data->folder;
  }

  std::string
  Parameters::name() const
  {
    return data->name;
  }

  void
  Parameters::problem(const std::string &entry, const std::string &what, const std::string &allowed, const std::string &hint)
  {
    const auto found = data->raw.find(data->full(entry));
    data->complain(entry, what, found != data->raw.end() && !entry.empty() ? "'" + found->second.value + "'" : "", allowed, hint);
  }

  void
  Parameters::warning(const std::string &text)
  {
    if (!data->documentation)
      data->warnings.push_back(text);
  }

  bool
  Parameters::has_problems() const
  {
    return !data->problems.empty();
  }

  // ---------------------------------------------------------------- ending

  bool
  Parameters::Implementation::has_used_entry(const std::string &section_path) const
  {
    const std::string prefix = section_path + "/";
    for (auto at = raw.lower_bound(prefix); at != raw.end() && at->first.compare(0, prefix.size(), prefix) == 0; ++at)
      if (at->second.used)
        return true;
    return false;
  }

  void
  Parameters::Implementation::complain_about_unknown()
  {
    std::vector<std::pair<int, std::string>> unknown;
    std::set<std::string>                    idle_names;
    for (const auto &[path, entry] : raw)
      {
        if (entry.used)
          continue;
        const auto idle = std::find_if(unselected.begin(), unselected.end(), [&p = path](const std::string &s) {
          return p == s || p.compare(0, s.size() + 1, s + "/") == 0;
        });
        if (idle != unselected.end())
          {
            // A section is named once for all its entries, but not if one of them does have an effect.
            const std::string &idle_name = has_used_entry(*idle) ? path : *idle;
            if (idle_names.insert(idle_name).second)
              warnings.push_back(entry.where + ": '" + idle_name + "' has no effect with the choices made in this file.");
            continue;
          }
        const auto               slash  = path.rfind('/');
        const std::string        parent = slash == std::string::npos ? "" : path.substr(0, slash + 1);
        std::vector<std::string> siblings, all(declared.begin(), declared.end());
        bool                     section_known = parent.empty();
        for (const auto &known : declared)
          if (known.compare(0, parent.size(), parent) == 0)
            {
              section_known = true;
              if (known.find('/', parent.size()) == std::string::npos)
                siblings.push_back(known.substr(parent.size()));
            }
        std::string hint;
        const std::string near = nearest(path.substr(parent.size()), siblings);
        const std::string near_path = nearest(path, all);
        if (!near.empty())
          hint = "Did you mean '" + near + "'?";
        else if (!near_path.empty())
          hint = "Did you mean '" + near_path + "'?";
        const std::string what = section_known ? "unknown entry." : "unknown section '" + parent.substr(0, parent.size() - 1) + "', or one that this task does not use.";
        unknown.emplace_back(entry.order, describe_error(what, entry.where + ": " + path, "", section_known ? join(siblings) : "", hint));
      }
    std::sort(unknown.begin(), unknown.end());
    for (auto &[order, text] : unknown)
      problems.push_back(std::move(text));
  }

  std::vector<std::string>
  Parameters::finish()
  {
    if (data->documentation)
      return {};
    data->complain_about_unknown();
    if (!data->problems.empty())
      {
        std::string text = data->problems.size() == 1 ? "One problem in " : std::to_string(data->problems.size()) + " problems in ";
        text += data->name + ":";
        for (const auto &p : data->problems)
          text += "\n  " + p;
        throw InputError(text);
      }
    return data->warnings;
  }

  std::string
  Parameters::effective() const
  {
    std::ostringstream out;
    data->handler.print_parameters(out, dealii::ParameterHandler::ShortText | dealii::ParameterHandler::KeepDeclarationOrder);
    return out.str();
  }

  const std::vector<EntryInfo> &
  Parameters::entries() const
  {
    return data->infos;
  }
} // namespace tribodraw
