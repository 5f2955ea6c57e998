#include <tribodraw/base/parallel.h>
#include <tribodraw/contact/contact.h>

#include <algorithm>
#include <cmath>

namespace tribodraw
{
  using Eigen::Matrix3d;
  using Eigen::Vector3d;

  ToolDistance
  ContactTool::distance(const Vector3d &x) const
  {
    if (!mirrored)
      return geometry->distance(x - place);
    ToolDistance d = geometry->distance(Vector3d(x[0] - place[0], x[1] - place[1], place[2] - x[2]));
    d.normal[2]    = -d.normal[2];
    for (int i = 0; i < 2; ++i)
      {
        d.curvature(i, 2) = -d.curvature(i, 2);
        d.curvature(2, i) = -d.curvature(2, i);
      }
    return d;
  }

  Contact::Contact(const Shell &shell, std::vector<ContactTool> tools, const Settings &contact_settings)
    : sheet(shell)
    , tool(std::move(tools))
    , settings(contact_settings)
    , area(shell.node_current_area())
    , pair(tool.size(), std::vector<NodeTool>(shell.n_nodes()))
    , tool_force(tool.size(), Vector3d::Zero())
    , node_force(shell.n_nodes(), Vector3d::Zero())
  {
    for (const double h : shell.node_thickness())
      half_thickness.push_back(0.5 * h);
    for (unsigned f = 0; f < n_faces; ++f)
      {
        mu[f].assign(shell.n_nodes(), 0.);
        faces[f] = {std::vector<double>(shell.n_nodes(), 0.),
                    std::vector<int>(shell.n_nodes(), -1),
                    std::vector<double>(shell.n_nodes(), 1e300),
                    std::vector<Vector3d>(shell.n_nodes(), Vector3d::Zero())};
      }
    for (auto &t : tool)
      t.committed_place = t.place;
  }

  void
  Contact::start_energy_balance()
  {
    energy_at_start += stored;
    stored = dissipated = 0;
  }

  void
  Contact::set_friction(const Face f, std::vector<double> coefficient)
  {
    mu[static_cast<int>(f)] = std::move(coefficient);
  }

  Contact::Law
  Contact::law(const double g) const
  {
    const double d = settings.transition, e = settings.stiffness;
    if (g <= -d)
      return {0, 0};
    if (g < d)
      return {e * (g + d) * (g + d) / (4 * d), e * (g + d) / (2 * d)};
    return {e * g, e};
  }

  double
  Contact::energy(const double g) const
  {
    const double d = settings.transition, e = settings.stiffness;
    if (g <= -d)
      return 0;
    if (g < d)
      return e * (g + d) * (g + d) * (g + d) / (12 * d);
    return e * (d * d / 6 + 0.5 * g * g);
  }

  void
  Contact::evaluate(const unsigned node, const unsigned t, const Options &options, Vector3d &force, Matrix3d &K, double &weight)
  {
    const ContactTool &rigid = tool[t];
    NodeTool          &n     = pair[t][node];
    const Vector3d    &x     = sheet.trial().position[node];
    weight                   = area[node];
    force.setZero();
    K.setZero();
    n.trial_pressure = 0;
    n.trial_slip.setZero();
    n.trial_traction.setZero();
    n.trial_sliding.setZero();
    n.trial_slides = false;

    const ToolDistance at          = rigid.distance(x);
    const double       penetration = half_thickness[node] - at.distance;
    n.trial_penetration            = penetration;
    if (options.frozen ? n.pressure == 0 : penetration <= -settings.transition)
      return;
    const Law       response   = law(penetration);
    const double    p          = response.pressure;
    const double    friction   = mu[static_cast<int>(rigid.face)][node];
    const double    dc         = settings.stick_slip;
    const Matrix3d  P          = Matrix3d::Identity() - at.normal * at.normal.transpose();
    const Vector3d  sliding    = P * (x - sheet.committed().position[node] - rigid.motion());
    const Vector3d  slip       = P * n.slip + sliding;
    const double    amount     = slip.norm();
    const bool      slides     = amount > dc;
    const Vector3d  direction  = slides ? Vector3d(slip / amount) : Vector3d(slip / dc);

    n.trial_pressure = p;
    n.trial_sliding  = sliding;
    n.trial_slides   = slides;
    n.trial_slip     = slides ? Vector3d(dc * direction) : slip;
    n.trial_traction = -weight * friction * p * direction;
    force            = weight * p * at.normal + n.trial_traction;

    K = weight * (response.stiffness * at.normal * at.normal.transpose() - p * at.curvature);
    if (options.frozen && n.slid)
      {
        // sliding goes on in the direction of the last increment
        const Vector3d d = n.slip.norm() > 0 ? Vector3d((P * n.slip) / (P * n.slip).norm()) : Vector3d::Zero();
        K += weight * friction * p / (n.last_slide + dc) * (P - d * d.transpose());
        K -= weight * friction * response.stiffness * d * at.normal.transpose();
      }
    else
      {
        K += weight * friction * p / (slides ? amount : dc) * (slides ? Matrix3d(P - direction * direction.transpose()) : P);
        K -= weight * friction * response.stiffness * direction * at.normal.transpose();
      }
  }

  void
  Contact::add_tangent(SparseMatrix &tangent, const unsigned node, const ContactTool &t, const Matrix3d &K) const
  {
    for (unsigned i = 0; i < 3; ++i)
      for (unsigned j = 0; j < 3; ++j)
        tangent.add(static_cast<int>(sheet.dof(node, i)), static_cast<int>(sheet.dof(node, j)), K(i, j));
    if (t.free_index < 0)
      return;
    const int extra = static_cast<int>(sheet.n_dofs()) + t.free_index;
    for (unsigned i = 0; i < 3; ++i)
      {
        tangent.add(static_cast<int>(sheet.dof(node, i)), extra, -K.row(i).dot(t.axis));
        tangent.add(extra, static_cast<int>(sheet.dof(node, i)), -K.col(i).dot(t.axis));
      }
    tangent.add(extra, extra, t.axis.dot(K * t.axis));
  }

  void
  Contact::assemble(Eigen::VectorXd             &residual,
                    SparseMatrix                *tangent,
                    const Options               &options,
                    const std::vector<Vector3d> *motion,
                    Eigen::VectorXd             *tool_sensitivity)
  {
    if (tool_sensitivity)
      tool_sensitivity->setZero(residual.size());
    scale = 0;
    std::fill(node_force.begin(), node_force.end(), Vector3d::Zero());
    const bool adds_tangent = tangent && parallel::rank() == 0;
    for (unsigned t = 0; t < tool.size(); ++t)
      {
        tool_force[t].setZero();
        const int extra = tool[t].free_index < 0 ? -1 : static_cast<int>(sheet.n_dofs()) + tool[t].free_index;
        for (unsigned node = 0; node < sheet.n_nodes(); ++node)
          {
            Vector3d force;
            Matrix3d K;
            double   weight;
            evaluate(node, t, options, force, K, weight);
            if (pair[t][node].trial_pressure == 0)
              continue;
            scale += force.norm();
            tool_force[t] -= force;
            node_force[node] += force;
            for (unsigned i = 0; i < 3; ++i)
              residual[sheet.dof(node, i)] -= force[i];
            if (extra >= 0)
              residual[extra] += force.dot(tool[t].axis);
            if (tool_sensitivity && motion)
              for (unsigned i = 0; i < 3; ++i)
                (*tool_sensitivity)[sheet.dof(node, i)] -= K.row(i).dot((*motion)[t]);
            if (adds_tangent)
              add_tangent(*tangent, node, tool[t], K);
          }
      }
  }

  Loads
  Contact::frozen_forces() const
  {
    Loads loads;
    for (unsigned node = 0; node < sheet.n_nodes(); ++node)
      if (node_force[node].squaredNorm() > 0)
        loads.add_point_force(node, node_force[node]);
    return loads;
  }

  void
  Contact::commit()
  {
    stored = -energy_at_start;
    for (auto &f : faces)
      {
        std::fill(f.pressure.begin(), f.pressure.end(), 0.);
        std::fill(f.tool.begin(), f.tool.end(), -1);
        std::fill(f.gap.begin(), f.gap.end(), 1e300);
        std::fill(f.slip.begin(), f.slip.end(), Vector3d::Zero());
      }
    for (unsigned t = 0; t < tool.size(); ++t)
      {
        FaceState &f = faces[static_cast<int>(tool[t].face)];
        for (unsigned i = 0; i < sheet.n_nodes(); ++i)
          {
            NodeTool &n = pair[t][i];
            // trapezoidal rule: traction before and after the increment
            dissipated -= 0.5 * (n.traction + n.trial_traction).dot(n.trial_sliding);
            stored += area[i] * energy(n.trial_penetration);
            f.gap[i] = std::min(f.gap[i], -n.trial_penetration);
            if (n.trial_pressure > f.pressure[i])
              {
                f.pressure[i] = n.trial_pressure;
                f.tool[i]     = static_cast<int>(t);
                f.slip[i]     = n.trial_sliding;
              }
            n.pressure   = n.trial_pressure;
            n.slip       = n.trial_slip;
            n.traction   = n.trial_traction;
            n.slid       = n.trial_slides;
            n.last_slide = n.trial_sliding.norm();
          }
        tool[t].committed_place = tool[t].place;
      }
    area = sheet.node_current_area();
    for (unsigned i = 0; i < sheet.n_nodes(); ++i)
      half_thickness[i] = 0.5 * sheet.node_thickness()[i];
  }

  double
  Contact::max_penetration() const
  {
    double largest = 0;
    for (const auto &f : faces)
      for (std::size_t i = 0; i < f.gap.size(); ++i)
        if (f.tool[i] >= 0)
          largest = std::max(largest, -f.gap[i]);
    return largest;
  }

  void
  Contact::save(Archive &archive) const
  {
    std::vector<double> values;
    for (unsigned t = 0; t < tool.size(); ++t)
      {
        values.clear();
        for (int i = 0; i < 3; ++i)
          values.push_back(tool[t].committed_place[i]);
        for (const auto &n : pair[t])
          {
            for (int i = 0; i < 3; ++i)
              values.push_back(n.slip[i]);
            for (int i = 0; i < 3; ++i)
              values.push_back(n.traction[i]);
            values.push_back(n.pressure);
            values.push_back(n.last_slide);
            values.push_back(n.slid);
          }
        archive.put("contact/tool " + std::to_string(t), values);
      }
    for (unsigned f = 0; f < n_faces; ++f)
      {
        const std::string name = "contact/face " + std::to_string(f);
        archive.put(name + " friction", mu[f]);
        archive.put(name + " pressure", faces[f].pressure);
        archive.put(name + " gap", faces[f].gap);
        std::vector<double> touching(faces[f].tool.begin(), faces[f].tool.end());
        archive.put(name + " tool", touching);
      }
    archive.put("contact/area", area);
    archive.put("contact/half thickness", half_thickness);
    archive.put("contact/energies", std::vector<double>{dissipated, stored, energy_at_start});
  }

  void
  Contact::load(const Archive &archive)
  {
    for (unsigned t = 0; t < tool.size(); ++t)
      {
        const auto &values = archive.numbers("contact/tool " + std::to_string(t), 3 + 9 * pair[t].size());
        std::size_t k      = 0;
        for (int i = 0; i < 3; ++i)
          tool[t].place[i] = tool[t].committed_place[i] = values[k++];
        for (auto &n : pair[t])
          {
            for (int i = 0; i < 3; ++i)
              n.slip[i] = values[k++];
            for (int i = 0; i < 3; ++i)
              n.traction[i] = values[k++];
            n.pressure   = values[k++];
            n.last_slide = values[k++];
            n.slid       = values[k++] != 0;
          }
      }
    for (unsigned f = 0; f < n_faces; ++f)
      {
        const std::string name = "contact/face " + std::to_string(f);
        mu[f]                  = archive.numbers(name + " friction", sheet.n_nodes());
        faces[f].pressure      = archive.numbers(name + " pressure", sheet.n_nodes());
        faces[f].gap           = archive.numbers(name + " gap", sheet.n_nodes());
        const auto &touching   = archive.numbers(name + " tool", sheet.n_nodes());
        for (std::size_t i = 0; i < touching.size(); ++i)
          faces[f].tool[i] = static_cast<int>(touching[i]);
      }
    area           = archive.numbers("contact/area", sheet.n_nodes());
    half_thickness = archive.numbers("contact/half thickness", sheet.n_nodes());
    const auto &energies = archive.numbers("contact/energies", 3);
    dissipated           = energies[0];
    stored               = energies[1];
    energy_at_start      = energies[2];
  }
} // namespace tribodraw
