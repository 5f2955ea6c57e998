#include <tribodraw/base/archive.h>
#include <tribodraw/lubrication/lubricated_face.h>

namespace tribodraw
{
  namespace
  {
    // All numbers of a node and of the figures in one order, for writing and reading.
    template <class Node, class Do>
    void
    numbers_of_node(Node &node, const Do &apply)
    {
      for (auto *x : { &node.cut_height, &node.eps_p, &node.nominal_pressure, &node.solid_pressure,
                       &node.lubricant_pressure, &node.friction_coefficient, &node.film_thickness, &node.supplied_film,
                       &node.contact_fraction, &node.opening_rate, &node.lift })
        apply(*x);
      for (int i = 0; i < 4; ++i)
        {
          apply(node.phi_p(i / 2, i % 2));
          apply(node.phi_s(i / 2, i % 2));
        }
    }

    template <class Statistics, class Do>
    void
    numbers_of_figures(Statistics &f, const Do &apply)
    {
      for (auto *x : { &f.contact_area, &f.load_share, &f.starved_area_fraction, &f.capped_area_fraction,
                       &f.max_lubricant_pressure, &f.nominal_pressure_there, &f.mean_friction, &f.min_film, &f.max_film,
                       &f.opening_volume, &f.oscillation, &f.supplied_volume, &f.volume, &f.left_volume,
                       &f.volume_error, &f.film_change })
        apply(*x);
    }

    constexpr std::size_t numbers_per_node = 19 + 2;
    constexpr std::size_t n_figures        = 16 + 9;
  } // namespace

  void
  LubricatedFace::save(Archive &archive, const std::string &name) const
  {
    const Statistics   &figures = accepted.figures;
    std::vector<double> nodes, motion, figure;
    for (const Node &node : accepted.nodes)
      {
        numbers_of_node(node, [&](const double x) { nodes.push_back(x); });
        nodes.push_back(node.table);
        nodes.push_back(static_cast<int>(node.regime));
      }
    for (const auto &s : accepted.slid)
      motion.insert(motion.end(), { s[0], s[1], s[2] });
    numbers_of_figures(figures, [&](const double x) { figure.push_back(x); });
    figure.insert(figure.end(),
                  { double(figures.max_node), double(figures.n_clamped_friction), double(figures.active_set_iterations),
                    double(figures.film_iterations), double(figures.converged), double(figures.n_unsettled),
                    accepted.elapsed, accepted.travelled, double(accepted.n_updates) });
    archive.put(name + "/nodes", std::move(nodes));
    archive.put(name + "/motion", std::move(motion));
    archive.put(name + "/figures", std::move(figure));
    archive.put(name + "/supply", supply);
    if (transport)
      archive.put(name + "/volume", accepted.volume);
    archive.put(name + "/touched", accepted.touched);
    for (int k = 0; k < 2; ++k)
      archive.put(name + "/earlier pressure " + std::to_string(k + 1),
                  accepted.earlier_pressure[k].empty() ? std::vector<double>(accepted.nodes.size(), 0.)
                                                       : accepted.earlier_pressure[k]);
  }

  void
  LubricatedFace::load(const Archive &archive, const std::string &name)
  {
    forget_attempt();
    State            &state  = accepted;
    const std::size_t n      = state.nodes.size();
    const auto       *number = archive.numbers(name + "/nodes", numbers_per_node * n).data();
    for (Node &node : state.nodes)
      {
        numbers_of_node(node, [&](double &x) { x = *number++; });
        node.table  = static_cast<int>(*number++);
        node.regime = static_cast<Regime>(static_cast<int>(*number++));
      }
    const auto &motion = archive.numbers(name + "/motion", 3 * n);
    for (std::size_t i = 0; i < n; ++i)
      state.slid[i] = { motion[3 * i], motion[3 * i + 1], motion[3 * i + 2] };
    const double *figure = archive.numbers(name + "/figures", n_figures).data();
    numbers_of_figures(state.figures, [&](double &x) { x = *figure++; });
    state.figures.max_node              = static_cast<int>(*figure++);
    state.figures.n_clamped_friction    = static_cast<unsigned>(*figure++);
    state.figures.active_set_iterations = static_cast<unsigned>(*figure++);
    state.figures.film_iterations       = static_cast<unsigned>(*figure++);
    state.figures.converged             = *figure++ != 0;
    state.figures.n_unsettled           = static_cast<unsigned>(*figure++);
    state.elapsed                       = *figure++;
    state.travelled                     = *figure++;
    state.n_updates                     = static_cast<unsigned>(*figure++);
    state.touched                       = archive.numbers(name + "/touched", n);
    supply                              = archive.numbers(name + "/supply", n);
    if (transport)
      state.volume = archive.numbers(name + "/volume", n);
    for (int k = 0; k < 2; ++k)
      state.earlier_pressure[k] = archive.numbers(name + "/earlier pressure " + std::to_string(k + 1), n);
  }
} // namespace tribodraw
