#pragma once
#include "base/scaled_exp.h"
#include "brdf/direction_samplers.h"
#include "brdf/directions.h"
#include "surface/shadowing.h"

namespace gonio {

// Low, Kronander, Ynnerman & Unger 2012 (ACM Trans. Graph. 31(1), 9, doi:10.1145/2077341.2077350): two models on the ABC
// law of polished surfaces, S(x) = A/(1 + B·x)^C. A is a scale, B a squared correlation length, C the decay; nothing
// normalises them, so E is whatever the fit made of it (not conserving by itself). F is exact, of a real index ("eta").
// Both reciprocal, finite to grazing with bounded E.

/// Smooth surfaces, from Rayleigh-Rice (eq. (12)): f = F·S(|D_p|²), D_p = i_xy + o_xy the deviation from the mirror
/// direction projected on the surface. F at cos_d here; the authors take √(1 - ¼|i_xy - o_xy|²) (eq. (14)), which is the
/// same in the mirror direction (60° against the normal: 25.7° for 30°).
template <class T>
struct LowSmooth {
  static constexpr bool kFacets = true, kDiffracts = false;
  T a, b, c;

  DiscSampler<T> sampler() const { return {b, c, DiscKind::abc}; }

  template <class G>
  T shape(const Directions<G>& w) const {
    using std::log1p;
    return scaled_exp(a, T(c * log1p(b * T(w.tan2_h * square(w.cos_i + w.cos_o)))));
  }
};

/// Low et al.'s two readings of the microfacet model's scale, in the order of the model's variants.
enum class LowScale { tables, paper };

/// Microfacets (eq. (15)): f = F·G·S(1 - cos θ_h)/(π·cos_i·cos_o), V-cavity G.
///   tables   with the 1/π, by which the published MERL parameters were fitted (then they agree with the smooth fits of the
///            same materials in the tails: aluminium at θ_h = 0.05 rad 0.41 and 0.41 1/sr; without it 1.30);
///   paper    without it.
template <class T>
struct LowMicrofacet {
  static constexpr bool kFacets = true, kDiffracts = false;
  T a, b, c;
  LowScale scale = LowScale::tables;

  FacetSampler<T> sampler() const { return {T(1), T(1), {SlopeKind::abc, b, c}}; }

  template <class G>
  T shape(const Directions<G>& w) const {
    using std::log1p, std::sqrt;
    const T t = T(w.tan2_h);
    const T one_minus_cos = t / ((T(1) + t) + sqrt(T(1) + t));  // 1 - 1/√(1+t)
    const T cos_i = T(w.cos_i), cos_o = T(w.cos_o);
    const T g = v_cavity(cos_i, cos_o, T(w.cos2_d())).value();
    const T divisor = scale == LowScale::tables ? kPi<T> : T(1);
    return scaled_exp(T(a * g / (divisor * cos_i * cos_o)), T(c * log1p(b * one_minus_cos)));
  }
};

}  // namespace gonio
