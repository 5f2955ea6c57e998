#include <tribodraw/base/parallel.h>
#include <tribodraw/contact/contact.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace tribodraw
{
  using Eigen::Matrix3d;
  using Eigen::Vector3d;

  namespace
  {
    /// Automatic transition by the thickness, and the pressure at this penetration by E/(1-nu) of the sheet: 150 MPa for
    /// steel. Pressures on tool radii are fractions of the flow stress, which is 1/1000 to 1/200 of E.
    constexpr double relative_transition = 0.025, relative_pressure = 1. / 2000;

    /// Length of an arc by that of its projection on the tangent at its end, from the normals at its ends: what a point
    /// slides over a radius in one increment.
    double
    along_arc(const Vector3d &start, const Vector3d &end)
    {
      const double cosine = std::min(1., start.dot(end));
      if (start.squaredNorm() == 0 || cosine > 1 - 1e-8 || cosine < 0.2)
        return 1;
      return std::acos(cosine) / std::sqrt(1 - cosine * cosine);
    }

    /// E/(1-nu), from the forces that a small equibiaxial stretch of the whole sheet needs.
    double
    equibiaxial_modulus(Shell &shell)
    {
      const double    strain = 1e-7;
      Eigen::VectorXd x      = Eigen::VectorXd::Zero(shell.n_dofs()), force;
      double          volume = 0;
      for (unsigned node = 0; node < shell.n_nodes(); ++node)
        {
          for (unsigned c = 0; c < 3; ++c)
            x[shell.dof(node, c)] = shell.trial().position[node][c];
          volume += shell.node_reference_area()[node] * shell.node_thickness()[node];
        }
      Eigen::VectorXd at_rest;
      shell.assemble(1., {}, at_rest, nullptr);
      shell.move(strain * x);
      shell.assemble(1., {}, force, nullptr);
      shell.revert();
      return (force - at_rest).dot(x) / (2 * strain * volume);
    }
  } // namespace

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

  Contact::Tangent::Tangent(const Shell &shell, const unsigned n_free_tools)
    : sheet(shell.make_matrix())
    , column(shell.n_dofs(), n_free_tools)
    , row(shell.n_dofs(), n_free_tools)
    , corner(n_free_tools, n_free_tools)
  {
    set_zero();
  }

  void
  Contact::Tangent::set_zero()
  {
    sheet.set_zero();
    column.setZero();
    row.setZero();
    corner.setZero();
  }

  Contact::Contact(Shell &shell, std::vector<ContactTool> tools, const Settings &contact_settings)
    : sheet(shell)
    , points(shell)
    , tool(std::move(tools))
    , settings(contact_settings)
    , automatic(contact_settings.stiffness <= 0)
    , pair(tool.size(), std::vector<Pair>(points.size()))
    , tool_force(tool.size(), Vector3d::Zero())
    , sheet_force(Eigen::VectorXd::Zero(shell.n_dofs()))
  {
    for (unsigned f = 0; f < n_faces; ++f)
      {
        law_of_friction[f].coefficient.assign(shell.n_nodes(), 0.);
        faces[f] = {std::vector<double>(shell.n_nodes(), 0.),
                    std::vector<int>(shell.n_nodes(), -1),
                    std::vector<double>(shell.n_nodes(), 1e300),
                    std::vector<Vector3d>(shell.n_nodes(), Vector3d::Zero())};
      }
    for (auto &t : tool)
      t.committed_place = t.place;
    measure_sheet();
    const double thickness = 2 * *std::max_element(half_thickness.begin(), half_thickness.end());
    deepest_allowed        = largest_relative_penetration * thickness;
    if (settings.transition <= 0)
      settings.transition = relative_transition * thickness;
    if (automatic)
      settings.stiffness = relative_pressure * equibiaxial_modulus(shell) / (relative_transition * thickness);
    stiffest = 10 * settings.stiffness;
  }

  void
  Contact::measure_sheet()
  {
    const bool keep_thickness = settings.initial_thickness && !half_thickness.empty();
    area = points.areas(sheet.committed().position);
    half_thickness.resize(points.size());
    committed_position.resize(points.size());
    for (unsigned point = 0; point < points.size(); ++point)
      {
        if (!keep_thickness)
          half_thickness[point] = 0.5 * points.mean(sheet.node_thickness(), point);
        committed_position[point] = points.position(sheet.committed(), point);
      }
  }

  void
  Contact::start_energy_balance()
  {
    energy_at_start += stored;
    stored = dissipated = 0;
  }

  void
  Contact::set_friction(const Face f, std::vector<double> coefficient, std::vector<double> slope, std::vector<double> pressure)
  {
    law_of_friction[static_cast<int>(f)] = {std::move(coefficient), std::move(slope), std::move(pressure)};
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

  Contact::Law
  Contact::frozen_law(const double pressure) const
  {
    return {pressure, std::min(settings.stiffness, std::sqrt(settings.stiffness * pressure / settings.transition))};
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

  Contact::Law
  Contact::friction_at(const FrictionLaw &friction, const unsigned point, const double pressure) const
  {
    const double mu = points.mean(friction.coefficient, point);
    if (friction.slope.empty())
      return {mu, 0};
    const double slope = points.mean(friction.slope, point);
    const double value = mu + slope * (pressure - points.mean(friction.pressure, point));
    return value > 0 ? Law{value, slope} : Law{0, 0};
  }

  Contact::Response
  Contact::evaluate(const unsigned point, const unsigned t, const Vector3d &x, const Options &options)
  {
    const ContactTool &rigid  = tool[t];
    Pair              &now    = pair[t][point];
    Response           result;
    now.trial_pressure = 0;
    now.trial_slides   = false;
    now.trial_slip = now.trial_traction = now.trial_sliding = now.trial_normal = Vector3d::Zero();
    // A distance changes by no more than the point moves.
    const Vector3d seen_from_tool = x - rigid.place;
    if (now.reach > 0 && now.pressure == 0 && (seen_from_tool - now.seen_at).squaredNorm() < now.reach * now.reach)
      {
        now.trial_penetration = -1e300;
        return result;
      }
    const ToolDistance at = rigid.distance(x);
    now.seen_at           = seen_from_tool;
    now.reach             = at.distance - half_thickness[point] - settings.transition;
    now.trial_penetration = half_thickness[point] - at.distance;
    const Vector3d &n     = at.normal;
    const Matrix3d  P     = Matrix3d::Identity() - n * n.transpose();
    const Vector3d  moved = x - committed_position[point] - rigid.motion();
    const bool      far   = options.frozen ? now.pressure == 0 : now.reach >= 0;
    if (far && now.pressure == 0)
      return result;
    now.trial_normal  = n;
    now.trial_sliding = along_arc(now.normal, n) * (P * moved);
    if (far)
      return result;

    const double   w        = area[point], dc = settings.stick_slip;
    const Law      normal   = options.frozen ? frozen_law(now.pressure) : law(now.trial_penetration);
    const double   p        = normal.pressure;
    const Law      mu       = friction_at(law_of_friction[static_cast<int>(rigid.face)], point, p);
    const Vector3d whole    = now.slip + moved; // its tangential part is the trial slip
    const Vector3d slip     = P * whole;
    const double   amount   = slip.norm();
    const bool     slides   = amount > dc;
    Vector3d       direction = slides ? Vector3d(slip / amount) : Vector3d(slip / dc);

    result.touches     = p > 0;
    now.trial_pressure = p;
    now.trial_slides   = slides;
    now.trial_slip     = slides ? Vector3d(dc * direction) : slip;
    now.trial_traction = -w * mu.pressure * p * direction;
    result.force       = w * p * n + now.trial_traction;
    result.stiffness   = w * (normal.stiffness * n * n.transpose() - p * at.curvature);
    if (options.frozen && now.slid)
      {
        // sliding goes on in the direction of the last increment
        const Vector3d last = P * now.slip;
        direction           = last.norm() > 0 ? Vector3d(last.normalized()) : Vector3d::Zero();
        result.stiffness += w * mu.pressure * p / (now.last_slide + dc) * (P - direction * direction.transpose());
      }
    else
      {
        // the tangent plane turns with the normal
        const Vector3d turn    = at.curvature * whole;
        const Matrix3d by_place = P - whole.dot(n) * at.curvature - n * turn.transpose();
        const Matrix3d by_slip  = slides ? Matrix3d((Matrix3d::Identity() - direction * direction.transpose()) / amount) : Matrix3d(Matrix3d::Identity() / dc);
        result.stiffness += w * mu.pressure * p * by_slip * by_place;
      }
    result.stiffness -= w * (mu.pressure + p * mu.stiffness) * normal.stiffness * direction * n.transpose();
    return result;
  }

  void
  Contact::assemble(Eigen::VectorXd             &residual,
                    Tangent                     *tangent,
                    const Options               &options,
                    const std::vector<Vector3d> *motion,
                    Eigen::VectorXd             *tool_sensitivity)
  {
    const auto n_dofs = static_cast<Eigen::Index>(sheet.n_dofs());
    if (tool_sensitivity)
      tool_sensitivity->setZero(residual.size());
    scale = 0;
    sheet_force.setZero();
    std::fill(tool_force.begin(), tool_force.end(), Vector3d::Zero());
    for (unsigned point = 0; point < points.size(); ++point)
      {
        const Vector3d            x       = points.position(sheet.trial(), point);
        bool                      touches = false;
        ContactPoints::Derivative G;
        for (unsigned t = 0; t < tool.size(); ++t)
          {
            const Response response = evaluate(point, t, x, options);
            if (!response.touches)
              continue;
            if (!touches)
              G = points.derivative(sheet.trial(), point);
            touches = true;
            scale += response.force.norm();
            tool_force[t] -= response.force;
            points.add_force(G, point, response.force, 1., sheet_force);
            if (tool_sensitivity && motion)
              points.add_force(G, point, response.stiffness * (*motion)[t], -1., tool_sensitivity->head(n_dofs));
            if (tool[t].free_index >= 0)
              {
                const auto      extra = tool[t].free_index;
                const Vector3d &axis  = tool[t].axis;
                residual[n_dofs + extra] += response.force.dot(axis);
                if (tool_sensitivity && motion)
                  (*tool_sensitivity)[n_dofs + extra] += axis.dot(response.stiffness * (*motion)[t]);
                if (tangent)
                  {
                    points.add_force(G, point, response.stiffness * axis, -1., tangent->column.col(extra));
                    points.add_force(G, point, response.stiffness.transpose() * axis, -1., tangent->row.col(extra));
                    tangent->corner(extra, extra) += axis.dot(response.stiffness * axis);
                  }
              }
            if (tangent && parallel::rank() == 0)
              points.add_tangent(sheet.trial(), G, point, response.force, response.stiffness, tangent->sheet);
          }
      }
    residual.head(n_dofs) -= sheet_force;
  }

  Loads
  Contact::frozen_forces() const
  {
    Loads loads;
    for (unsigned node = 0; node < sheet.n_nodes(); ++node)
      {
        const Eigen::Matrix<double, 5, 1> force = sheet_force.segment<5>(sheet.dof(node, 0));
        const Vector3d                   &d     = sheet.trial().director[node];
        const auto                       &frame = sheet.trial().frame[node];
        if (force.head<3>().squaredNorm() > 0)
          loads.add_point_force(node, force.head<3>());
        // a moment m works m . (d x e_t) on a director increment along e_t
        if (force.tail<2>().squaredNorm() > 0)
          loads.add_point_moment(node, force[3] * d.cross(frame[0]) + force[4] * d.cross(frame[1]));
      }
    return loads;
  }

  bool
  Contact::stiffen()
  {
    double penetration = 0;
    for (unsigned point = 0; point < points.size(); ++point)
      {
        // Between two tools the gap may decide, and no stiffness makes room.
        std::array<double, n_faces> deepest_of{{0, 0}};
        for (unsigned t = 0; t < tool.size(); ++t)
          {
            double &of_face = deepest_of[static_cast<int>(tool[t].face)];
            of_face         = std::max(of_face, pair[t][point].trial_penetration);
          }
        if (deepest_of[0] == 0 || deepest_of[1] == 0)
          penetration = std::max({penetration, deepest_of[0], deepest_of[1]});
      }
    if (!automatic || penetration <= deepest_allowed || settings.stiffness >= stiffest)
      return false;
    settings.stiffness = std::min(stiffest, settings.stiffness * 1.25 * penetration / deepest_allowed); // pressures grow on
    return true;
  }
} // namespace tribodraw
