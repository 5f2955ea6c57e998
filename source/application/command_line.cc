#include <tribodraw/application/command_line.h>
#include <tribodraw/application/verbs.h>
#include <tribodraw/base/errors.h>
#include <tribodraw/base/suggest.h>

#include <algorithm>

namespace tribodraw
{
  namespace
  {
    struct Option
    {
      const char *name, *argument, *description;
    };

    constexpr Option options[]
        = { { "--output", "DIR", "folder for the results; default: output/NAME for the file NAME.prm" },
            { "--set", "'Section/Entry = value'", "change an entry of the file (repeatable)" },
            { "--resume", "", "go on from the newest checkpoint in the output folder" },
            { "--validate", "", "read and check everything, say what would run, stop" },
            { "--quiet", "", "print warnings and errors only" },
            { "--verbose", "", "print a line a step also where the output is not a terminal" },
            { "--help", "", "print this text" },
            { "--version", "", "print the versions of the program and of its libraries" } };

    std::string
    did_you_mean(const std::string &word, const std::vector<std::string> &known)
    {
      const std::string near = nearest(word, known);
      return near.empty() ? "See 'tribodraw --help'." : "Did you mean '" + near + "'?";
    }

    [[noreturn]] void
    unknown_option(const std::string &word)
    {
      std::vector<std::string> known;
      for (const Option &option : options)
        known.push_back(option.name);
      for (const Verb &verb : verbs())
        for (const VerbOption &option : verb.options)
          known.push_back(option.name);
      throw InputError(
          describe_error("Unknown option.", "command line", "'" + word + "'", "", did_you_mean(word, known)));
    }

    const Verb *
    find_verb(const std::string &name)
    {
      for (const Verb &verb : verbs())
        if (verb.name == name)
          return &verb;
      return nullptr;
    }

    /// Whether an option belongs to some verb and, if so, whether it takes a value.
    const VerbOption *
    find_verb_option(const std::string &name)
    {
      for (const Verb &verb : verbs())
        for (const VerbOption &option : verb.options)
          if (option.name == name)
            return &option;
      return nullptr;
    }

    void
    check_verb_options(const CommandLine &line)
    {
      const Verb *verb = line.verb.empty() ? nullptr : find_verb(line.verb);
      for (const auto &[name, value] : line.verb_options)
        {
          const bool known = verb != nullptr
                             && std::any_of(verb->options.begin(), verb->options.end(),
                                            [&name = name](const VerbOption &o) { return o.name == name; });
          if (!known)
            throw InputError(describe_error("The option has no effect here.",
                                            verb ? "command line, verb '" + line.verb + "'" : "command line", name, "",
                                            "See 'tribodraw --help'."));
        }
    }

    void
    check_verb(const CommandLine &line)
    {
      const Verb       *verb   = find_verb(line.verb);
      const std::size_t wanted = verb->arguments.size();
      std::string       usage  = "tribodraw " + verb->name;
      for (const std::string &argument : verb->arguments)
        usage += " " + argument;
      if (line.arguments.size() != wanted)
        throw InputError(describe_error("Wrong number of arguments.", "command line, verb '" + verb->name + "'",
                                        std::to_string(line.arguments.size()), std::to_string(wanted),
                                        "Usage: " + usage));
      // --output belongs to runs and to verbs that write a file and say so.
      if (!line.output.empty() || !line.settings.empty() || line.resume || line.validate)
        throw InputError(describe_error("--output, --set, --resume and --validate have no effect with a verb.",
                                        "command line, verb '" + verb->name + "'", "", "", "Usage: " + usage));
    }

    void
    check_file(const CommandLine &line)
    {
      if (line.arguments.empty())
        throw InputError(
            describe_error("No parameter file was given.", "command line", "", "",
                           "Usage: tribodraw FILE.prm [options]; 'tribodraw init NAME' writes an example."));
      const std::string &first = line.arguments.front();
      if (line.arguments.size() > 1 || (!std::filesystem::exists(first) && first.find('.') == std::string::npos))
        {
          // A word that is neither a file nor like one was meant as a verb.
          std::vector<std::string> known;
          for (const Verb &verb : verbs())
            known.push_back(verb.name);
          if (!std::filesystem::exists(first))
            throw InputError(describe_error("Neither a parameter file nor a known verb.", "command line",
                                            "'" + first + "'", "", did_you_mean(first, known)));
          throw InputError(describe_error("More than one parameter file was given.", "command line",
                                          "'" + line.arguments[1] + "'", "one file a run"));
        }
    }
  } // namespace

  CommandLine
  CommandLine::parse(const std::vector<std::string> &words)
  {
    CommandLine line;
    for (std::size_t i = 0; i < words.size(); ++i)
      {
        const std::string &word = words[i];
        if (word.size() < 2 || word[0] != '-')
          {
            line.arguments.push_back(word);
            continue;
          }
        const auto        equals = word.find('=');
        const std::string name   = word.substr(0, equals);
        const auto        option
            = std::find_if(std::begin(options), std::end(options), [&](const Option &o) { return name == o.name; });
        const VerbOption *verb_option = find_verb_option(name);
        if (option == std::end(options) && verb_option == nullptr)
          unknown_option(name);
        const std::string argument = verb_option ? verb_option->argument : option->argument;
        std::string       value;
        if (!argument.empty())
          {
            if (equals == std::string::npos && i + 1 == words.size())
              throw InputError(describe_error("The option needs a value.", "command line", name, argument,
                                              "Give it after a blank."));
            value = equals == std::string::npos ? words[++i] : word.substr(equals + 1);
          }
        else if (equals != std::string::npos)
          throw InputError(describe_error("The option takes no value.", "command line", word));
        if (verb_option != nullptr)
          {
            line.verb_options[name] = value;
            continue;
          }
        if (name == "--output")
          line.output = value;
        else if (name == "--set")
          line.settings.push_back(value);
        line.resume   = line.resume || name == "--resume";
        line.validate = line.validate || name == "--validate";
        line.quiet    = line.quiet || name == "--quiet";
        line.verbose  = line.verbose || name == "--verbose";
        line.help     = line.help || name == "--help";
        line.version  = line.version || name == "--version";
      }
    if (line.quiet && line.verbose)
      throw InputError(describe_error("--quiet and --verbose contradict each other.", "command line"));
    if (line.help || line.version)
      return line;
    if (!line.arguments.empty() && find_verb(line.arguments.front()) != nullptr)
      {
        line.verb = line.arguments.front();
        line.arguments.erase(line.arguments.begin());
        check_verb(line);
      }
    else
      check_file(line);
    check_verb_options(line);
    return line;
  }

  std::string
  CommandLine::help_text()
  {
    const auto padded = [](std::string text) {
      text.resize(std::max<std::size_t>(text.size() + 2, 34), ' ');
      return "  " + text;
    };
    std::string text = "tribodraw: friction in lubricated sheet-metal forming from surface topographies, and deep "
                       "drawing with it.\n\n"
                       "Usage: tribodraw FILE.prm [options]\n"
                       "       mpirun -np N tribodraw FILE.prm [options]\n"
                       "       tribodraw VERB [argument]\n\nOptions:\n";
    for (const Option &option : options)
      text += padded(std::string(option.name) + (*option.argument ? std::string(" ") + option.argument : ""))
              + option.description + "\n";
    text += "\nVerbs:\n";
    for (const Verb &verb : verbs())
      {
        std::string usage = verb.name;
        for (const std::string &argument : verb.arguments)
          usage += " " + argument;
        text += padded(usage) + verb.description + "\n";
        for (const VerbOption &option : verb.options)
          text += padded("  " + option.name + (option.argument.empty() ? "" : " " + option.argument))
                  + option.description + "\n";
      }
    return text
           + "\nExit codes: 0 done, 2 wrong input, 3 not converged (the last state is written), 1 anything else.\n"
             "First steps: tribodraw init surface && tribodraw surface.prm\n";
  }
} // namespace tribodraw
