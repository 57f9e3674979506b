#pragma once
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "scene/scene.h"

namespace gonio {

/// A primitive that a ray meets at most once from outside: a sphere, or a disc facing upwards.
struct Shape {
  enum class Kind { sphere, disc } kind;
  Vector center;
  double radius;
};

struct Hit {
  std::size_t shape;
  Vector point, normal;  ///< on the shape; unit, outwards
};

inline constexpr std::size_t kNoShape = static_cast<std::size_t>(-1);

/// Distance along the unit direction to the first outer crossing of a sphere.
std::optional<double> distance_to_sphere(const Vector& origin, const Vector& direction, const Vector& center,
                                         double radius);

/// Closest hits through Embree: its hierarchy in float finds the candidates, the crossing itself is computed in double.
class RayScene {
 public:
  explicit RayScene(std::vector<Shape> shapes);
  ~RayScene();

  /// `leaving` is the shape the ray starts on: being convex or flat it cannot be met again, so no offset is needed.
  std::optional<Hit> closest(const Vector& origin, const Vector& direction, std::size_t leaving) const;

 private:
  struct Embree;
  std::vector<Shape> shapes_;
  std::unique_ptr<Embree> embree_;
};

}  // namespace gonio
