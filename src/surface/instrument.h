#pragma once
#include "surface/roughness.h"

namespace gonio {

/// What a stylus of tip radius R draws: z'(x) = max over u of z(x+u) + √(R²-u²) - R (dilation by the tip).
HeightProfile stylus_trace(const HeightProfile& profile, double radius_um);
/// The highest surface that gives this trace (erosion by the tip): what no tip reached stays unknown.
HeightProfile stylus_reconstruction(const HeightProfile& trace, double radius_um);

/// The profile under a Gaussian window exp(-x²/w²)/(w√π), renormalised at the ends.
HeightProfile averaged(const HeightProfile& profile, double width_um);

/// sigma and T of a Gaussian autocorrelation.
struct GaussianSurface {
  double sigma_um, correlation_um;
};
/// The same window in closed form: T'² = T² + 2w²; sigma'² = sigma²·(T/T')^d, d = 1 when averaging along a profile, 2
/// when an optical instrument averages over the surface.
GaussianSurface averaged(const GaussianSurface& surface, double width_um, int dimensions);
/// The surface that looks like this one through the window; none when T' <= √2·w.
std::optional<GaussianSurface> before_averaging(const GaussianSurface& seen, double width_um, int dimensions);

}  // namespace gonio
