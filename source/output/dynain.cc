// LS-DYNA keyword manual, volume I: *NODE, *ELEMENT_SHELL_THICKNESS, *INITIAL_STRESS_SHELL, *INITIAL_STRAIN_SHELL.
#include <tribodraw/base/files.h>
#include <tribodraw/base/parallel.h>
#include <tribodraw/output/dynain.h>

#include <algorithm>
#include <cstdio>

namespace tribodraw
{
  namespace
  {
    constexpr unsigned part = 1;

    /// Appends formatted fields of fixed width to a text.
    class Card
    {
    public:
      explicit Card(std::string &output) : text(output) {}
      ~Card() { text += '\n'; }

      Card &
      whole(const unsigned width, const std::size_t value)
      {
        const std::string digits = std::to_string(value);
        text += std::string(width - std::min<std::size_t>(width, digits.size()), ' ') + digits;
        return *this;
      }
      Card &
      real(const unsigned width, const unsigned digits, const double value)
      {
        char buffer[64];
        std::snprintf(buffer, sizeof buffer, "%*.*E", static_cast<int>(width), static_cast<int>(digits), value);
        text += buffer;
        return *this;
      }

    private:
      std::string &text;
    };
  } // namespace

  void
  write_dynain(const std::filesystem::path &file, const Shell &shell, const std::string &title)
  {
    const Shell::Layers layers = shell.layers(); // of all ranks
    if (parallel::rank() != 0)
      return;
    const std::size_t          n_layers  = layers.place.size();
    const auto                &triangles = shell.mesh().triangles;
    const std::vector<double> &thickness = shell.node_thickness();
    std::string                text      = "*KEYWORD\n$ " + title + "\n$ units: mm, N, MPa, s, tonne\n*NODE\n";
    for (unsigned i = 0; i < shell.n_nodes(); ++i)
      {
        const Eigen::Vector3d &x = shell.committed().position[i];
        Card(text).whole(8, i + 1).real(16, 8, x[0]).real(16, 8, x[1]).real(16, 8, x[2]);
      }
    text += "*ELEMENT_SHELL_THICKNESS\n";
    for (std::size_t e = 0; e < triangles.size(); ++e)
      {
        const auto &t = triangles[e];
        Card(text)
            .whole(8, e + 1)
            .whole(8, part)
            .whole(8, t[0] + 1)
            .whole(8, t[1] + 1)
            .whole(8, t[2] + 1)
            .whole(8, t[2] + 1);
        Card(text)
            .real(16, 8, thickness[t[0]])
            .real(16, 8, thickness[t[1]])
            .real(16, 8, thickness[t[2]])
            .real(16, 8, thickness[t[2]]);
      }
    // One point in the plane, all layers, no history variables; the last field asks for the wide format (16 columns,
    // five fields a card), because ten columns leave four digits.
    const auto wide = [&text](const std::vector<double> &values) {
      for (std::size_t first = 0; first < values.size(); first += 5)
        {
          Card card(text);
          for (std::size_t k = first; k < std::min(first + 5, values.size()); ++k)
            card.real(16, 8, values[k]);
        }
    };
    text += "*INITIAL_STRESS_SHELL\n";
    for (std::size_t e = 0; e < triangles.size(); ++e)
      {
        Card(text).whole(10, e + 1).whole(10, 1).whole(10, n_layers).whole(10, 0).whole(10, 0).whole(10, 1);
        for (std::size_t l = 0; l < n_layers; ++l)
          {
            const auto &s = layers.stress[e * n_layers + l];
            wide({ layers.place[l], s[0], s[1], s[2], s[3], s[4], s[5], layers.eps_p[e * n_layers + l] });
          }
      }
    text += "*INITIAL_STRAIN_SHELL\n";
    for (std::size_t e = 0; e < triangles.size(); ++e)
      {
        Card(text).whole(10, e + 1).whole(10, 1).whole(10, n_layers).whole(10, 1);
        for (std::size_t l = 0; l < n_layers; ++l)
          {
            const auto &s = layers.strain[e * n_layers + l];
            wide({ s[0], s[1], s[2], s[3], s[4], s[5], layers.place[l] });
          }
      }
    text += "*END\n";
    write_file(file, text);
  }
} // namespace tribodraw
