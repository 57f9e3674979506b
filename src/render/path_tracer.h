#pragma once
#include <cmath>
#include <vector>

#include "render/frame.h"
#include "render/light_sampling.h"
#include "render/rays.h"
#include "render/render.h"
#include "render/surface_shader.h"

namespace gonio {

/// A scene made ready for N batches of wavelengths: shapes for the rays, a shader a material, emitted radiances in
/// lanes.
template <std::size_t N>
class PathTracer {
 public:
  using Lanes = SpectralLanes<N>;
  using Shader = SurfaceShader<N>;

  /// `shapes`: the lights, then what reflects, in the order of `materials`, in which a room comes last. `surroundings`:
  /// the radiance of the environment, or of the room's walls.
  PathTracer(std::vector<Shape> shapes, const std::optional<Room>& room, std::vector<std::size_t> materials,
             std::vector<Shader> shaders, std::vector<SphericalLight> lights, std::vector<Lanes> emitted,
             Lanes surroundings, const RenderSettings& settings)
      : rays_(std::move(shapes), room),
        materials_(std::move(materials)),
        shaders_(std::move(shaders)),
        light_sampler_(std::move(lights)),
        emitted_(std::move(emitted)),
        surroundings_(surroundings),
        strategy_(settings.strategy),
        max_depth_(settings.max_depth) {}

  /// Radiance arriving along a ray from the eye: one path.
  Lanes radiance(Vector origin, Vector direction, Random& random) const {
    Lanes sum, throughput(1.0F);
    std::size_t leaving = kNoShape;
    Arrival arrival;
    for (int depth = 0;; ++depth) {
      const auto hit = rays_.closest(origin, direction, leaving);
      // Light sampling never looks for the surroundings: what they emit counts in full. Walls reflect as well.
      if (!hit) return sum += throughput * surroundings_;
      if (hit->shape == rays_.room_shape()) sum += throughput * surroundings_;
      if (const Lanes* emitted = emitted_by(hit->shape)) {
        return sum += throughput * *emitted * static_cast<float>(brdf_share(origin, direction, arrival));
      }
      if (depth >= max_depth_) return sum;
      const Shader& shader = shaders_[materials_[hit->shape - emitted_.size()]];
      const Frame frame(hit->normal);
      const LocalDirection o = frame.to_local(-direction);
      if (o.z <= 0) return sum;
      if (strategy_ != Strategy::brdf && !light_sampler_.empty())
        sum += throughput * direct_light(*hit, frame, shader, o, random);

      const auto drawn = shader.sample(o, random);
      if (!drawn) return sum;
      throughput *= drawn->weight;
      if (!survives(throughput, depth, random)) return sum;
      origin = hit->point;
      direction = frame.to_world(drawn->i);
      leaving = hit->shape;
      arrival = {drawn->delta, drawn->pdf_per_sr};
    }
  }

 private:
  static constexpr int kSureDepth = 3;  ///< reflections before Russian roulette

  /// Of a light; null for what reflects.
  const Lanes* emitted_by(std::size_t shape) const { return shape < emitted_.size() ? &emitted_[shape] : nullptr; }

  /// How the ray under way was drawn: from the eye or a delta, where light sampling has no say, or with a density.
  struct Arrival {
    bool only_way = true;
    double pdf_per_sr = 0;
  };

  /// Weight of light that the ray itself meets (balance heuristic).
  double brdf_share(const Vector& origin, const Vector& direction, const Arrival& arrival) const {
    if (arrival.only_way || strategy_ == Strategy::brdf) return 1;
    if (strategy_ == Strategy::light) return 0;
    return arrival.pdf_per_sr / (arrival.pdf_per_sr + light_sampler_.pdf(origin, direction));
  }

  Lanes direct_light(const Hit& hit, const Frame& frame, const Shader& shader, const LocalDirection& o,
                     Random& random) const {
    const double u0 = random.uniform(), u1 = random.uniform(), u2 = random.uniform();
    const LightDirection drawn = light_sampler_.sample(hit.point, u0, u1, u2);
    const LocalDirection i = frame.to_local(drawn.direction);
    if (i.z <= 0 || !(drawn.pdf_per_sr > 0)) return Lanes(0.0F);
    const auto met = rays_.closest(hit.point, drawn.direction, hit.shape);
    const Lanes* emitted = met ? emitted_by(met->shape) : nullptr;
    if (!emitted) return Lanes(0.0F);
    const double other = strategy_ == Strategy::mis ? shader.pdf(i, o) : 0;
    return shader.evaluate(i, o, i.z / (drawn.pdf_per_sr + other)) * *emitted;
  }

  static bool survives(Lanes& throughput, int depth, Random& random) {
    const double largest = static_cast<double>(throughput.largest());
    if (largest <= 0) return false;
    if (depth < kSureDepth || !(largest < 1)) return true;  // what overflowed goes on, to be counted with the pixel
    if (random.uniform() >= largest) return false;
    throughput *= static_cast<float>(1 / largest);
    return true;
  }

  RayScene rays_;
  std::vector<std::size_t> materials_;  ///< of each shape that reflects
  std::vector<Shader> shaders_;
  LightSampler light_sampler_;
  std::vector<Lanes> emitted_;
  Lanes surroundings_;
  Strategy strategy_;
  int max_depth_;
};

}  // namespace gonio
