#pragma once
// scene: what is rendered: primitives, lights, camera, materials, and the scene file.
#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "brdf/lobe_sum.h"
#include "energy/compensation.h"
#include "optics/interface.h"

namespace gonio {

/// z is up. Lengths in any one unit (angles and ratios are all that matters), |coordinate| <= kFarthest.
using Vector = glm::dvec3;

inline constexpr double kFarthest = 1e4, kLeastRadius = 1e-4;

struct Camera {
  Vector position{0, -6, 2}, look_at{0, 0, 1};
  double fov_deg = 30;  ///< vertical, 0.1 to 170
  int width = 320, height = 240;
};

/// A surface: model, its values in the order of model.parameters(), and what its facets are made of.
struct SceneMaterial {
  std::string name;
  LobeSum model;
  std::vector<double> values;                        ///< at every wavelength, unless by_wavelength says otherwise
  std::string material = "perfect";                  ///< database id
  std::optional<Interface<double>> fixed_interface;  ///< n, k at every wavelength, in place of `material`
  /// All values at each of the scene's wavelengths, where kd or ks differ between them; else empty.
  std::vector<std::vector<double>> by_wavelength{};
  CompensationKind compensation = CompensationKind::none;
  bool may_gain = false;  ///< rendered although it breaks (43): reflects more than it receives at some incidence
};

struct SphereObject {
  Vector center{0, 0, 1};
  double radius = 1;
  std::size_t material = 0;  ///< index into Scene::materials
};

/// A disc facing upwards; seen from below it is black.
struct GroundObject {
  double height = 0, radius = 100;  ///< around the z axis
  std::size_t material = 0;
};

/// Spectral radiance against wavelength: radiance · S(λ)/S(560 nm), S an illuminant of the database, or constant.
struct Emission {
  double radiance = 1;
  std::string illuminant = "constant";
};

/// Emits Lambertian, reflects nothing.
struct SphericalLight {
  Vector center{0, 0, 5};
  double radius = 1;
  Emission emission;
};

/// A closed box around everything else, seen from inside. Its walls reflect, and may emit (Lambertian) as well.
struct Room {
  Vector lower{-3, -3, 0}, upper{3, 3, 4};
  std::size_t material = 0;
  Emission emission{0, "constant"};
};

struct Scene {
  Camera camera;
  std::vector<SceneMaterial> materials;
  std::vector<SphereObject> spheres;
  std::optional<GroundObject> ground;
  std::vector<SphericalLight> lights;
  std::optional<Room> room;
  Emission environment{0, "constant"};  ///< from every direction
  std::vector<double> wavelengths_nm;   ///< increasing, 1 to kMaxWavelengths
};

inline constexpr std::size_t kMaxWavelengths = 32;

/// 390 to 700 nm in steps of 10.
std::vector<double> visible_wavelengths();

/// Spectral radiance at a wavelength; InputError where the illuminant is unknown or does not reach.
double radiance_at(const Emission& emission, double wavelength_nm);

/// InputError when something cannot be rendered: a size outside its range, the camera or a light inside a sphere.
void check(const Scene& scene);

/// The part of check() that concerns the room: its size, and that it holds everything, and nothing that it would hide.
void check_room(const Scene& scene);

/// Sphere on a grey ground (Lambert 0.4) under a soft spherical light from the upper left and a constant environment,
/// 320 × 240, D65 for the visible wavelengths, constant spectra for a single one. Lit so that a white diffuse surface
/// facing up is about 0.9.
Scene validation_scene(SceneMaterial sphere_material, std::vector<double> wavelengths_nm = visible_wavelengths());

}  // namespace gonio
