#include <tribodraw/application/program.h>
#include <tribodraw/application/verbs.h>
#include <tribodraw/base/errors.h>
#include <tribodraw/base/files.h>
#include <tribodraw/base/suggest.h>
#include <tribodraw/output/figures.h>
#include <tribodraw/output/report.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <map>
#include <set>

namespace tribodraw
{
  namespace
  {
    namespace fs = std::filesystem;

    void
    init(const std::string &given)
    {
      const std::string        name = fs::path(given).extension() == ".prm" ? given.substr(0, given.size() - 4) : given;
      std::vector<std::string> names;
      for (const ShippedFile &file : shipped_files())
        names.push_back(file.name);
      const auto at = std::find(names.begin(), names.end(), name);
      if (at == names.end())
        {
          std::string all;
          for (const auto &n : names)
            all += (all.empty() ? "" : ", ") + n;
          const std::string near = nearest(name, names);
          throw InputError(describe_error("There is no such example.", "tribodraw init", "'" + name + "'", all,
                                          near.empty() ? "" : "Did you mean '" + near + "'?"));
        }
      const fs::path target = name + ".prm";
      if (fs::exists(target))
        throw InputError(describe_error("The file exists already and is not overwritten.", "tribodraw init",
                                        target.string(), "", "Rename it or go to another folder."));
      write_file(target, shipped_files()[at - names.begin()].content);
      std::cout << "Wrote " << target.string() << ". Run it with: tribodraw " << target.string() << "\n";
    }

    void
    list(const std::string &)
    {
      std::map<std::string, std::vector<ModelInfo>> families;
      for (const ModelInfo &model : all_registered_models())
        families[model.kind].push_back(model);
      for (auto &[kind, models] : families)
        {
          std::sort(models.begin(), models.end(),
                    [](const ModelInfo &a, const ModelInfo &b) { return a.name < b.name; });
          std::cout << kind << "\n";
          for (const ModelInfo &model : models)
            std::cout << "  " << model.name << ": " << model.description
                      << (model.citation.empty() ? "" : " [" + model.citation + "]") << "\n";
          std::cout << "\n";
        }
    }

    std::string
    section_of(const std::string &path)
    {
      const auto slash = path.rfind('/');
      return slash == std::string::npos ? "" : path.substr(0, slash);
    }

    std::string
    table_cell(const std::string &text)
    {
      std::string result;
      for (const char c : text)
        result += c == '|' ? "\\|" : c == '\n' ? " " : std::string(1, c);
      return result;
    }

    void
    parameters(const std::string &)
    {
      std::cout << "# Parameters\n\nOne section for each task. Values carry their unit, as in `0.82 mm`; any unit of "
                   "the same "
                   "dimension will do.\n";
      for (const auto &[task, entries] : document_all_tasks())
        {
          std::cout << "\n## Task `" << task << "`\n";
          std::vector<std::string> sections; // in the order of first appearance
          for (const EntryInfo &entry : entries)
            if (std::find(sections.begin(), sections.end(), section_of(entry.path)) == sections.end())
              sections.push_back(section_of(entry.path));
          for (const auto &section : sections)
            {
              std::cout << "\n### " << (section.empty() ? "Top level" : section)
                        << "\n\n| Entry | Unit | Allowed | Default | Meaning |\n|---|---|---|---|---|\n";
              for (const EntryInfo &entry : entries)
                if (section_of(entry.path) == section)
                  std::cout << "| " << entry.path.substr(section.empty() ? 0 : section.size() + 1) << " | "
                            << (entry.unit.empty() ? "-" : entry.unit) << " | " << table_cell(entry.range) << " | "
                            << (entry.required ? "required" : "`" + table_cell(entry.default_value) + "`") << " | "
                            << table_cell(entry.documentation) << " |\n";
            }
        }
    }

    struct Explained
    {
      EntryInfo             info;
      std::set<std::string> tasks;
    };

    std::map<std::string, Explained>
    all_entries()
    {
      std::map<std::string, Explained> all;
      for (const auto &[task, entries] : document_all_tasks())
        for (const EntryInfo &entry : entries)
          {
            Explained &e = all[entry.path];
            e.info       = entry;
            e.tasks.insert(task);
          }
      return all;
    }

    void
    print_entry(const Explained &entry)
    {
      const EntryInfo &info = entry.info;
      std::string      tasks;
      for (const auto &task : entry.tasks)
        tasks += (tasks.empty() ? "" : ", ") + task;
      std::cout << info.path << "\n  " << info.documentation << "\n  Type:    " << info.type
                << "\n  Unit:    " << (info.unit.empty() ? "-" : info.unit) << "\n  Allowed: " << info.range
                << "\n  Default: " << (info.required ? "none, required" : "'" + info.default_value + "'")
                << "\n  Tasks:   " << tasks << "\n";
    }

    void
    explain(const std::string &path)
    {
      const auto all = all_entries();
      if (const auto found = all.find(path); found != all.end())
        return print_entry(found->second);
      // A section: all entries below it.
      bool any = false;
      for (const auto &[known, entry] : all)
        if (known.compare(0, path.size() + 1, path + "/") == 0)
          {
            print_entry(entry);
            any = true;
          }
      if (any)
        return;
      std::vector<std::string> paths, matching;
      for (const auto &[known, entry] : all)
        {
          paths.push_back(known);
          if (known.size() > path.size()
              && known.compare(known.size() - path.size() - 1, std::string::npos, "/" + path) == 0)
            matching.push_back(known);
        }
      std::string hint;
      for (const auto &known : matching) // the entry's name without its section
        hint += (hint.empty() ? "" : " or ") + ("'" + known + "'");
      if (hint.empty())
        if (const std::string near = nearest(path, paths); !near.empty())
          hint = "'" + near + "'";
      throw InputError(
          describe_error("There is no such entry.", "tribodraw explain", "'" + path + "'", "",
                         hint.empty() ? "'tribodraw parameters' shows all." : "Did you mean " + hint + "?"));
    }

    void
    report(const std::string &folder)
    {
      if (!fs::is_directory(folder))
        throw InputError(describe_error("The output folder does not exist.", "tribodraw report", "'" + folder + "'"));
      if (!fs::exists(fs::path(folder) / "run_info.txt"))
        throw InputError(describe_error("This is not an output folder: it has no run_info.txt.", "tribodraw report",
                                        "'" + folder + "'"));
      figures::draw_all(folder);
      write_report(folder);
      std::cout << "Wrote " << (fs::path(folder) / "report.html").string() << "\n";
    }

    void
    doctor(const std::string &)
    {
      std::cout << examine_machine();
    }
  } // namespace

  const std::vector<Verb> &
  verbs()
  {
    static const std::vector<Verb> all{
      { "init", "NAME", "write the commented example NAME.prm", init },
      { "explain", "'Section/Entry'", "meaning, unit, allowed values and default of an entry", explain },
      { "list", "", "all models with one sentence and their source", list },
      { "parameters", "", "all entries of all tasks as Markdown", parameters },
      { "report", "DIR", "draw figures and report.html of an output folder again", report },
      { "doctor", "", "examine what the program needs from this machine", doctor }
    };
    return all;
  }
} // namespace tribodraw
