#include <tribodraw/application/command_line.h>
#include <tribodraw/application/program.h>
#include <tribodraw/application/provenance.h>
#include <tribodraw/application/verbs.h>
#include <tribodraw/base/errors.h>
#include <tribodraw/base/files.h>
#include <tribodraw/base/leaks.h>
#include <tribodraw/base/log.h>
#include <tribodraw/base/parallel.h>
#include <tribodraw/base/timing.h>
#include <tribodraw/output/figures.h>
#include <tribodraw/output/report.h>

#include <mpi.h>
#include <unistd.h>

#include <deal.II/base/mpi.h>

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <new>
#include <optional>
#include <thread>

namespace tribodraw
{
  namespace
  {
    namespace fs = std::filesystem;

    /// Throw on every rank what @p action throws on rank 0, the only one that does it.
    template <class Action>
    void
    on_first_rank(const Action &action)
    {
      std::string problem;
      if (parallel::rank() == 0)
        try
          {
            action();
          }
        catch (const InputError &error)
          {
            problem = error.what();
          }
      parallel::broadcast(problem);
      if (!problem.empty())
        throw InputError(problem);
    }

    /// Find out, without creating anything, whether the output folder can be made.
    void
    check_output_folder(const fs::path &folder)
    {
      fs::path        existing = fs::absolute(folder);
      std::error_code ignored;
      while (!fs::exists(existing, ignored) && existing.has_relative_path())
        existing = existing.parent_path();
      const std::string reason = !fs::is_directory(existing, ignored)         ? "it is not a folder"
                                 : access(existing.c_str(), W_OK | X_OK) != 0 ? "it is not writable"
                                                                              : "";
      if (!reason.empty())
        throw InputError(
            describe_error("The output folder cannot be made, because of '" + existing.string() + "': " + reason + ".",
                           folder.string(), "", "a writable folder", "Choose another one with --output."));
    }

    /// Figures and report are worth a warning, never the run: the results are safe in their files.
    void
    write_presentation(const fs::path &folder)
    {
      if (parallel::rank() != 0)
        return;
      try
        {
          const timing::Scope scope("output/figures");
          figures::draw_all(folder);
        }
      catch (const std::exception &error)
        {
          log::warning(std::string("Not all figures could be drawn: ") + error.what());
        }
      timing::write(folder / "timing.csv");
      write_report(folder);
    }

    void
    run_task(Task &task, const RunContext &context)
    {
      try
        {
          task.run(context);
        }
      catch (const ConvergenceError &)
        {
          write_presentation(context.output_folder); // of what was reached
          throw;
        }
      write_presentation(context.output_folder);
    }

    void
    run_file(const CommandLine &line)
    {
      const fs::path file       = line.arguments.front();
      Parameters     parameters = Parameters::from_file(file, line.settings);
      const auto     task       = create_task(parameters);
      const auto     warnings   = parameters.finish();

      RunContext context;
      context.parameter_file       = file;
      context.settings             = line.settings;
      context.output_folder        = line.output.empty() ? fs::path("output") / file.stem() : line.output;
      context.resume               = line.resume;
      context.effective_parameters = parameters.effective();
      context.input_hashes         = input_hashes(parameters);
      check_output_folder(context.output_folder);
      if (line.validate)
        {
          for (const auto &text : warnings)
            log::warning(text);
          log::info(file.string() + " is valid. " + task->describe());
          return;
        }

      on_first_rank([&] {
        prepare_output_folder(context.output_folder);
        write_file(context.file("effective.prm"), context.effective_parameters);
        write_file(context.file("run_info.txt"), run_info(parameters, file));
        write_file(context.file("citations.txt"), citations(parameters));
      });
      log::open_file(context.file("log.txt"), context.resume);
      log::info(version_text() + " on " + std::to_string(parallel::size())
                + (parallel::size() == 1 ? " rank" : " ranks") + ", " + std::to_string(parallel::n_threads())
                + (parallel::n_threads() == 1 ? " thread" : " threads") + " each: " + file.string());
      for (const auto &text : warnings)
        log::warning(text);
      log::info(task->describe());
      if (line.resume && !task->has_checkpoints())
        log::info("This task keeps no checkpoints: it begins again. Friction tables that were finished are used.");
      run_task(*task, context);
      log::info("Results: " + context.output_folder.string() + ", report: " + context.file("report.html").string());
      log::close_file();
    }

    void
    run_command_line(const std::vector<std::string> &words)
    {
      const CommandLine line = CommandLine::parse(words);
      log::set_level(line.quiet     ? log::Level::quiet
                     : line.verbose ? log::Level::verbose
                                    : log::Level::normal);
      if (line.help || line.version)
        {
          if (parallel::rank() == 0)
            std::cout << (line.help ? CommandLine::help_text() : version_text() + "\n" + library_versions());
          return;
        }
      if (line.verb.empty())
        return run_file(line);
      if (parallel::rank() == 0)
        for (const Verb &verb : verbs())
          if (verb.name == line.verb)
            verb.run({ line.arguments, line.verb_options });
    }

    /// True if every rank gets here within a few seconds: then all failed alike and can leave in order.
    bool
    all_ranks_arrive(MPI_Comm communicator)
    {
      MPI_Request request;
      MPI_Ibarrier(communicator, &request);
      const auto start = std::chrono::steady_clock::now();
      int        done  = 0;
      while (!done && std::chrono::steady_clock::now() - start < std::chrono::seconds(5))
        {
          MPI_Test(&request, &done, MPI_STATUS_IGNORE);
          std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
      return done;
    }

    int
    fail(const int code, const std::string &message, MPI_Comm communicator)
    {
      const bool alone = parallel::size() == 1;
      if (parallel::rank() == 0)
        {
          log::to_file(message);
          log::close_file();
          std::cerr << "tribodraw: " << message << std::endl;
        }
      if (!alone && !all_ranks_arrive(communicator))
        {
          if (parallel::rank() != 0)
            std::cerr << "tribodraw, rank " << parallel::rank() << ": " << message << std::endl;
          // Unwinding one rank would leave the others waiting for ever.
          MPI_Abort(MPI_COMM_WORLD, code);
        }
      return code;
    }
  } // namespace

  namespace
  {
    std::string
    read_task_name(Parameters &parameters)
    {
      std::vector<std::string> names;
      std::string              documentation = "What to do.";
      for (const auto &[name, entry] : Registry<Task>::entries())
        {
          names.push_back(name);
          documentation += " `" + name + "`: " + entry.info.description;
        }
      return parameters.choice("Task", names, documentation);
    }
  } // namespace

  std::unique_ptr<Task>
  create_task(Parameters &parameters)
  {
    const auto entry = Registry<Task>::entries().find(read_task_name(parameters));
    if (entry == Registry<Task>::entries().end())
      return {};
    try
      {
        return entry->second.create(parameters);
      }
    catch (const InputError &error)
      {
        parameters.problem("", error.what());
        return {};
      }
  }

  std::vector<TaskEntries>
  document_all_tasks()
  {
    std::vector<TaskEntries> result;
    for (const auto &[name, entry] : Registry<Task>::entries())
      {
        Parameters parameters = Parameters::for_documentation();
        read_task_name(parameters);
        entry.create(parameters);
        result.push_back({ name, parameters.entries() });
      }
    return result;
  }

  int
  run_program(const int argc, char **argv)
  {
    // Without mpirun, Open MPI would start a daemon for processes that are never spawned: half a second, and an error where
    // no remote shell is installed. mpirun ignores this setting.
    setenv("OMPI_MCA_ess_singleton_isolated", "1", /*overwrite=*/0);
    // All processes started like that would share one session folder, and the first to end takes it away from one that is
    // just starting. A single process needs none.
    if (!getenv("OMPI_COMM_WORLD_SIZE"))
      setenv("OMPI_MCA_orte_create_session_dirs", "0", /*overwrite=*/0);
    const std::vector<std::string> words(argv + 1, argv + argc);
    // deal.II starts MPI, Trilinos and as many threads as the cores that this process may use. Our options are not theirs: some
    // releases of PETSc, which deal.II starts too, complain of what they do not know.
    char *name_only[] = { argv[0], nullptr };
    int   n_names     = 1;
    char **names       = name_only;
    std::optional<dealii::Utilities::MPI::MPI_InitFinalize> mpi;
    {
      const leaks::Ignored of_mpi;
      mpi.emplace(n_names, names, dealii::numbers::invalid_unsigned_int);
    }
    // Its own communicator, so that the wait of a failing rank meets nothing else.
    MPI_Comm communicator;
    MPI_Comm_dup(MPI_COMM_WORLD, &communicator);
    int code = exit_code::success;
    try
      {
        run_command_line(words);
      }
    catch (const InputError &error)
      {
        code = fail(exit_code::wrong_input, error.what(), communicator);
      }
    catch (const ConvergenceError &error)
      {
        code = fail(exit_code::not_converged, error.what(), communicator);
      }
    catch (const std::bad_alloc &)
      {
        code = fail(exit_code::internal, "The memory of this machine is not sufficient for this case.", communicator);
      }
    catch (const std::exception &error)
      {
        code = fail(exit_code::internal,
                    std::string("Internal error: ") + error.what()
                        + "\nThis is a fault of the program. Please report it with the parameter file, log.txt and "
                          "run_info.txt.",
                    communicator);
      }
    MPI_Comm_free(&communicator);
    leaks::check();
    return code;
  }
} // namespace tribodraw
