#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "image/spectral_image.h"
#include "scene/scene.h"

namespace gonio {

/// How the light of the spherical lights is looked for. The environment and the shining walls of a room are always
/// found by BRDF sampling.
enum class Strategy {
  mis,    ///< light and BRDF sampling, weighted by the balance heuristic (Veach & Guibas 1995)
  light,  ///< light sampling only (but for light met through a coherent delta)
  brdf    ///< BRDF sampling only
};

/// What becomes of a material that breaks (43), kd·ρd + ks·E <= 1.
enum class EnergyRule {
  conserve,    ///< refused, with the number by which it fails, unless it may_gain itself
  allow_gain,  ///< rendered, and said in RenderResult::gains
  unchecked  ///< rendered without a look at E, which no table or quadrature gives then: lobes are chosen by R0 (quick previews)
};

struct RenderSettings {
  int spp = 64;       ///< paths a pixel
  int max_depth = 8;  ///< reflections a path; light that needs more is missing
  std::uint64_t seed = 1;
  int threads = 0;  ///< 0 = all; the image does not depend on it
  Strategy strategy = Strategy::mis;
  EnergyRule energy = EnergyRule::conserve;
  bool variance = true;                         ///< also estimate the variance (as much memory again)
  std::function<void(double done)> progress{};  ///< called from any thread with the share done, 0 to 1
};

struct RenderResult {
  SpectralImage image;
  /// Of each value of image.radiance, the variance of that mean (standard error squared), from the sample variance of
  /// its paths; empty without settings.variance. 0 with one path a pixel.
  std::vector<double> variance;
  /// Paths whose radiance overflowed float; they count as black. 0 in any sensible scene.
  std::uint64_t dropped_paths = 0;
  std::vector<std::string> gains{};  ///< materials that break (43), and by how much
};

/// Spectral Monte Carlo path tracing. Same scene, seed and settings: same bits, whatever the number of threads.
/// E of every lobe is taken from the tables, or integrated, before the first path. InputError for a scene that cannot be rendered (check(), a material outside its range, or one that breaks (43)).
RenderResult render(const Scene& scene, const RenderSettings& settings);

/// `mis`, `light`, `brdf`; InputError for another name.
Strategy strategy_from(std::string_view name);

}  // namespace gonio
