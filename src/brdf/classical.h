#pragma once
#include "base/special.h"
#include "brdf/ggx.h"

namespace gonio {

/// The ideal mirror: all of its energy, ks·R, is a delta in the mirror direction (coherent_energy); no density.
struct Mirror {
  static constexpr bool kFacets = true, kDiffracts = false;
  template <class G>
  auto shape(const Directions<G>& w) const {
    return w.cos_i * 0;
  }
};

/// Trowbridge & Reitz's "cuvettes" as Maillot 1996 §I.2.2 prints them: e²·D_GGX(alpha = e)/(4·cos_i·cos_o), no shadowing,
/// not normalised. Reciprocal; unbounded at grazing.
template <class T>
struct TrowbridgeReitz {
  static constexpr bool kFacets = true, kDiffracts = false;
  T e;

  FacetSampler<T> sampler() const { return facets_seen(e, e, SlopeKind::ggx, Shadowing::none); }

  template <class G>
  T shape(const Directions<G>& w) const {
    return square(e) * Ggx<T>{e, e, Shadowing::none}.shape(w);
  }
};

/// ζ of the half vector from its tangent².
template <class T>
T angle_of(const T& tan2) {
  using std::atan;
  return atan(safe_sqrt(tan2));
}

/// Blinn's three laws of facets, as published (1 at the normal): a cosine power, a Gaussian of the angle, a spheroid.
enum class BlinnDensity { cosine_power, gaussian_angle, spheroid };
enum class BlinnScale { published, normalised, facet_area };

/// Value of the law at tan²ζ; parameter n, c in 1/rad, or the spheroid's excentricity e:
///   cosⁿζ;  exp(-(c·ζ)²);  (e²/(cos²ζ·(e² - 1) + 1))², which integrates (with cos ζ, over the hemisphere) to π·e².
template <class T>
T blinn_density(BlinnDensity density, const T& tan2, const T& parameter) {
  switch (density) {
    case BlinnDensity::cosine_power: return pow_cos(tan2, parameter);
    case BlinnDensity::gaussian_angle: return fast_exp(T(-square(T(parameter * angle_of(tan2)))));
    case BlinnDensity::spheroid: return square(T((T(1) + tan2) / (T(1) + tan2 / square(parameter))));
  }
  return T(0);
}

/// Blinn 1977 (SIGGRAPH, doi:10.1145/563858.563893). His term D·G·F/cos_o is an intensity: f = D·G·F/(cos_i·cos_o), V-cavity
/// G. published: D as printed, so no density: E may exceed 1. normalised (cosine power, spheroid): D integrates to 1 over
/// projected solid angle, (n+2)/(2π) and 1/(π·e²), and f = D·G·F/(4·cos_i·cos_o). Reciprocal.
/// With the Gaussian of the angle and facet_area it is Torrance & Sparrow 1967 as published (Maillot 1996 eq. (6)):
///   f = a·b·exp(-(c·ζ)²)·G·F/(4·cos_i·cos_o), the facets' area a and their number b in ks.
template <class T>
struct Blinn {
  static constexpr bool kFacets = true, kDiffracts = false;
  T parameter;
  BlinnDensity density = BlinnDensity::cosine_power;
  BlinnScale scale = BlinnScale::published;

  T factor() const {
    if (scale == BlinnScale::published) return T(1);
    if (scale == BlinnScale::facet_area) return T(0.25);
    if (density == BlinnDensity::cosine_power) return (parameter + T(2)) / (T(8) * kPi<T>);
    return T(1) / (T(4) * kPi<T> * square(parameter));
  }

  FacetSampler<T> sampler() const {
    if (density == BlinnDensity::spheroid) return facets_seen(parameter, parameter, SlopeKind::ggx, Shadowing::v_cavity);
    if (density == BlinnDensity::gaussian_angle) return {T(1), T(1), {SlopeKind::angle_gaussian, parameter}};
    return {T(1), T(1), {SlopeKind::power, T(0.5) * (parameter + T(2))}};
  }

  template <class G>
  T shape(const Directions<G>& w) const {
    const T cos_i(w.cos_i), cos_o(w.cos_o);
    const T d = blinn_density(density, T(w.tan2_h), parameter);
    return factor() * d * v_cavity(T(w.cos_h()), cos_i, cos_o, T(w.cos_d)) / (cos_i * cos_o);
  }
};

/// Cook's laws of facets: his D2, Beckmann's as printed, exp(-tan²ζ/α²)/(α²·cos⁴ζ) (no 1/π); his D1, exp(-(ζ/α)²) with c = 1. His D3 is
/// a weighted sum of these at several α.
enum class CookDensity { beckmann, gaussian_angle };

/// Cook & Torrance 1981 (SIGGRAPH; ACM TOG 1(1), doi:10.1145/357290.357293) as published: f = F·D·G/(π·cos_i·cos_o), V-cavity G.
/// Symbols: alpha (his m). With his Beckmann law it is 4 times the normalised `torrance-sparrow` (which is the corrected
/// form): E may exceed 1. Reciprocal.
template <class T>
struct CookTorrance {
  static constexpr bool kFacets = true, kDiffracts = false;
  T alpha;
  CookDensity density = CookDensity::beckmann;

  FacetSampler<T> sampler() const {
    if (density == CookDensity::beckmann) return facets_seen(alpha, alpha, SlopeKind::gaussian, Shadowing::v_cavity);
    return {T(1), T(1), {SlopeKind::angle_gaussian, T(1) / alpha}};
  }

  template <class G>
  T shape(const Directions<G>& w) const {
    const T cos_i(w.cos_i), cos_o(w.cos_o), tan2(w.tan2_h);
    return law(tan2) * v_cavity(T(w.cos_h()), cos_i, cos_o, T(w.cos_d)) / (kPi<T> * cos_i * cos_o);
  }

 private:
  T law(const T& tan2) const {
    if (density == CookDensity::beckmann) return kPi<T> * beckmann_d(tan2, alpha);
    return blinn_density(BlinnDensity::gaussian_angle, tan2, T(T(1) / alpha));
  }
};

/// Phong's highlight about the mirror direction, or Blinn's about the half vector that Whitted 1980 uses for lights.
enum class Highlight { mirror_direction, half_vector };

/// Phong 1975 (CACM 18(6), doi:10.1145/360825.360839): highlight cosⁿs, s between o and the mirror image of i; Whitted 1980 (CACM
/// 23(6), doi:10.1145/358876.358882) takes cosⁿζ_h for lights and a mirror (`mirror`) for the rest. Both are intensities:
///   f = cosⁿ/cos_i: not reciprocal, unbounded as cos_i → 0. The parameters hold all of the reflectance.
/// 1 - cos s = ½|o - r|², r the mirror image: accurate for any n.
template <class T>
struct PhongHighlight {
  static constexpr bool kFacets = false, kDiffracts = false;
  T n;
  Highlight highlight = Highlight::mirror_direction;

  /// About the half vector one cosine wider than the lobe (blinn_phong_normalised.h).
  LobeSampler<T> sampler() const {
    if (highlight == Highlight::mirror_direction) return AxisSampler<T>{T(1), T(1), T(1), n};
    return FacetSampler<T>{T(1), T(1), {SlopeKind::power, T(0.5) * (n + T(1))}};
  }

  template <class G>
  T shape(const Directions<G>& w) const {
    using std::log1p;
    const T cos_i(w.cos_i);
    if (highlight == Highlight::half_vector) return pow_cos(T(w.tan2_h), n) / cos_i;
    const T apart = T(0.5) * (square(T(w.hx)) + square(T(w.hy)) + square(T(w.cos_i) - T(w.cos_o)));
    const auto facing = apart < T(1);
    return select(facing, T(fast_exp(T(n * log1p(T(-select(facing, apart, T(0)))))) / cos_i), T(0));
  }
};

}  // namespace gonio
