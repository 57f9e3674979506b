#include "scene/scene.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "base/error.h"
#include "materials/database.h"

namespace gonio {
namespace {

constexpr double kMostValues = 2.5e8;  // pixels times wavelengths: 2 GB in double

void check_range(std::string_view what, double value, double lo, double hi) {
  if (!(value >= lo && value <= hi)) throw input_error("{} is {}; expected {} to {}", what, value, lo, hi);
}

void check_point(std::string_view what, const Vector& point) {
  for (int axis = 0; axis < 3; ++axis) check_range(what, point[axis], -kFarthest, kFarthest);
}

void check_camera(const Camera& camera) {
  check_point("camera position", camera.position);
  check_point("camera look_at", camera.look_at);
  check_range("camera fov_deg", camera.fov_deg, 0.1, 170);
  check_range("camera width", camera.width, 1, 16384);
  check_range("camera height", camera.height, 1, 16384);
  if (glm::distance(camera.position, camera.look_at) < 1e-6)
    throw input_error("camera position and look_at coincide; expected two points");
}

void check_ball(std::string_view what, const Vector& center, double radius) {
  check_point(fmt::format("{} center", what), center);
  check_range(fmt::format("{} radius", what), radius, kLeastRadius, kFarthest);
}

void check_emission(std::string_view what, const Emission& emission, const std::vector<double>& wavelengths_nm) {
  check_range(fmt::format("{} radiance", what), emission.radiance, 0, 1e12);
  for (const double wavelength : wavelengths_nm) radiance_at(emission, wavelength);
}

/// What touches a wall is inside.
void check_inside(const Room& room, std::string_view what, const Vector& center, double radius) {
  constexpr double kRounding = 1e-11;  // of sums of decimals up to kFarthest
  for (int axis = 0; axis < 3; ++axis)
    if (center[axis] - radius < room.lower[axis] - kRounding || center[axis] + radius > room.upper[axis] + kRounding)
      throw input_error("{} is not wholly inside the room; expected everything between its walls", what);
}

void check_wavelengths(const std::vector<double>& wavelengths_nm) {
  if (wavelengths_nm.empty() || wavelengths_nm.size() > kMaxWavelengths)
    throw input_error("wavelengths_nm has {} values; expected 1 to {}", wavelengths_nm.size(), kMaxWavelengths);
  for (std::size_t w = 0; w < wavelengths_nm.size(); ++w) {
    check_range("wavelengths_nm", wavelengths_nm[w], 100, 1e5);
    if (w > 0 && wavelengths_nm[w] <= wavelengths_nm[w - 1])
      throw input_error("wavelengths_nm: {} follows {}; expected increasing values", wavelengths_nm[w],
                        wavelengths_nm[w - 1]);
  }
}

}  // namespace

std::vector<double> visible_wavelengths() {
  std::vector<double> all;
  for (int nm = 390; nm <= 700; nm += 10) all.push_back(nm);
  return all;
}

double radiance_at(const Emission& emission, double wavelength_nm) {
  if (emission.illuminant == "constant") return emission.radiance;
  const Entry& entry = Database::bundled().find(emission.illuminant);
  if (entry.kind != "illuminant")
    throw input_error("{}: is of kind {}; expected an illuminant or `constant`", emission.illuminant, entry.kind);
  constexpr double kReference_nm = 560;
  return emission.radiance * entry.at(wavelength_nm) / entry.at(kReference_nm);
}

void check_room(const Scene& scene) {
  if (!scene.room) return;
  const Room& room = *scene.room;
  check_point("room from", room.lower);
  check_point("room to", room.upper);
  for (int axis = 0; axis < 3; ++axis)
    if (!(room.upper[axis] - room.lower[axis] >= kLeastRadius))
      throw input_error("room reaches from {} to {} in {}; expected it to be at least {} wide", room.lower[axis],
                        room.upper[axis], "xyz"[axis], kLeastRadius);
  check_emission("room", room.emission, scene.wavelengths_nm);
  const Vector& eye = scene.camera.position;
  if (!glm::all(glm::lessThan(room.lower, eye) && glm::lessThan(eye, room.upper)))
    throw input_error("the camera is not inside the room; expected it between the walls");
  for (const SphereObject& sphere : scene.spheres) check_inside(room, "a sphere", sphere.center, sphere.radius);
  for (const SphericalLight& light : scene.lights) check_inside(room, "a light", light.center, light.radius);
  if (scene.ground) throw input_error("a room and a ground are both given; expected one of them (a room has a floor)");
  if (scene.environment.radiance > 0)
    throw input_error("a room hides the environment; expected environment radiance 0, or lights inside the room");
}

void check(const Scene& scene) {
  check_camera(scene.camera);
  check_wavelengths(scene.wavelengths_nm);
  const double values =
      1.0 * scene.camera.width * scene.camera.height * static_cast<double>(scene.wavelengths_nm.size());
  if (values > kMostValues)
    throw input_error("camera width x height x wavelengths is {}; expected at most {}", values, kMostValues);
  check_emission("environment", scene.environment, scene.wavelengths_nm);
  for (const SphereObject& sphere : scene.spheres) check_ball("sphere", sphere.center, sphere.radius);
  for (const SphericalLight& light : scene.lights) {
    check_ball("light", light.center, light.radius);
    check_emission("light", light.emission, scene.wavelengths_nm);
    for (const SphereObject& sphere : scene.spheres)
      if (glm::distance(light.center, sphere.center) < light.radius + sphere.radius)
        throw input_error("a light overlaps a sphere; expected lights outside of every object");
    if (scene.ground && std::abs(light.center.z - scene.ground->height) < light.radius)
      throw input_error("a light crosses the ground; expected lights outside of every object");
    if (glm::distance(light.center, scene.camera.position) <= light.radius)
      throw input_error("the camera is inside a light; expected it outside of every object");
  }
  for (const SphereObject& sphere : scene.spheres)
    if (glm::distance(sphere.center, scene.camera.position) <= sphere.radius)
      throw input_error("the camera is inside a sphere; expected it outside of every object");
  if (scene.ground) {
    check_range("ground height", scene.ground->height, -kFarthest, kFarthest);
    check_range("ground radius", scene.ground->radius, kLeastRadius, kFarthest);
  }
  check_room(scene);
  for (const SceneMaterial& material : scene.materials) {
    material.model.check(material.values);
    for (const std::vector<double>& values : material.by_wavelength) material.model.check(values);
  }
}

Scene validation_scene(SceneMaterial sphere_material, std::vector<double> wavelengths_nm) {
  const std::string illuminant = wavelengths_nm.size() == 1 ? "constant" : "D65";
  Scene scene;
  scene.camera = {{0, -6.4, 3.1}, {0, 0, 0.86}, 24, 320, 240};
  scene.materials = {std::move(sphere_material), {"ground", ModelSpec{ModelId::lambert}, {0.4}, "perfect", {}}};
  scene.spheres = {{{0, 0, 1}, 1, 0}};
  scene.ground = GroundObject{0, 100, 1};
  scene.lights = {{{-4, -3, 6.5}, 2, {9, illuminant}}};
  scene.environment = {0.35, illuminant};
  scene.wavelengths_nm = std::move(wavelengths_nm);
  return scene;
}

}  // namespace gonio
