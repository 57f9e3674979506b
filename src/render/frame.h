#pragma once
#include <cmath>
#include <glm/geometric.hpp>

#include "brdf/sampling.h"
#include "scene/scene.h"

namespace gonio {

/// The surface's frame around its normal (Duff et al., JCGT 6(1), 2017), to turn directions between world and surface.
class Frame {
 public:
  explicit Frame(const Vector& normal) : z_(normal) {
    const double sign = std::copysign(1.0, normal.z), a = -1 / (sign + normal.z), b = normal.x * normal.y * a;
    x_ = {1 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x};
    y_ = {b, sign + normal.y * normal.y * a, -normal.y};
  }
  LocalDirection to_local(const Vector& v) const { return {glm::dot(v, x_), glm::dot(v, y_), glm::dot(v, z_)}; }
  Vector to_world(const LocalDirection& v) const { return glm::normalize(v.x * x_ + v.y * y_ + v.z * z_); }

 private:
  Vector x_, y_, z_;
};

}  // namespace gonio
