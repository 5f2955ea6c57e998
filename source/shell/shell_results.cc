#include <tribodraw/base/errors.h>
#include <tribodraw/base/parallel.h>
#include <tribodraw/shell/shell.h>

#include <algorithm>
#include <cmath>

#include "implementation.h"

namespace tribodraw
{
  namespace
  {
    std::vector<double>
    flatten(const std::vector<Eigen::Vector3d> &vectors)
    {
      std::vector<double> numbers;
      numbers.reserve(3 * vectors.size());
      for (const Eigen::Vector3d &v : vectors)
        numbers.insert(numbers.end(), v.data(), v.data() + 3);
      return numbers;
    }

    std::vector<Eigen::Vector3d>
    to_vectors(const std::vector<double> &numbers)
    {
      std::vector<Eigen::Vector3d> vectors(numbers.size() / 3);
      for (std::size_t i = 0; i < vectors.size(); ++i)
        vectors[i] = Eigen::Map<const Eigen::Vector3d>(&numbers[3 * i]);
      return vectors;
    }

    /// Numbers of a plastic state in a checkpoint.
    constexpr std::size_t point_size = 4;
    /// Numbers of an element: thickness stretch and the fields of its summary that describe a state.
    constexpr std::size_t element_size = 6;
  } // namespace

  double
  Shell::Implementation::mean_eps_p(const std::vector<PlasticState> &points, const std::size_t k) const
  {
    double mean = 0;
    for (std::size_t point = 0; point < n_points(); ++point)
      mean += rule.weight[point % rule.weight.size()] * points[k * n_points() + point].eps_p;
    return mean / shell_element::n_in_plane;
  }

  double
  Shell::Implementation::max_eps_p(const std::size_t k) const
  {
    double largest = 0;
    for (std::size_t point = 0; point < n_points(); ++point)
      largest = std::max(largest, old_points[k * n_points() + point].eps_p);
    return largest;
  }

  void
  Shell::Implementation::update_derived()
  {
    const std::size_t   n = mesh.nodes.size();
    std::vector<double> sums(2 * n + 1, 0.);
    for (std::size_t k = 0; k < owned().size(); ++k)
      {
        const unsigned element = owned()[k];
        const double   eps_p   = mean_eps_p(old_points, k);
        for (const unsigned node : mesh.triangles[element])
          {
            const double share = element_area[element] / 3 / node_area[node];
            sums[node] += share * stretch[k];
            sums[n + node] += share * eps_p;
          }
        sums[2 * n] += old_summary[k].elastic_energy;
      }
    parallel::sum(sums);
    node_thickness.resize(n);
    for (std::size_t node = 0; node < n; ++node)
      node_thickness[node] = thickness * sums[node];
    node_eps_p.assign(sums.begin() + static_cast<std::ptrdiff_t>(n), sums.end() - 1);
    elastic_energy = sums.back();
  }

  template <class Function>
  std::vector<double>
  Shell::Implementation::gather(const Function &value_of_owned) const
  {
    std::vector<double> values(mesh.triangles.size(), 0.);
    for (std::size_t k = 0; k < owned().size(); ++k)
      values[owned()[k]] = value_of_owned(k);
    parallel::sum(values);
    return values;
  }

  const std::vector<double> &
  Shell::node_thickness() const
  {
    return data->node_thickness;
  }

  const std::vector<double> &
  Shell::node_eps_p() const
  {
    return data->node_eps_p;
  }

  std::vector<double>
  Shell::trial_node_eps_p() const
  {
    const Implementation &d = *data;
    if (!d.assembled)
      throw std::logic_error("Shell::trial_node_eps_p: the trial configuration was not assembled (or not successfully).");
    std::vector<double> sums(d.mesh.nodes.size(), 0.);
    for (std::size_t k = 0; k < d.owned().size(); ++k)
      {
        const unsigned element = d.owned()[k];
        const double   share   = d.element_area[element] / 3 * d.mean_eps_p(d.new_points, k);
        for (const unsigned node : d.mesh.triangles[element])
          sums[node] += share / d.node_area[node];
      }
    parallel::sum(sums);
    return sums;
  }

  const std::vector<double> &
  Shell::node_reference_area() const
  {
    return data->node_area;
  }

  Shell::ElementResults
  Shell::element_results() const
  {
    const Implementation &d                = *data;
    const auto            principal_strain = [&d](const std::size_t k, const double sign) {
      const Vector3 C
          = shell_element::mid_surface_metric(d.reference[k], d.node_state(d.owned()[k], d.committed).position);
      const double mean = 0.5 * (C[0] + C[1]);
      return 0.5 * std::log(mean + sign * std::hypot(0.5 * (C[0] - C[1]), C[2]));
    };
    const auto stress = [&d](const int component) {
      return d.gather([&d, component](const std::size_t k) { return d.old_summary[k].mean_stress[component]; });
    };
    ElementResults results;
    results.thickness          = d.gather([&d](const std::size_t k) { return d.thickness * d.stretch[k]; });
    results.eps_p              = d.gather([&d](const std::size_t k) { return d.mean_eps_p(d.old_points, k); });
    results.max_eps_p          = d.gather([&d](const std::size_t k) { return d.max_eps_p(k); });
    results.major_strain       = d.gather([&](const std::size_t k) { return principal_strain(k, 1); });
    results.minor_strain       = d.gather([&](const std::size_t k) { return principal_strain(k, -1); });
    results.membrane_stress_xx = stress(0);
    results.membrane_stress_yy = stress(1);
    results.membrane_stress_xy = stress(2);
    return results;
  }

  Shell::Layers
  Shell::layers() const
  {
    const Implementation &d = *data;
    const std::size_t     n = d.rule.point.size(), n_numbers = 13;
    std::vector<double>   sums(d.mesh.triangles.size() * n * n_numbers, 0.);
    for (std::size_t k = 0; k < d.owned().size(); ++k)
      {
        const PlasticState *states = &d.old_points[k * d.n_points()];
        const auto          points
            = shell_element::points_in_space(d.reference[k], d.node_state(d.owned()[k], d.committed),
                                             { d.thickness, d.stretch[k], &d.rule, d.material.get() }, states);
        for (std::size_t q = 0; q < points.size(); ++q)
          {
            double *layer = &sums[(d.owned()[k] * n + q % n) * n_numbers];
            for (unsigned c = 0; c < 6; ++c)
              {
                layer[c] += points[q].stress[c] / shell_element::n_in_plane;
                layer[6 + c] += points[q].strain[c] / shell_element::n_in_plane;
              }
            layer[12] += states[q].eps_p / shell_element::n_in_plane;
          }
      }
    parallel::sum(sums);
    Layers layers;
    for (const double point : d.rule.point)
      layers.place.push_back(point);
    for (std::size_t i = 0; i < sums.size(); i += n_numbers)
      {
        layers.stress.push_back({ sums[i], sums[i + 1], sums[i + 2], sums[i + 3], sums[i + 4], sums[i + 5] });
        layers.strain.push_back({ sums[i + 6], sums[i + 7], sums[i + 8], sums[i + 9], sums[i + 10], sums[i + 11] });
        layers.eps_p.push_back(sums[i + 12]);
      }
    return layers;
  }

  double
  Shell::elastic_energy() const
  {
    return data->elastic_energy;
  }

  double
  Shell::plastic_work() const
  {
    return data->plastic_work;
  }

  void
  Shell::save(Archive &archive) const
  {
    const Implementation &d = *data;
    archive.put("shell/thickness points", static_cast<double>(d.rule.point.size()));
    archive.put("shell/position", flatten(d.committed.position));
    archive.put("shell/director", flatten(d.committed.director));
    for (unsigned t = 0; t < 2; ++t)
      {
        std::vector<Eigen::Vector3d> tangents;
        for (const std::array<Eigen::Vector3d, 2> &frame : d.committed.frame)
          tangents.push_back(frame[t]);
        archive.put("shell/frame " + std::to_string(t + 1), flatten(tangents));
      }

    std::vector<double> elements(n_elements() * element_size, 0.), points(n_elements() * d.n_points() * point_size, 0.);
    for (std::size_t k = 0; k < d.owned().size(); ++k)
      {
        const shell_element::Summary &summary = d.old_summary[k];
        const double state[element_size]{ d.stretch[k],           summary.mean_stress[0],   summary.mean_stress[1],
                                          summary.mean_stress[2], summary.thickness_strain, summary.elastic_energy };
        std::copy_n(state, element_size, &elements[d.owned()[k] * element_size]);
        for (std::size_t p = 0; p < d.n_points(); ++p)
          {
            const PlasticState &point = d.old_points[k * d.n_points() + p];
            double             *to    = &points[(d.owned()[k] * d.n_points() + p) * point_size];
            std::copy_n(point.plastic_strain.data(), 3, to);
            to[3] = point.eps_p;
          }
      }
    parallel::sum(elements);
    parallel::sum(points);
    archive.put("shell/elements", std::move(elements));
    archive.put("shell/points", std::move(points));
    archive.put("shell/plastic work", d.plastic_work);
  }

  void
  Shell::load(const Archive &archive)
  {
    Implementation &d = *data;
    if (archive.number("shell/thickness points") != static_cast<double>(d.rule.point.size()))
      throw InputError(describe_error("The checkpoint was written with another number of thickness points.", "shell",
                                      std::to_string(static_cast<int>(archive.number("shell/thickness points"))),
                                      std::to_string(d.rule.point.size())));
    Configuration c;
    c.position = to_vectors(archive.numbers("shell/position", 3 * n_nodes()));
    c.director = to_vectors(archive.numbers("shell/director", 3 * n_nodes()));
    c.frame.resize(n_nodes());
    for (unsigned t = 0; t < 2; ++t)
      {
        const auto tangents = to_vectors(archive.numbers("shell/frame " + std::to_string(t + 1), 3 * n_nodes()));
        for (unsigned node = 0; node < n_nodes(); ++node)
          c.frame[node][t] = tangents[node];
      }
    const auto &elements = archive.numbers("shell/elements", n_elements() * element_size);
    const auto &points   = archive.numbers("shell/points", n_elements() * d.n_points() * point_size);
    for (std::size_t k = 0; k < d.owned().size(); ++k)
      {
        const double *state               = &elements[d.owned()[k] * element_size];
        d.stretch[k]                      = state[0];
        d.old_summary[k].mean_stress      = Eigen::Map<const Vector3>(state + 1);
        d.old_summary[k].thickness_strain = state[4];
        d.old_summary[k].elastic_energy   = state[5];
        for (std::size_t p = 0; p < d.n_points(); ++p)
          {
            const double *from   = &points[(d.owned()[k] * d.n_points() + p) * point_size];
            PlasticState &point  = d.old_points[k * d.n_points() + p];
            point.plastic_strain = Eigen::Map<const Vector3>(from);
            point.eps_p          = from[3];
          }
      }
    d.plastic_work = archive.number("shell/plastic work");
    d.committed    = c;
    d.trial        = c;
    d.assembled    = false;
    d.update_derived();
  }
} // namespace tribodraw
