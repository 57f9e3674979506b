#pragma once
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "scene/scene.h"

namespace gonio {

/// A primitive that a ray meets at most once from outside: a sphere, or a disc facing upwards. (A room is none.)
struct Shape {
  enum class Kind { sphere, disc } kind;
  Vector center;
  double radius;
};

struct Hit {
  std::size_t shape;
  Vector point, normal;  ///< on the shape; unit, outwards (of a room inwards)
};

inline constexpr std::size_t kNoShape = static_cast<std::size_t>(-1);

/// Distance along the unit direction to the first outer crossing of a sphere.
std::optional<double> distance_to_sphere(const Vector& origin, const Vector& direction, const Vector& center,
                                         double radius);

/// Where a ray from inside a room meets a wall: the nearest of the three walls that it flies towards. There is always
/// one: a start that rounding put behind a wall meets that wall at once, and the point is on the box, edges and corners
/// too. A ray that leaves a wall inwards does not fly towards it, so that it cannot meet it again.
Hit wall_hit(const Room& room, std::size_t shape, const Vector& origin, const Vector& direction);

/// Closest hits through Embree: its hierarchy in float finds the candidates, the crossing itself is computed in double.
/// A room lies behind every other shape: a ray that meets none of them meets a wall.
class RayScene {
 public:
  explicit RayScene(std::vector<Shape> shapes, const std::optional<Room>& room = {});
  ~RayScene();

  /// `leaving` is the shape the ray starts on: being convex or flat it cannot be met again, so no offset is needed.
  std::optional<Hit> closest(const Vector& origin, const Vector& direction, std::size_t leaving) const;

  /// Hit::shape of the room: it follows the shapes.
  std::size_t room_shape() const { return shapes_.size(); }

 private:
  struct Embree;
  std::vector<Shape> shapes_;
  std::optional<Room> room_;
  std::unique_ptr<Embree> embree_;
};

}  // namespace gonio
