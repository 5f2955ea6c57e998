// What Contact keeps from increment to increment.
#include <tribodraw/contact/contact.h>

#include <algorithm>

namespace tribodraw
{
  using Eigen::Vector3d;

  namespace
  {
    void
    append(std::vector<double> &values, const Vector3d &v)
    {
      values.insert(values.end(), v.data(), v.data() + 3);
    }

    Vector3d
    take(const std::vector<double> &values, std::size_t &k)
    {
      k += 3;
      return {values[k - 3], values[k - 2], values[k - 1]};
    }
  } // namespace

  Vector3d
  Contact::Pair::traction_on(const Vector3d &end) const
  {
    const Vector3d projected = traction - traction.dot(end) * end;
    const double   length    = projected.norm();
    return length > 0 ? Vector3d(traction.norm() / length * projected) : Vector3d::Zero();
  }

  void
  Contact::commit()
  {
    faces   = trial_faces();
    stored  = -energy_at_start;
    deepest = 0;
    for (unsigned t = 0; t < tool.size(); ++t)
      {
        for (unsigned point = 0; point < points.size(); ++point)
          {
            Pair &n = pair[t][point];
            // trapezoidal rule: traction before and after the increment
            dissipated -= 0.5 * (n.traction_on(n.trial_normal) + n.trial_traction).dot(n.trial_sliding);
            stored += area[point] * energy(n.trial_penetration);
            if (n.trial_pressure > 0)
              deepest = std::max(deepest, n.trial_penetration);
            n.pressure   = n.trial_pressure;
            n.slip       = n.trial_slip;
            n.traction   = n.trial_traction;
            n.normal     = n.trial_normal;
            n.slid       = n.trial_slides;
            n.last_slide = n.trial_sliding.norm();
            n.reach      = 0; // thickness changes
          }
        tool[t].committed_place = tool[t].place;
      }
    measure_sheet();
  }

  std::array<Contact::FaceState, n_faces>
  Contact::trial_faces() const
  {
    const unsigned                 n = sheet.n_nodes();
    std::array<FaceState, n_faces> result;
    for (unsigned f = 0; f < n_faces; ++f)
      {
        FaceState &face = result[f];
        face.tool.assign(n, -1);
        face.gap.assign(n, 1e300);
        face.slip.assign(n, Vector3d::Zero());
        face.pressure.assign(n, 0.);
        std::vector<double> force(n, 0.), around(n, 0.), largest(n, 0.);
        for (unsigned point = 0; point < points.size(); ++point)
          for (const unsigned node : points.nodes(point))
            around[node] += 0.5 * area[point];
        for (unsigned t = 0; t < tool.size(); ++t)
          {
            if (static_cast<unsigned>(tool[t].face) != f)
              continue;
            std::vector<double>   of_tool(n, 0.);
            std::vector<Vector3d> slip(n, Vector3d::Zero());
            for (unsigned point = 0; point < points.size(); ++point)
              {
                const Pair &p = pair[t][point];
                for (const unsigned node : points.nodes(point))
                  {
                    const double share = 0.5 * area[point] * p.trial_pressure;
                    of_tool[node] += share;
                    slip[node] += share * p.trial_sliding;
                  }
              }
            for (unsigned node = 0; node < n; ++node)
              {
                face.gap[node] = std::min(face.gap[node], tool[t].distance(sheet.trial().position[node]).distance - half_thickness[node]);
                force[node] += of_tool[node];
                if (of_tool[node] <= largest[node])
                  continue;
                largest[node]   = of_tool[node];
                face.tool[node] = static_cast<int>(t);
                face.slip[node] = slip[node] / of_tool[node];
              }
          }
        for (unsigned node = 0; node < n; ++node)
          face.pressure[node] = force[node] / around[node];
      }
    return result;
  }

  void
  Contact::save(Archive &archive) const
  {
    std::vector<double> values;
    for (unsigned t = 0; t < tool.size(); ++t)
      {
        values.clear();
        append(values, tool[t].committed_place);
        for (const Pair &p : pair[t])
          {
            append(values, p.slip);
            append(values, p.traction);
            append(values, p.normal);
            values.push_back(p.pressure);
            values.push_back(p.last_slide);
            values.push_back(p.slid);
          }
        archive.put("contact/tool " + std::to_string(t), values);
      }
    for (unsigned f = 0; f < n_faces; ++f)
      {
        const std::string  name = "contact/face " + std::to_string(f);
        const FrictionLaw &law  = law_of_friction[f];
        archive.put(name + " friction", law.coefficient);
        archive.put(name + " friction slope", law.slope);
        archive.put(name + " friction pressure", law.pressure);
        archive.put(name + " pressure", faces[f].pressure);
        archive.put(name + " gap", faces[f].gap);
        archive.put(name + " tool", std::vector<double>(faces[f].tool.begin(), faces[f].tool.end()));
        values.clear();
        for (const Vector3d &s : faces[f].slip)
          append(values, s);
        archive.put(name + " slip", values);
      }
    archive.put("contact/area", area);
    archive.put("contact/half thickness", half_thickness);
    archive.put("contact/energies", std::vector<double>{dissipated, stored, energy_at_start, deepest, settings.stiffness});
  }

  void
  Contact::load(const Archive &archive)
  {
    measure_sheet();
    for (unsigned t = 0; t < tool.size(); ++t)
      {
        const auto &values = archive.numbers("contact/tool " + std::to_string(t), 3 + 12 * pair[t].size());
        std::size_t k      = 0;
        tool[t].place = tool[t].committed_place = take(values, k);
        for (Pair &p : pair[t])
          {
            p.slip       = take(values, k);
            p.traction   = take(values, k);
            p.normal     = take(values, k);
            p.pressure   = values[k++];
            p.last_slide = values[k++];
            p.slid       = values[k++] != 0;
            p.reach      = 0;
          }
      }
    for (unsigned f = 0; f < n_faces; ++f)
      {
        const std::string name = "contact/face " + std::to_string(f);
        FrictionLaw      &law  = law_of_friction[f];
        law.coefficient        = archive.numbers(name + " friction", sheet.n_nodes());
        law.slope              = archive.numbers(name + " friction slope");
        law.pressure           = archive.numbers(name + " friction pressure", law.slope.size());
        faces[f].pressure      = archive.numbers(name + " pressure", sheet.n_nodes());
        faces[f].gap           = archive.numbers(name + " gap", sheet.n_nodes());
        const auto &touching   = archive.numbers(name + " tool", sheet.n_nodes());
        const auto &slip       = archive.numbers(name + " slip", 3 * sheet.n_nodes());
        std::size_t k          = 0;
        for (std::size_t i = 0; i < touching.size(); ++i)
          {
            faces[f].tool[i] = static_cast<int>(touching[i]);
            faces[f].slip[i] = take(slip, k);
          }
      }
    area                 = archive.numbers("contact/area", points.size());
    half_thickness       = archive.numbers("contact/half thickness", points.size());
    const auto &energies = archive.numbers("contact/energies", 5);
    dissipated           = energies[0];
    stored               = energies[1];
    energy_at_start      = energies[2];
    deepest              = energies[3];
    if (automatic)
      settings.stiffness = energies[4];
  }
} // namespace tribodraw
