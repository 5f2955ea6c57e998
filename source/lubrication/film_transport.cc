#include "film_factors.h"
#include "film_geometry.h"
#include "film_terms.h"

#include <tribodraw/base/errors.h>
#include <tribodraw/base/sparse_system.h>
#include <tribodraw/base/timing.h>
#include <tribodraw/lubrication/film_transport.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace tribodraw
{
  namespace
  {
    constexpr unsigned max_iterations  = 200;
    constexpr unsigned patience        = 8;     // steps without fewer wrong nodes before single nodes are changed
    constexpr double   fill_tolerance  = 1e-12; // of a full gap
    constexpr double   small_tolerance = 1e-12; // of the greatest pressure or flow
    constexpr double   sealed_film_compressibility = 1e-9; // of the conductance of a node

    using Kind = FilmTransport::Kind;

    enum class State : std::uint8_t
    {
      starved,
      full,
      lifted,
      overflow,  // border with a full gap: the excess leaves
      prescribed // reservoir
    };
  } // namespace

  struct FilmTransport::Implementation
  {
    FilmGeometry                    geometry;
    double                          phi_p_floor;
    SparseMatrix                    matrix;
    std::vector<std::array<int, 9>> positions; // of the entries of each triangle in the values of the matrix
    FilmFactors                     solver;

    // the present problem
    struct CellFlow
    {
      Eigen::Matrix3d       conductance;
      std::array<double, 3> transport; // from node e to node e+1 at theta = 1 [mm^3/s]
    };
    const std::vector<NodeData> *nodes = nullptr;
    double                       dt    = steady;
    Eigen::VectorXd              area, capacity; // of the gap at theta = 1 [mm^3]; of a carried node its area
    Eigen::VectorXd              donor; // gap at theta = 1 / gap of the flow: transport at theta = 1 in parts of F
    std::vector<unsigned>        segment; // of the gap curve of a full node
    std::vector<CellFlow>        flow;
    std::vector<State>           state;
    Eigen::VectorXd              p, theta, drain; // drain: transport out of a node at theta = 1
    double                       pressure_scale = 1, flow_scale = 1;

    Implementation(const std::vector<Eigen::Vector3d> &reference, const std::vector<std::array<unsigned, 3>> &triangles,
                   const double floor)
        : geometry(reference, triangles), phi_p_floor(floor)
    {
      matrix = SparseMatrix(geometry.node_columns());
      for (const auto &cell : geometry.cells())
        {
          std::array<int, 9> position;
          for (unsigned i = 0; i < 3; ++i)
            for (unsigned j = 0; j < 3; ++j)
              position[3 * i + j]
                  = static_cast<int>(matrix.position(static_cast<int>(cell.node[i]), static_cast<int>(cell.node[j])));
          positions.push_back(position);
        }
    }

    std::size_t
    size() const
    {
      return geometry.n_nodes();
    }
    const NodeData &
    node(const std::size_t i) const
    {
      return (*nodes)[i];
    }

    void
    check() const
    {
      const auto wrong = [](const std::size_t i, const std::string &what, const std::string &value,
                            const std::string &allowed) {
        throw InputError(describe_error(what, "node " + std::to_string(i) + " of the film transport", value, allowed));
      };
      if (nodes->size() != size())
        throw InputError(describe_error("Wrong number of nodal data for the film", "film transport",
                                        std::to_string(nodes->size()), std::to_string(size())));
      for (std::size_t i = 0; i < size(); ++i)
        {
          const NodeData &n = node(i);
          if (n.kind == Kind::carried && !std::isfinite(dt))
            wrong(i, "A node without tool collects lubricant for ever in the steady state", "carried",
                  "a finite time step");
          if (n.kind != Kind::carried && !(n.film > 0 && n.viscosity > 0))
            wrong(i, "A node of the film has no gap or no viscosity",
                  "gap " + std::to_string(n.film) + " mm, viscosity " + std::to_string(n.viscosity) + " MPa s",
                  "above zero");
          if (!std::isfinite(n.inflow) || !std::isfinite(n.old_volume) || n.old_volume < 0)
            wrong(i, "The lubricant at a node of the film is not a volume",
                  std::to_string(n.old_volume) + " mm^3, inflow " + std::to_string(n.inflow) + " mm^3/s",
                  "zero or more");
        }
    }

    /// Conductances and transports of all triangles.
    void
    integrate()
    {
      std::vector<FilmCoefficient> coefficient;
      coefficient.reserve(size());
      for (const NodeData &n : *nodes)
        {
          coefficient.push_back(film_coefficient(n, phi_p_floor));
          if (n.kind == Kind::carried)
            coefficient.back().has_film = false;
        }
      flow.assign(geometry.cells().size(), { Eigen::Matrix3d::Zero(), { 0, 0, 0 } });
      drain           = Eigen::VectorXd::Zero(size());
      double greatest = 0, transport = 0;
      for (std::size_t c = 0; c < flow.size(); ++c)
        {
          const auto                            &cell = geometry.cells()[c];
          std::array<const FilmCoefficient *, 3> local;
          for (unsigned i = 0; i < 3; ++i)
            local[i] = &coefficient[cell.node[i]];
          if (!local[0]->has_film && !local[1]->has_film && !local[2]->has_film)
            continue;
          const FilmTerms terms = film_terms(cell, geometry.quadrature(), local);
          flow[c].conductance   = cell.material_gradient.transpose() * terms.mobility * cell.material_gradient;
          greatest              = std::max(greatest, flow[c].conductance.diagonal().maxCoeff());
          for (unsigned e = 0; e < 3; ++e)
            {
              // The face between the dual cells of two nodes has the area-weighted normal A (grad N_j - grad N_i)/3.
              const unsigned i = e, j = (e + 1) % 3;
              double         q = (cell.material_gradient.col(j) - cell.material_gradient.col(i)).dot(terms.flux) / 3.;
              const unsigned from = q > 0 ? cell.node[i] : cell.node[j];
              if (node(from).kind == Kind::carried)
                q = 0; // what lies on the free sheet moves with it
              q *= donor[from];
              flow[c].transport[e] = q;
              drain[from] += std::abs(q);
              transport += std::abs(q);
            }
        }
      flow_scale     = transport;
      pressure_scale = greatest > 0 && drain.maxCoeff() > 0 ? drain.maxCoeff() / greatest : 1.;
    }

    double
    storage(const std::size_t i) const
    {
      return std::isfinite(dt) ? capacity[i] / dt : 0.;
    }
    bool
    pressure_is_unknown(const std::size_t i) const
    {
      return state[i] == State::full;
    }
    unsigned
    last_segment(const std::size_t i) const
    {
      return std::max(2u, node(i).closed.n) - 2;
    }
    /// d theta / d p in the present segment of the gap curve.
    double
    yielding(const std::size_t i) const
    {
      const GapCurve &curve = node(i).closed;
      if (curve.n < 2)
        return 0.;
      const unsigned k = segment[i];
      return (curve.gap[k + 1] - curve.gap[k]) / (curve.pressure[k + 1] - curve.pressure[k]) / curve.gap[0];
    }
    /// Film fraction of a full node at pressure p, in the present segment of the gap curve.
    double
    full_theta(const std::size_t i, const double pressure) const
    {
      const GapCurve &curve = node(i).closed;
      if (curve.n < 2)
        return 1.;
      return curve.gap[segment[i]] / curve.gap[0] + yielding(i) * (pressure - curve.pressure[segment[i]]);
    }
    /// Film fraction from which on the node is lifted.
    double
    greatest_theta(const std::size_t i) const
    {
      const GapCurve &curve = node(i).closed;
      return curve.n < 2 ? 1. : curve.gap[curve.n - 1] / curve.gap[0];
    }
    bool
    is_unknown(const std::size_t i) const
    {
      return state[i] == State::starved || state[i] == State::full || state[i] == State::lifted;
    }

    void
    start_sets(const Result *start)
    {
      p     = Eigen::VectorXd::Zero(size());
      theta = Eigen::VectorXd::Ones(size());
      segment.assign(size(), 0);
      state.assign(size(), State::full);
      const bool warm = start != nullptr && start->pressure.size() == size();
      for (std::size_t i = 0; i < size(); ++i)
        switch (node(i).kind)
          {
          case Kind::reservoir:
            state[i] = State::prescribed;
            p[i]     = node(i).fixed_pressure;
            break;
          case Kind::carried:
            state[i] = State::starved;
            break;
          case Kind::border:
            state[i] = warm && start->fill[i] < 1. ? State::starved : State::overflow;
            break;
          case Kind::film:
            if (node(i).p_limit <= 0)
              state[i] = State::lifted;
            else if (std::isfinite(dt) && node(i).old_volume < capacity[i])
              state[i] = State::starved;
            if (warm)
              state[i] = start->pressure[i] > 0 && start->pressure[i] < node(i).p_limit ? State::full
                         : start->fill[i] > 1. || node(i).p_limit <= 0                  ? State::lifted
                                                                                        : State::starved;
            if (warm && state[i] == State::full)
              segment[i] = node(i).closed.segment(start->pressure[i]);
          }
    }

    /// Net flow out of each node for the present pressures and film fractions, without what crosses the border.
    Eigen::VectorXd
    balance() const
    {
      Eigen::VectorXd r(size());
      for (std::size_t i = 0; i < size(); ++i)
        r[i] = (std::isfinite(dt) ? (capacity[i] * theta[i] - node(i).old_volume) / dt : 0.) - node(i).inflow;
      for (std::size_t c = 0; c < flow.size(); ++c)
        {
          const auto           &n = geometry.cells()[c].node;
          const Eigen::Vector3d q = flow[c].conductance * Eigen::Vector3d(p[n[0]], p[n[1]], p[n[2]]);
          for (unsigned e = 0; e < 3; ++e)
            {
              const unsigned i = n[e], j = n[(e + 1) % 3];
              const double   t      = flow[c].transport[e];
              const double   across = t * theta[t > 0 ? i : j];
              r[i] += q[e] + across;
              r[j] -= across;
            }
        }
      return r;
    }

    /// In the steady state a starved node from which nothing is carried away keeps what it has, unless something
    /// arrives.
    bool
    is_idle(const std::size_t i) const
    {
      return state[i] == State::starved && !std::isfinite(dt) && drain[i] <= 1e-14 * flow_scale;
    }

    /// d theta / d (unknown of the node); zero if theta is known.
    double
    theta_per_unknown(const std::size_t i, const std::vector<bool> &idle) const
    {
      return pressure_is_unknown(i) ? yielding(i) * pressure_scale : is_unknown(i) && !idle[i] ? 1. : 0.;
    }

    bool
    solve_linear()
    {
      matrix.set_zero();
      auto             &value   = matrix.values();
      Eigen::VectorXd   known_p = p, known_theta = theta;
      std::vector<bool> idle(size());
      for (std::size_t i = 0; i < size(); ++i)
        {
          idle[i] = is_idle(i);
          if (pressure_is_unknown(i))
            {
              p[i]     = 0;
              theta[i] = full_theta(i, 0.);
            }
          else if (is_unknown(i) && !idle[i])
            theta[i] = 0;
        }
      Eigen::VectorXd rhs = -balance();
      for (std::size_t c = 0; c < flow.size(); ++c)
        {
          const auto &n = geometry.cells()[c].node;
          for (unsigned i = 0; i < 3; ++i)
            {
              for (unsigned j = 0; j < 3; ++j)
                if (pressure_is_unknown(n[j]))
                  value[positions[c][3 * i + j]] += flow[c].conductance(i, j) * pressure_scale;
              const unsigned to    = (i + 1) % 3;
              const double   t     = flow[c].transport[i];
              const unsigned from = t > 0 ? i : to, receiver = t > 0 ? to : i;
              if (const double change = theta_per_unknown(n[from], idle); change > 0)
                {
                  value[positions[c][3 * from + from]] += std::abs(t) * change;
                  value[positions[c][3 * receiver + from]] -= std::abs(t) * change;
                }
            }
        }
      for (int i = 0; i < matrix.size(); ++i)
        {
          const std::size_t diagonal = matrix.position(i, i);
          if (is_unknown(i) && !idle[i])
            {
              value[diagonal] += storage(i) * theta_per_unknown(static_cast<std::size_t>(i), idle);
              continue;
            }
          for (std::size_t k = matrix.row_start()[i]; k < matrix.row_start()[i + 1]; ++k)
            value[k] = 0;
          value[diagonal] = 1;
          rhs[i]          = 0;
        }
      if (!solve_regularised(rhs))
        return false;
      for (std::size_t i = 0; i < size(); ++i)
        if (pressure_is_unknown(i))
          {
            p[i]     = rhs[i] * pressure_scale;
            theta[i] = full_theta(i, p[i]);
          }
        else if (is_unknown(i) && !idle[i])
          theta[i] = rhs[i];
      return rhs.allFinite();
    }

    /// A film that is full and sealed all around has no definite pressure level: a slight compressibility finds on
    /// which side of the bounds it lies, after which the sets change and the system is regular again.
    bool
    solve_regularised(Eigen::VectorXd &rhs)
    {
      if (solver.solve(matrix, rhs))
        return true;
      for (int i = 0; i < matrix.size(); ++i)
        if (pressure_is_unknown(i))
          matrix.values()[matrix.position(i, i)] *= 1. + sealed_film_compressibility;
      return solver.solve(matrix, rhs);
    }

    /// The state in which a node should be, judged by the present solution.
    State
    wanted(const std::size_t i, const double residual, const double p_max) const
    {
      const NodeData &n = node(i);
      switch (state[i])
        {
        case State::full:
          return segment[i] == 0 && p[i] < -small_tolerance * p_max                                          ? State::starved
                 : segment[i] == last_segment(i) && p[i] > n.p_limit * (1. + small_tolerance) && p[i] > n.p_limit ? State::lifted
                                                                                                             : State::full;
        case State::lifted:
          return theta[i] < greatest_theta(i) - fill_tolerance ? (n.p_limit > 0 ? State::full : State::starved)
                                                               : State::lifted;
        case State::overflow:
          return residual > small_tolerance * flow_scale ? State::starved : State::overflow; // residual = -outflow
        case State::starved:
          if (n.kind == Kind::carried)
            return State::starved;
          if (theta[i] > 1. + fill_tolerance || (is_idle(i) && residual < -small_tolerance * flow_scale))
            return n.kind == Kind::border ? State::overflow : n.p_limit > 0 ? State::full : State::lifted;
          return State::starved;
        case State::prescribed:
          break;
        }
      return state[i];
    }

    /// The segment of the gap curve in which a full node should be.
    unsigned
    wanted_segment(const std::size_t i, const double p_max) const
    {
      const GapCurve &curve = node(i).closed;
      if (state[i] != State::full || curve.n < 3)
        return segment[i];
      // One segment at a time: the curve rises, so the solution lies on that side.
      const double margin = small_tolerance * p_max;
      if (segment[i] > 0 && p[i] < curve.pressure[segment[i]] - margin)
        return segment[i] - 1;
      return segment[i] < last_segment(i) && p[i] > curve.pressure[segment[i] + 1] + margin ? segment[i] + 1 : segment[i];
    }

    struct Change
    {
      std::size_t node;
      State       state;
      unsigned    segment;
    };

    void
    enter(const Change &change)
    {
      const std::size_t i = change.node;
      if (change.state == State::full)
        segment[i] = state[i] == State::lifted ? last_segment(i) : state[i] == State::full ? change.segment : 0;
      state[i] = change.state;
      if (change.state == State::starved)
        p[i] = 0;
      else if (change.state == State::lifted)
        p[i] = node(i).p_limit;
      else if (change.state == State::overflow)
        {
          theta[i] = 1;
          p[i]     = 0;
        }
    }

    /// All wrong nodes change at once; if their number does not fall for a while, one at a time (Murty's least index).
    unsigned
    find_sets()
    {
      for (std::size_t i = 0; i < size(); ++i)
        if (state[i] == State::lifted)
          p[i] = node(i).p_limit;
      std::size_t fewest = size() + 1;
      unsigned    stuck  = 0;
      for (unsigned iteration = 1; iteration <= max_iterations; ++iteration)
        {
          if (!solve_linear())
            return 0;
          const Eigen::VectorXd r     = balance();
          const double          p_max = p.cwiseAbs().maxCoeff();
          std::vector<Change>   wrong;
          for (std::size_t i = 0; i < size(); ++i)
            {
              const State    next      = wanted(i, r[i], p_max);
              const unsigned next_line = wanted_segment(i, p_max);
              if (next != state[i] || next_line != segment[i])
                wrong.push_back({ i, next, next_line });
            }
          if (wrong.empty())
            return iteration;
          stuck  = wrong.size() < fewest ? 0 : stuck + 1;
          fewest = std::min(fewest, wrong.size());
          if (stuck > patience)
            wrong.erase(wrong.begin() + 1, wrong.end());
          for (const Change &change : wrong)
            enter(change);
        }
      return 0;
    }

    Result
    report(const unsigned iterations) const
    {
      Result result;
      result.iterations = iterations;
      result.converged  = iterations > 0;
      const auto list   = [](const Eigen::VectorXd &v) { return std::vector<double>(v.data(), v.data() + v.size()); };
      result.pressure   = list(p);
      result.fill       = list(theta);
      result.volume     = list(capacity.cwiseProduct(theta));
      result.outflow.assign(size(), 0.);
      const Eigen::VectorXd r   = balance();
      double                out = 0, in = 0, before = 0, now = 0;
      for (std::size_t i = 0; i < size(); ++i)
        {
          if (state[i] == State::overflow || state[i] == State::prescribed)
            result.outflow[i] = -r[i];
          out += result.outflow[i];
          in += node(i).inflow;
          now += result.volume[i];
          before += node(i).old_volume;
        }
      const double error  = std::isfinite(dt) ? (now - before) - (in - out) * dt : in - out;
      const double amount = std::isfinite(dt) ? std::max(now, before) : flow_scale;
      result.volume_error = amount > 0 ? std::abs(error) / amount : 0.;
      return result;
    }
  };

  double
  FilmTransport::GapCurve::at(const double p) const
  {
    const unsigned k      = segment(p);
    const double   weight = std::clamp((p - pressure[k]) / (pressure[k + 1] - pressure[k]), 0., 1.);
    return gap[k] + weight * (gap[k + 1] - gap[k]);
  }

  unsigned
  FilmTransport::GapCurve::segment(const double p) const
  {
    unsigned k = 0;
    while (k + 2 < n && p > pressure[k + 1])
      ++k;
    return k;
  }

  FilmTransport::FilmTransport(const std::vector<Eigen::Vector3d>         &reference,
                               const std::vector<std::array<unsigned, 3>> &triangles, const double phi_p_floor)
      : data(std::make_unique<Implementation>(reference, triangles, phi_p_floor))
  {
  }

  FilmTransport::~FilmTransport() = default;

  FilmTransport::Result
  FilmTransport::solve(const std::vector<Eigen::Vector3d> &positions, const std::vector<NodeData> &nodes,
                       const double dt, const Result *start) const
  {
    const timing::Scope timer("lubrication/film transport");
    Implementation     &d = *data;
    d.nodes               = &nodes;
    d.dt                  = dt;
    d.check();
    d.geometry.move_to(positions);
    d.area     = d.geometry.nodal_area();
    d.capacity = d.area;
    d.donor    = Eigen::VectorXd::Ones(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (const NodeData &n = nodes[i]; n.kind != Kind::carried)
        {
          const double gap = n.closed.n > 1 ? n.closed.gap[0] : n.film;
          d.capacity[i] *= gap;
          d.donor[i] = gap / n.film;
        }
    d.integrate();
    d.start_sets(start);
    const unsigned iterations = d.find_sets();
    return d.report(iterations);
  }
} // namespace tribodraw
