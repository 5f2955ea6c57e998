#include <tribodraw/application/provenance.h>
#include <tribodraw/base/errors.h>
#include <tribodraw/base/files.h>
#include <tribodraw/base/parallel.h>

#include <deal.II/base/config.h>

#include <Eigen/Core>
#include <Trilinos_version.h>
#include <dmumps_c.h>
#include <mpi.h>

#include <set>
#include <sstream>

namespace tribodraw
{
  namespace
  {
    std::string
    trim(const std::string &text)
    {
      const auto first = text.find_first_not_of(" \t\r");
      return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
    }
  } // namespace

  std::string
  version_text()
  {
    return std::string("tribodraw ") + TRIBODRAW_VERSION;
  }

  std::string
  library_versions()
  {
    char text[MPI_MAX_LIBRARY_VERSION_STRING];
    int  length = 0;
    MPI_Get_library_version(text, &length);
    const std::string mpi(text, length);
    return std::string("deal.II ") + DEAL_II_PACKAGE_VERSION + "\nTrilinos " + TRILINOS_VERSION_STRING + "\nMUMPS "
           + MUMPS_VERSION + "\nEigen " + std::to_string(EIGEN_WORLD_VERSION) + "."
           + std::to_string(EIGEN_MAJOR_VERSION) + "." + std::to_string(EIGEN_MINOR_VERSION) + "\nMPI "
           + mpi.substr(0, mpi.find_first_of(",\n")) + "\n";
  }

  std::map<std::string, std::string>
  effective_values(const std::string &effective)
  {
    std::map<std::string, std::string> values;
    std::vector<std::string>           open;
    std::istringstream                 in(effective);
    for (std::string raw; std::getline(in, raw);)
      {
        const std::string line = trim(raw.substr(0, raw.find('#')));
        if (line.rfind("subsection ", 0) == 0)
          open.push_back(trim(line.substr(11)));
        else if (line == "end" && !open.empty())
          open.pop_back();
        else if (const auto equals = line.find('='); line.rfind("set ", 0) == 0 && equals != std::string::npos)
          {
            std::string path;
            for (const auto &section : open)
              path += section + "/";
            values[path + trim(line.substr(4, equals - 4))] = trim(line.substr(equals + 1));
          }
      }
    return values;
  }

  std::map<std::string, std::string>
  input_hashes(const Parameters &parameters)
  {
    std::map<std::string, std::string> hashes;
    const auto                         values = effective_values(parameters.effective());
    for (const EntryInfo &entry : parameters.entries())
      if (const auto value = values.find(entry.path);
          entry.type == "file name" && value != values.end() && !value->second.empty())
        {
          const std::filesystem::path given = value->second;
          hashes[entry.path] = hash_text(read_file(given.is_absolute() ? given : parameters.base_folder() / given));
        }
    return hashes;
  }

  std::string
  run_info(const Parameters &parameters, const std::filesystem::path &parameter_file)
  {
    std::string text = version_text() + "\n" + library_versions() + "ranks " + std::to_string(parallel::size()) + "\n";
    text += "parameters " + hash_text(parameters.effective()) + " (effective.prm)\n";
    text += "input " + hash_text(read_file(parameter_file)) + " " + parameter_file.filename().string() + "\n";
    const auto values = effective_values(parameters.effective());
    for (const auto &[path, hash] : input_hashes(parameters))
      text += "input " + hash + " " + values.at(path) + " (" + path + ")\n";
    return text;
  }

  std::string
  citations(const Parameters &parameters)
  {
    std::string text = version_text()
                       + " (see CITATION.cff).\n"
                         "The friction model: M. Shisode, J. Hazrati, T. Mishra, M. de Rooij, T. van den Boogaard: "
                         "Mixed lubrication friction model "
                         "including surface texture effects for sheet metal forming. Journal of Materials Processing "
                         "Technology, 2021, "
                         "doi 10.1016/j.jmatprotec.2020.117035.\n"
                         "Finite elements: deal.II, doi 10.1515/jnma-2022-0054.\n";
    std::set<std::string> chosen;
    for (const auto &[path, value] : effective_values(parameters.effective()))
      chosen.insert(value);
    std::set<std::string> lines;
    for (const ModelInfo &model : all_registered_models())
      if (!model.citation.empty() && chosen.count(model.name) > 0)
        lines.insert(model.kind + " `" + model.name + "`: " + model.citation + "\n");
    for (const auto &line : lines)
      text += line;
    return text;
  }
} // namespace tribodraw
