#include "scene/scene.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "base/error.h"
#include "materials/database.h"

namespace gonio {
namespace {

constexpr double kFarthest = 1e4;
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
  check_range(fmt::format("{} radius", what), radius, 1e-4, kFarthest);
}

void check_emission(std::string_view what, const Emission& emission, const std::vector<double>& wavelengths_nm) {
  check_range(fmt::format("{} radiance", what), emission.radiance, 0, 1e12);
  for (const double wavelength : wavelengths_nm) radiance_at(emission, wavelength);
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
    check_range("ground radius", scene.ground->radius, 1e-4, kFarthest);
  }
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
