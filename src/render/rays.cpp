#include "render/rays.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <stdexcept>

namespace gonio {
namespace {

/// The ray in double travels beside Embree's float ray.
struct Query : RTCIntersectContext {
  Vector origin, direction;
  std::size_t leaving;
  double nearest = std::numeric_limits<double>::infinity();
  std::size_t shape = kNoShape;
};

std::optional<double> distance_to(const Shape& shape, const Vector& origin, const Vector& direction) {
  if (shape.kind == Shape::Kind::sphere) return distance_to_sphere(origin, direction, shape.center, shape.radius);
  const double t = (shape.center.z - origin.z) / direction.z;
  if (!(t > 0) || !std::isfinite(t)) return {};
  const Vector away = origin + t * direction - shape.center;
  if (away.x * away.x + away.y * away.y > shape.radius * shape.radius) return {};
  return t;
}

void bounds(const RTCBoundsFunctionArguments* args) {
  const Shape& shape = static_cast<const Shape*>(args->geometryUserPtr)[args->primID];
  const Vector margin(1e-5 * (glm::length(shape.center) + shape.radius));
  const Vector extent =
      shape.kind == Shape::Kind::sphere ? Vector(shape.radius) : Vector(shape.radius, shape.radius, 0);
  const Vector low = shape.center - extent - margin, high = shape.center + extent + margin;
  RTCBounds& box = *args->bounds_o;
  box.lower_x = static_cast<float>(low.x);
  box.lower_y = static_cast<float>(low.y);
  box.lower_z = static_cast<float>(low.z);
  box.upper_x = static_cast<float>(high.x);
  box.upper_y = static_cast<float>(high.y);
  box.upper_z = static_cast<float>(high.z);
}

void intersect(const RTCIntersectFunctionNArguments* args) {
  if (!args->valid[0]) return;
  Query& query = *static_cast<Query*>(args->context);
  if (args->primID == query.leaving) return;
  const Shape& shape = static_cast<const Shape*>(args->geometryUserPtr)[args->primID];
  const auto t = distance_to(shape, query.origin, query.direction);
  if (!t || *t >= query.nearest) return;
  query.nearest = *t;
  query.shape = args->primID;
  RTCRayHit& ray = *reinterpret_cast<RTCRayHit*>(args->rayhit);
  // Rounded upwards, so that the float ray never ends before the crossing in double.
  ray.ray.tfar = std::nextafter(static_cast<float>(*t), std::numeric_limits<float>::infinity());
  ray.hit.geomID = args->geomID;
  ray.hit.primID = args->primID;
}

}  // namespace

std::optional<double> distance_to_sphere(const Vector& origin, const Vector& direction, const Vector& center,
                                         double radius) {
  const Vector to_center = center - origin;
  const double along = glm::dot(to_center, direction);
  if (along <= 0) return {};
  const Vector across = to_center - along * direction;
  const double half_chord2 = radius * radius - glm::dot(across, across);
  const double outside = glm::dot(to_center, to_center) - radius * radius;
  if (half_chord2 < 0 || outside <= 0) return {};
  return outside / (along + std::sqrt(half_chord2));
}

Hit wall_hit(const Room& room, std::size_t shape, const Vector& origin, const Vector& direction) {
  const auto wall = [&](int axis) { return (direction[axis] > 0 ? room.upper : room.lower)[axis]; };
  double nearest = std::numeric_limits<double>::infinity();
  int met = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0) continue;
    const double t = (wall(axis) - origin[axis]) / direction[axis];
    if (t < nearest) nearest = t, met = axis;
  }
  Hit hit{shape, glm::clamp(origin + std::max(nearest, 0.0) * direction, room.lower, room.upper), Vector(0)};
  hit.point[met] = wall(met);
  hit.normal[met] = direction[met] > 0 ? -1 : 1;
  return hit;
}

struct RayScene::Embree {
  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene scene = nullptr;

  explicit Embree(std::vector<Shape>& shapes) {
    if (!device) throw std::runtime_error("Embree found no device");
    scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(shapes.size()));
    rtcSetGeometryUserData(geometry, shapes.data());
    rtcSetGeometryBoundsFunction(
        geometry, [](const RTCBoundsFunctionArguments* args) { bounds(args); }, nullptr);
    rtcSetGeometryIntersectFunction(geometry, [](const RTCIntersectFunctionNArguments* args) { intersect(args); });
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
    if (rtcGetDeviceError(device) != RTC_ERROR_NONE) throw std::runtime_error("Embree could not build the scene");
  }
  ~Embree() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
};

RayScene::RayScene(std::vector<Shape> shapes, const std::optional<Room>& room)
    : shapes_(std::move(shapes)), room_(room), embree_(std::make_unique<Embree>(shapes_)) {}
RayScene::~RayScene() = default;

std::optional<Hit> RayScene::closest(const Vector& origin, const Vector& direction, std::size_t leaving) const {
  Query query;
  rtcInitIntersectContext(&query);
  query.origin = origin;
  query.direction = direction;
  query.leaving = leaving;
  RTCRayHit ray{};
  ray.ray.org_x = static_cast<float>(origin.x);
  ray.ray.org_y = static_cast<float>(origin.y);
  ray.ray.org_z = static_cast<float>(origin.z);
  ray.ray.dir_x = static_cast<float>(direction.x);
  ray.ray.dir_y = static_cast<float>(direction.y);
  ray.ray.dir_z = static_cast<float>(direction.z);
  ray.ray.tfar = std::numeric_limits<float>::infinity();
  ray.ray.mask = 0xffffffffU;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(embree_->scene, &query, &ray);
  if (query.shape == kNoShape) {
    if (room_) return wall_hit(*room_, room_shape(), origin, direction);
    return {};
  }
  const Shape& shape = shapes_[query.shape];
  const Vector point = origin + query.nearest * direction;
  if (shape.kind == Shape::Kind::disc) return Hit{query.shape, {point.x, point.y, shape.center.z}, {0, 0, 1}};
  const Vector normal = glm::normalize(point - shape.center);
  return Hit{query.shape, shape.center + shape.radius * normal, normal};
}

}  // namespace gonio
