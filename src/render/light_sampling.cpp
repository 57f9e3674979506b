#include "render/light_sampling.h"

#include <algorithm>
#include <cmath>

#include "render/frame.h"
#include "render/rays.h"

namespace gonio {

double cone_height(const Vector& point, const Vector& center, double radius) {
  const Vector away = center - point;
  const double sin2 = radius * radius / glm::dot(away, away);
  if (sin2 >= 1) return 2;
  return sin2 / (1 + std::sqrt(1 - sin2));
}

LightDirection LightSampler::sample(const Vector& point, double u0, double u1, double u2) const {
  const auto chosen = static_cast<std::size_t>(u0 * static_cast<double>(lights_.size()));
  const SphericalLight& light = lights_[std::min(chosen, lights_.size() - 1)];
  const double below = u1 * cone_height(point, light.center, light.radius);  // 1 - cos of the sampled angle
  const double sine = std::sqrt(below * (2 - below)), phi = 2 * kPi<double> * u2;
  const Frame frame(glm::normalize(light.center - point));
  const Vector direction = frame.to_world({sine * std::cos(phi), sine * std::sin(phi), 1 - below});
  return {direction, pdf(point, direction)};
}

double LightSampler::pdf(const Vector& point, const Vector& direction) const {
  double sum = 0;
  for (const SphericalLight& light : lights_)
    if (distance_to_sphere(point, direction, light.center, light.radius))
      sum += 1 / (2 * kPi<double> * cone_height(point, light.center, light.radius));
  return sum / static_cast<double>(lights_.size());
}

}  // namespace gonio
