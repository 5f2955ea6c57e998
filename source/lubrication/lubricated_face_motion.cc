#include <tribodraw/lubrication/lubricated_face.h>

#include <cmath>

namespace tribodraw
{
  bool
  LubricatedFace::accumulate(const std::vector<Contact> &contacts, const Increment &increment)
  {
    State &s = attempted;
    if (increment.at_rest)
      {
        s.forget_motion();
        return true;
      }
    s.elapsed += increment.dt;
    s.travelled += std::abs(increment.travel);
    for (std::size_t i = 0; i < s.slid.size(); ++i)
      if (contacts[i].table >= 0)
        {
          s.slid[i] += increment.dt * (contacts[i].sheet_velocity - contacts[i].tool_velocity);
          s.touched[i] += increment.dt;
        }
    // Equal steps of the smallest travel shall not miss it by round-off.
    return s.elapsed > 0 && s.travelled >= (1. - 1e-9) * settings.smallest_travel;
  }

  void
  LubricatedFace::State::forget_motion()
  {
    elapsed = travelled = 0;
    slid.assign(slid.size(), Eigen::Vector3d::Zero());
    touched.assign(touched.size(), 0.);
  }

  std::vector<int>
  LubricatedFace::touched_tables(const std::vector<Contact> &contacts) const
  {
    std::vector<int> result;
    for (std::size_t i = 0; i < contacts.size(); ++i)
      {
        int         index = contacts[i].table;
        const auto &ring  = patch.neighbours()[i];
        std::size_t n     = 0;
        int         there = -1;
        for (const unsigned j : ring)
          if (contacts[j].table >= 0)
            {
              ++n;
              there = contacts[j].table;
            }
        if (index < 0 && 2 * n > ring.size())
          index = there;
        result.push_back(index);
      }
    return result;
  }

  std::vector<Eigen::Vector3d>
  LubricatedFace::mean_slip_velocity() const
  {
    const auto                  &slid    = attempted.slid;
    const auto                  &touched = attempted.touched;
    std::vector<Eigen::Vector3d> result;
    for (std::size_t i = 0; i < slid.size(); ++i)
      {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        double          n   = 0;
        if (touched[i] > 0)
          {
            sum = slid[i] / touched[i];
            n   = 1;
          }
        else
          for (const unsigned j : patch.neighbours()[i])
            if (touched[j] > 0)
              {
                sum += slid[j] / touched[j];
                n += 1;
              }
        result.push_back(n > 0 ? Eigen::Vector3d(sum / n) : sum);
      }
    return result;
  }
} // namespace tribodraw
