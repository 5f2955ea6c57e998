#include <tribodraw/forming/friction_coupling.h>

namespace tribodraw
{
  std::array<double, n_faces>
  mean_coefficients(const Shell &shell, const Contact &contact)
  {
    const std::vector<double>   area = shell.node_current_area();
    std::array<double, n_faces> mean{{0, 0}};
    for (unsigned f = 0; f < n_faces; ++f)
      {
        const auto &pressure = contact.face(static_cast<Face>(f)).pressure, &mu = contact.friction(static_cast<Face>(f));
        double      force = 0, friction = 0;
        for (std::size_t i = 0; i < pressure.size(); ++i)
          {
            force += area[i] * pressure[i];
            friction += area[i] * pressure[i] * mu[i];
          }
        mean[f] = force > 0 ? friction / force : 0.;
      }
    return mean;
  }
} // namespace tribodraw
