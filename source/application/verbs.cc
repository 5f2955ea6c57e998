#include <tribodraw/application/program.h>
#include <tribodraw/application/verbs.h>
#include <tribodraw/base/errors.h>
#include <tribodraw/base/files.h>
#include <tribodraw/base/log.h>
#include <tribodraw/base/suggest.h>
#include <tribodraw/base/units.h>
#include <tribodraw/friction_table/coefficient_table.h>
#include <tribodraw/output/comparison.h>
#include <tribodraw/output/figures.h>
#include <tribodraw/output/friction_export.h>
#include <tribodraw/output/report.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <map>
#include <set>
#include <sstream>

namespace tribodraw
{
  namespace
  {
    namespace fs = std::filesystem;

    void
    init(const VerbCall &call)
    {
      const std::string       &given = call.arguments[0];
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
    list(const VerbCall &)
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
    parameters(const VerbCall &)
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
    explain(const VerbCall &call)
    {
      const std::string &path = call.arguments[0];
      const auto         all  = all_entries();
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

    std::string
    all_formats()
    {
      std::string all;
      for (const std::string &name : friction_export_formats())
        all += (all.empty() ? "" : ", ") + name;
      return "one of " + all;
    }

    /// The number given for an option, or the default.
    double
    option_number(const VerbCall &call, const std::string &name, const double default_value)
    {
      const auto at = call.options.find(name);
      if (at == call.options.end())
        return default_value;
      char        *end   = nullptr;
      const double value = std::strtod(at->second.c_str(), &end);
      if (at->second.empty() || *end != '\0' || !std::isfinite(value) || value < 0)
        throw InputError(describe_error("The value of the option is not a number from zero.", "command line, " + name,
                                        "'" + at->second + "'"));
      return value;
    }

    std::string
    short_number(const double value)
    {
      char text[32];
      std::snprintf(text, sizeof text, "%.3g", value);
      return text;
    }

    void
    export_table(const VerbCall &call)
    {
      if (call.options.count("--format") == 0)
        throw InputError(
            describe_error("The format is missing.", "tribodraw export", "", all_formats(), "Add --format FORMAT."));
      const auto             format = make_friction_export(call.options.at("--format"));
      const fs::path         source = call.arguments[0];
      CoefficientTable       table  = CoefficientTable::read(source);
      FrictionExportSettings settings;
      for (const unsigned char c : source.stem().string())
        settings.name += std::isalnum(c) || c == '-' ? static_cast<char>(c) : '_';
      settings.max_error = option_number(call, "--max-error", settings.max_error);
      if (call.options.count("--strain") > 0)
        {
          const double strain = option_number(call, "--strain", 0);
          table               = table.at_strain(strain);
          settings.note       = "At equivalent plastic strain " + units::number(strain) + ".";
        }
      else if (!format->takes_strain() && table.strains.size() > 1)
        {
          settings.note = "Mean over equivalent plastic strains " + units::number(table.strains.front()) + " to "
                          + units::number(table.strains.back()) + "; the coefficient differs from it by up to "
                          + short_number(table.strain_deviation()) + ".";
          table = table.mean_over_strain();
          log::warning("The format holds no strain. " + settings.note + " Choose one strain with --strain.");
        }
      fs::path target = source.parent_path() / (source.stem().string() + format->file_ending());
      if (call.options.count("--to") > 0)
        target = call.options.at("--to");
      if (fs::exists(target) && fs::equivalent(source, target))
        throw InputError(describe_error("The export would overwrite the table itself.", "tribodraw export",
                                        target.string(), "", "Name another file with --to."));
      write_file(target, format->text(table, settings));
      std::cout << "Wrote " << target.string() << "\n";
    }

    void
    check_output_folder(const fs::path &folder, const std::string &verb)
    {
      if (!fs::is_directory(folder))
        throw InputError(describe_error("The output folder does not exist.", verb, "'" + folder.string() + "'"));
      if (!fs::exists(folder / "run_info.txt"))
        throw InputError(
            describe_error("This is not an output folder: it has no run_info.txt.", verb, "'" + folder.string() + "'"));
    }

    /// `measured=computed,measured=computed`
    std::vector<std::pair<std::string, std::string>>
    column_pairs(const std::string &text)
    {
      std::vector<std::pair<std::string, std::string>> pairs;
      std::istringstream                               in(text);
      for (std::string item; std::getline(in, item, ',');)
        {
          const auto equals = item.find('=');
          if (equals == std::string::npos || equals == 0 || equals + 1 == item.size())
            throw InputError(describe_error("This does not name two columns.", "command line, --columns", "'" + item + "'",
                                            "MEASURED=COMPUTED"));
          pairs.emplace_back(item.substr(0, equals), item.substr(equals + 1));
        }
      if (pairs.size() < 2)
        throw InputError(describe_error("A curve needs two pairs of columns.", "command line, --columns", "'" + text + "'",
                                        "the abscissa first: stroke_mm=punch_travel_mm,force_kn=punch_force_n"));
      return pairs;
    }

    void
    compare(const VerbCall &call)
    {
      const fs::path folder = call.arguments[1];
      check_output_folder(folder, "tribodraw compare");
      const auto pairs = call.options.count("--columns") > 0 ? column_pairs(call.options.at("--columns"))
                                                             : std::vector<std::pair<std::string, std::string>>();
      const auto curves = compare_with_run(read_measured_table(call.arguments[0]), folder, pairs);
      write_comparison(curves, folder);
      write_report(folder);
      for (const CurveComparison &c : curves)
        {
          std::cout << c.quantity << " over " << c.abscissa << ", " << short_number(c.from) << " to " << short_number(c.to)
                    << ", " << c.points << " measured points\n  computed - measured: rms " << short_number(c.rms) << " ("
                    << short_number(100 * c.relative_rms()) << " % of the measured maximum), mean " << short_number(c.mean)
                    << ", largest " << short_number(c.largest) << " at " << short_number(c.largest_at)
                    << "\n  maximum: measured " << short_number(c.measured_peak) << ", computed "
                    << short_number(c.computed_peak) << "; area: measured " << short_number(c.measured_area)
                    << ", computed " << short_number(c.computed_area) << "\n";
          if (c.left_out > 0)
            std::cout << "  " << c.left_out << " measured points were left out: no number, or not further than the one before\n";
        }
      std::cout << "Wrote " << (folder / "compare.csv").string() << ", the figures and report.html\n";
    }

    void
    report(const VerbCall &call)
    {
      const fs::path folder = call.arguments[0];
      check_output_folder(folder, "tribodraw report");
      figures::draw_all(folder);
      write_report(folder);
      std::cout << "Wrote " << (folder / "report.html").string() << "\n";
    }

    void
    doctor(const VerbCall &)
    {
      std::cout << examine_machine();
    }
  } // namespace

  const std::vector<Verb> &
  verbs()
  {
    static const std::vector<Verb> all{
      { "init", { "NAME" }, "write the commented example NAME.prm", init },
      { "explain", { "'Section/Entry'" }, "meaning, unit, allowed values and default of an entry", explain },
      { "list", {}, "all models with one sentence and their source", list },
      { "parameters", {}, "all entries of all tasks as Markdown", parameters },
      { "export",
        { "TABLE" },
        "write a friction table or the coefficients of a strip draw for another program",
        export_table,
        { { "--format", "FORMAT", all_formats() },
          { "--strain", "VALUE", "the strain at which to take the coefficient; default: the mean over all strains" },
          { "--max-error", "VALUE", "how far a fitted formula may be off; default: 0.02" },
          { "--to", "FILE", "the file to write; default: beside TABLE" } } },
      { "compare",
        { "MEASURED", "DIR" },
        "compare a measurement (CSV, or FILE.h5:/PATH) with the tables of an output folder",
        compare,
        { { "--columns", "A=B,C=D",
            "which columns belong together, measured=computed, the abscissa first; default: by name" } } },
      { "report", { "DIR" }, "draw figures and report.html of an output folder again", report },
      { "doctor", {}, "examine what the program needs from this machine", doctor }
    };
    return all;
  }
} // namespace tribodraw
