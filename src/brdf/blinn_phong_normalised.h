#pragma once
#include "base/scaled_exp.h"
#include "brdf/direction_samplers.h"
#include "brdf/directions.h"

namespace gonio {

/// How the lobe is scaled, in the order of the model's variants.
enum class BlinnPhongScale { projected, energy };

/// Blinn's cosine lobe about the half vector, scaled so that its strength does not fall with the exponent: f = s·cosⁿθ_h.
///   projected   s = (n + 2)/(2π), which makes ∫ f cos θ_h dω_h = 1: the convention of the MERL tables of Ngan, Durand &
///               Matusik 2005 (doi:10.5555/2383654.2383671). E at the normal is then 4(n + 2^(-n/2))/(n + 4), up to 4.
///   energy      s = (n + 2)(n + 4)/(8π(2^(-n/2) + n)): E = 1 at the normal (Giesen 2009, note on normalisation).
/// Symbols: n > 0 exponent; ks the albedo of the tables. No Fresnel factor, no shadowing. Reciprocal, bounded.
/// Known disagreement: the tables' name and BBM's code (Phong's mirror direction in its place) differ; only the half vector
/// agrees with the Ward and Ashikhmin-Shirley fits of the same materials (n near 2/alpha², not 1/(2·alpha²)).
template <class T>
struct BlinnPhongNormalised {
  static constexpr bool kFacets = false, kDiffracts = false;
  T n;
  BlinnPhongScale scale = BlinnPhongScale::projected;

  /// D ∝ cos^(n-1): one cosine wider than the lobe, whose weight would grow as 1/cos θ_h.
  FacetSampler<T> sampler() const { return {T(1), T(1), {SlopeKind::power, T(0.5) * (n + T(1))}}; }

  template <class G>
  T shape(const Directions<G>& w) const {
    using std::exp, std::log1p;
    const T exponent = T(0.5) * n * T(log1p(w.tan2_h));
    if (scale == BlinnPhongScale::projected) return scaled_exp(T((n + T(2)) / (T(2) * kPi<T>)), exponent);
    const T half_power = exp(T(-0.34657359027997265470861606072908828404L) * n);  // 2^(-n/2)
    return scaled_exp(T((n + T(2)) * (n + T(4)) / (T(8) * kPi<T> * (half_power + n))), exponent);
  }
};

}  // namespace gonio
