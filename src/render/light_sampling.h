#pragma once
#include <vector>

#include "scene/scene.h"

namespace gonio {

struct LightDirection {
  Vector direction;
  double pdf_per_sr;  ///< of all lights together; 0 when the point sees none
};

/// Directions towards spherical lights: one light in n with equal chance, then uniform in the cone it subtends. The
/// density is the sum over all cones that contain the direction, so that overlapping lights are counted right.
class LightSampler {
 public:
  explicit LightSampler(std::vector<SphericalLight> lights) : lights_(std::move(lights)) {}

  bool empty() const { return lights_.empty(); }
  /// u0, u1, u2 in (0, 1).
  LightDirection sample(const Vector& point, double u0, double u1, double u2) const;
  double pdf(const Vector& point, const Vector& direction) const;

 private:
  std::vector<SphericalLight> lights_;
};

/// 1 - cos of the half-angle under which a sphere is seen: sin²/(1 + cos), nothing cancels. 2 from inside.
double cone_height(const Vector& point, const Vector& center, double radius);

}  // namespace gonio
