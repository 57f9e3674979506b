#include "render/render.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "base/error.h"
#include "materials/database.h"
#include "render/path_tracer.h"

namespace gonio {
namespace {

std::vector<Interface<double>> interfaces(const SceneMaterial& material, std::span<const double> wavelengths_nm) {
  if (material.fixed_interface) return std::vector(wavelengths_nm.size(), *material.fixed_interface);
  const SurfaceMaterial surface =
      material.material == "perfect" ? SurfaceMaterial::perfect() : SurfaceMaterial(material.material);
  std::vector<Interface<double>> all;
  for (const double nm : wavelengths_nm) all.push_back(surface.at(nm));
  return all;
}

/// One list for all wavelengths, or one for each.
std::vector<std::vector<double>> values_of(const SceneMaterial& material) {
  if (material.by_wavelength.empty()) return {material.values};
  return material.by_wavelength;
}

/// E of every material's lobes; empty where a lobe has none (its integral is infinite).
using Energies = std::vector<std::optional<MaterialEnergy>>;

std::string refusal(const SceneMaterial& material, const EnergyBalance& balance) {
  return fmt::format("material {}: {}", material.name, balance.described());
}

std::optional<MaterialEnergy> energy_of(const SceneMaterial& material, const SurfaceSamples& samples, bool may_gain,
                                        std::vector<std::string>& gains) {
  SampledLobes lobes;
  for (const std::vector<double>& values : values_of(material)) lobes.push_back(make_brdfs(material.model, values));
  std::optional<MaterialEnergy> energy;
  std::string wrong;
  try {
    energy.emplace(lobes.front(), samples.surface, material.compensation);
    if (const EnergyBalance balance = energy_balance(*energy, lobes, samples); !balance.holds())
      wrong = refusal(material, balance);
  } catch (const InputError& error) {
    if (material.compensation != CompensationKind::none)
      throw input_error("material {}: {}", material.name, error.what());
    wrong = fmt::format("material {}: {}", material.name, error.what());
  }
  if (wrong.empty()) return energy;
  if (!may_gain) throw input_error("{}; expected at most 1, or energy: allow-gain", wrong);
  gains.push_back(wrong);
  return energy;
}

Energies energies_of(const Scene& scene, const RenderSettings& settings, std::vector<std::string>& gains) {
  Energies all;
  for (const SceneMaterial& material : scene.materials) {
    if (settings.energy == EnergyRule::unchecked && material.compensation == CompensationKind::none) {
      all.emplace_back();
      continue;
    }
    SurfaceSamples samples{scene.wavelengths_nm, {interfaces(material, scene.wavelengths_nm), {}}};
    for (const double nm : scene.wavelengths_nm) samples.surface.wavelength_um.push_back(nm * 1e-3);
    all.push_back(energy_of(material, samples, material.may_gain || settings.energy != EnergyRule::conserve, gains));
  }
  return all;
}

template <std::size_t N>
SpectralLanes<N> lanes_of(const Emission& emission, std::span<const double> wavelengths_nm) {
  std::vector<double> values;
  for (const double nm : wavelengths_nm) values.push_back(radiance_at(emission, nm));
  return SpectralLanes<N>::from(values);
}

template <std::size_t N>
PathTracer<N> make_tracer(const Scene& scene, const Energies& energies, const RenderSettings& settings) {
  const std::vector<double>& wavelengths_nm = scene.wavelengths_nm;
  std::vector<Shape> shapes;
  std::vector<SpectralLanes<N>> emitted;
  for (const SphericalLight& light : scene.lights) {
    shapes.push_back({Shape::Kind::sphere, light.center, light.radius});
    emitted.push_back(lanes_of<N>(light.emission, wavelengths_nm));
  }
  std::vector<std::size_t> materials;
  for (const SphereObject& sphere : scene.spheres) {
    shapes.push_back({Shape::Kind::sphere, sphere.center, sphere.radius});
    materials.push_back(sphere.material);
  }
  if (scene.ground) {
    shapes.push_back({Shape::Kind::disc, {0, 0, scene.ground->height}, scene.ground->radius});
    materials.push_back(scene.ground->material);
  }
  if (scene.room) materials.push_back(scene.room->material);
  std::vector<SurfaceShader<N>> shaders;
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    const SceneMaterial& material = scene.materials[m];
    shaders.emplace_back(material.model, values_of(material), interfaces(material, wavelengths_nm), wavelengths_nm,
                         energies[m] ? &*energies[m] : nullptr);
  }
  const Emission& surroundings = scene.room ? scene.room->emission : scene.environment;
  return {std::move(shapes),
          scene.room,
          std::move(materials),
          std::move(shaders),
          scene.lights,
          std::move(emitted),
          lanes_of<N>(surroundings, wavelengths_nm),
          settings};
}

/// Rays through a pinhole.
class Eye {
 public:
  explicit Eye(const Camera& camera) : camera_(camera) {
    forward_ = glm::normalize(camera.look_at - camera.position);
    const Vector up = std::abs(forward_.z) > 0.999999 ? Vector(0, 1, 0) : Vector(0, 0, 1);
    right_ = glm::normalize(glm::cross(forward_, up));
    up_ = glm::cross(right_, forward_);
    scale_ = 2 * std::tan(camera.fov_deg * kPi<double> / 360) / camera.height;
  }
  /// Through the point (x, y) of the image, in pixels from its upper left corner.
  Vector towards(double x, double y) const {
    return glm::normalize(forward_ + scale_ * ((x - 0.5 * camera_.width) * right_ + (0.5 * camera_.height - y) * up_));
  }

 private:
  Camera camera_;
  Vector forward_, right_, up_;
  double scale_;
};

/// Sums and sums of squared deviations of one pixel's paths, in double (Welford's update: no cancellation).
class PixelSum {
 public:
  explicit PixelSum(std::size_t wavelengths) : mean_(wavelengths), deviation_(wavelengths) {}

  template <class Values>
  void add(const Values& values) {
    ++count_;
    for (std::size_t w = 0; w < mean_.size(); ++w) {
      const double value = static_cast<double>(values[w]), step = value - mean_[w];
      mean_[w] += step / count_;
      deviation_[w] += step * (value - mean_[w]);
    }
  }
  double mean(std::size_t w) const { return mean_[w]; }
  double variance_of_mean(std::size_t w) const { return count_ > 1 ? deviation_[w] / (count_ - 1) / count_ : 0; }

 private:
  std::vector<double> mean_, deviation_;
  double count_ = 0;
};

template <std::size_t N>
void render_pixel(const PathTracer<N>& tracer, const Scene& scene, const Eye& eye, const RenderSettings& settings,
                  std::size_t pixel, RenderResult& result, std::atomic<std::uint64_t>& dropped) {
  const std::size_t wavelengths = scene.wavelengths_nm.size(), width = static_cast<std::size_t>(scene.camera.width);
  Random random(settings.seed, pixel);
  PixelSum sum(wavelengths);
  std::array<float, N * kLane> values;
  for (int path = 0; path < settings.spp; ++path) {
    const double x = static_cast<double>(pixel % width) + random.uniform();
    const double y = static_cast<double>(pixel / width) + random.uniform();
    tracer.radiance(scene.camera.position, eye.towards(x, y), random).store(values);
    if (!std::all_of(values.begin(), values.end(), [](float value) { return std::isfinite(value); })) {
      ++dropped;
      values.fill(0);
    }
    sum.add(values);
  }
  for (std::size_t w = 0; w < wavelengths; ++w) {
    result.image.radiance[pixel * wavelengths + w] = sum.mean(w);
    if (settings.variance) result.variance[pixel * wavelengths + w] = sum.variance_of_mean(w);
  }
}

template <std::size_t N>
void render_rows(const Scene& scene, const Energies& energies, const RenderSettings& settings, RenderResult& result) {
  const PathTracer<N> tracer = make_tracer<N>(scene, energies, settings);
  const Eye eye(scene.camera);
  const auto width = static_cast<std::size_t>(scene.camera.width),
             height = static_cast<std::size_t>(scene.camera.height);
  std::atomic<std::size_t> done{0};
  std::atomic<std::uint64_t> dropped{0};
  const auto allowed =
      static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
  tbb::task_arena arena(settings.threads > 0 ? std::min(settings.threads, allowed) : tbb::task_arena::automatic);
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, height, [&](std::size_t row) {
      for (std::size_t pixel = row * width; pixel < (row + 1) * width; ++pixel)
        render_pixel(tracer, scene, eye, settings, pixel, result, dropped);
      if (settings.progress) settings.progress(static_cast<double>(++done) / static_cast<double>(height));
    });
  });
  result.dropped_paths = dropped;
}

/// The fewest batches that hold the wavelengths.
template <std::size_t N>
void dispatch(const Scene& scene, const Energies& energies, const RenderSettings& settings, RenderResult& result) {
  if constexpr (2 * N * kLane <= kMaxWavelengths)
    if (scene.wavelengths_nm.size() > N * kLane) return dispatch<2 * N>(scene, energies, settings, result);
  render_rows<N>(scene, energies, settings, result);
}

}  // namespace

RenderResult render(const Scene& scene, const RenderSettings& settings) {
  check(scene);
  if (settings.spp < 1 || settings.spp > 100'000'000)
    throw input_error("spp is {}; expected 1 to 100000000", settings.spp);
  if (settings.max_depth < 0) throw input_error("max_depth is {}; expected 0 or more", settings.max_depth);
  RenderResult result{{scene.camera.width, scene.camera.height, scene.wavelengths_nm}, {}, 0, {}};
  if (settings.variance) result.variance.resize(result.image.radiance.size());
  const Energies energies = energies_of(scene, settings, result.gains);
  dispatch<1>(scene, energies, settings, result);
  return result;
}

Strategy strategy_from(std::string_view name) {
  if (name == "mis") return Strategy::mis;
  if (name == "light") return Strategy::light;
  if (name == "brdf") return Strategy::brdf;
  throw input_error("{}: unknown strategy; expected mis, light or brdf", name);
}

}  // namespace gonio
