#pragma once
#include <boost/math/quadrature/gauss.hpp>

#include "base/scaled_exp.h"
#include "base/two_terms.h"
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

/// Value of the law at tan²ζ, times `scale`; parameter n, c in 1/rad, or the spheroid's excentricity e:
///   cosⁿζ;  exp(-(c·ζ)²);  (e²/(cos²ζ·(e² - 1) + 1))², which integrates (with cos ζ, over the hemisphere) to π·e².
template <class T>
T blinn_density(BlinnDensity density, const T& tan2, const T& parameter, const T& scale = T(1)) {
  using std::log1p;
  switch (density) {
    case BlinnDensity::cosine_power:
      return scaled_exp(scale, T(T(0.5) * parameter * log1p(tan2)));
    case BlinnDensity::gaussian_angle:
      return scaled_exp(scale, T(square(T(parameter * angle_of(tan2)))));
    case BlinnDensity::spheroid:
      return scale * square(T((T(1) + tan2) / (T(1) + tan2 / square(parameter))));
  }
  return T(0);
}

/// What exp(-(c·ζ)²) integrates to with cos ζ over the hemisphere, π·∫ exp(-(c·ζ)²)·sin 2ζ dζ up to π/2 (or 7/c, beyond which 1e-21 is left):
/// Gauss-Legendre, 30 nodes, to double's last digits.
template <class T>
T gaussian_angle_integral(const T& c) {
  using std::exp, std::sin;
  using Rule = boost::math::quadrature::gauss<double, 30>;
  const T half = T(0.5) * smaller_of(T(T(0.5) * kPi<T>), T(T(7) / c));
  T sum(0);
  for (std::size_t n = 0; n < Rule::abscissa().size(); ++n)
    for (const double side : {-1.0, 1.0}) {
      const T zeta = half * T(scalar_t<T>(1 + side * Rule::abscissa()[n]));
      sum += T(scalar_t<T>(Rule::weights()[n])) * exp(-square(T(c * zeta))) * sin(T(2) * zeta);
    }
  return kPi<T> * half * sum;
}

/// Blinn 1977 (SIGGRAPH, doi:10.1145/563858.563893). His term D·G·F/cos_o is an intensity: f = D·G·F/(cos_i·cos_o), V-cavity
/// G. published: D as printed, so no density: E may exceed 1. normalised: D integrates to 1 over projected solid angle, (n+2)/(2π),
/// 1/(π·e²) and 1/gaussian_angle_integral, and f = D·G·F/(4·cos_i·cos_o). Reciprocal. With c = 1/α the normalised Gaussian is Cook's D1
/// with the one c that makes it a density.
/// With the Gaussian of the angle and facet_area it is Torrance & Sparrow 1967 as published (Maillot 1996 eq. (6)):
///   f = a·b·exp(-(c·ζ)²)·G·F/(4·cos_i·cos_o), the facets' area a and their number b in ks.
template <class T>
struct Blinn {
  static constexpr bool kFacets = true, kDiffracts = false;
  T parameter;
  BlinnDensity density = BlinnDensity::cosine_power;
  BlinnScale scale = BlinnScale::published;
  T integral = T(1);  ///< of the Gaussian, where it is normalised

  T factor() const {
    if (scale == BlinnScale::published) return T(1);
    if (scale == BlinnScale::facet_area) return T(0.25);
    if (density == BlinnDensity::cosine_power) return (parameter + T(2)) / (T(8) * kPi<T>);
    if (density == BlinnDensity::gaussian_angle) return T(1) / (T(4) * integral);
    return T(1) / (T(4) * kPi<T> * square(parameter));
  }

  FacetSampler<T> sampler() const {
    if (density == BlinnDensity::spheroid)
      return facets_seen(parameter, parameter, SlopeKind::ggx, Shadowing::v_cavity);
    if (density == BlinnDensity::gaussian_angle) return {T(1), T(1), {SlopeKind::angle_gaussian, parameter}};
    return {T(1), T(1), {SlopeKind::power, T(0.5) * (parameter + T(2))}};
  }

  template <class G>
  T shape(const Directions<G>& w) const {
    const T cos_i(w.cos_i), cos_o(w.cos_o);
    const T scale = factor() * v_cavity(cos_i, cos_o, T(w.cos2_d())).value() / (cos_i * cos_o);
    return blinn_density(density, T(w.tan2_h), parameter, scale);
  }
};

/// Cook's laws of facets: his D2, Beckmann's as printed, exp(-tan²ζ/α²)/(α²·cos⁴ζ) (no 1/π); his D1, exp(-(ζ/α)²) with c = 1. His
/// D3 = Σ w_j·D(α_j), Σ w_j = 1, sums these at several α: here two of D2, (1 - weight_2)·D(alpha) + weight_2·D(alpha_2).
enum class CookDensity { beckmann, gaussian_angle };

/// Cook & Torrance 1981 (SIGGRAPH; ACM TOG 1(1), doi:10.1145/357290.357293) as published: f = F·D·G/(π·cos_i·cos_o), V-cavity G.
/// Symbols: alpha (his m). With his Beckmann law it is 4 times the normalised `torrance-sparrow` (which is the corrected
/// form): E may exceed 1. Reciprocal.
template <class T>
struct CookTorrance {
  static constexpr bool kFacets = true, kDiffracts = false;
  T alpha;
  CookDensity density = CookDensity::beckmann;
  T alpha_2 = T(1), weight_2 = T(0);

  FacetSampler<T> sampler() const {
    const T widest = select(weight_2 > T(0), larger_of(alpha, alpha_2), alpha);
    if (density == CookDensity::beckmann) return facets_seen(widest, widest, SlopeKind::gaussian, Shadowing::v_cavity);
    return {T(1), T(1), {SlopeKind::angle_gaussian, T(1) / alpha}};
  }

  template <class G>
  T shape(const Directions<G>& w) const {
    const T cos_i(w.cos_i), cos_o(w.cos_o), tan2(w.tan2_h);
    const T scale = v_cavity(cos_i, cos_o, T(w.cos2_d())).value() / (kPi<T> * cos_i * cos_o);
    if (density == CookDensity::gaussian_angle) return scaled_exp(scale, T(square(T(angle_of(tan2) / alpha))));
    return (T(1) - weight_2) * law(tan2, alpha, scale) + weight_2 * law(tan2, alpha_2, scale);
  }

 private:
  /// Beckmann's law as printed, without 1/π.
  static T law(const T& tan2, const T& alpha, const T& scale) {
    return scaled_exp(T(scale / square(alpha)), T(tan2 / square(alpha)), T(T(1) + tan2));
  }
};

/// Phong's highlight about the mirror direction, or Blinn's about the half vector that Whitted 1980 uses for lights.
enum class Highlight { mirror_direction, half_vector };

/// Phong 1975 (CACM 18(6), doi:10.1145/360825.360839): highlight cosⁿs, s between o and the mirror image of i; Whitted 1980 (CACM
/// 23(6), doi:10.1145/358876.358882) takes cosⁿζ_h for lights and a mirror (`mirror`) for the rest. Both are intensities:
///   f = cosⁿ/cos_i: not reciprocal, unbounded as cos_i → 0. The parameters hold all of the reflectance.
/// 1 - cos s = ½|o - r|², r the mirror image: accurate for any n. Beyond 60° cos s = i_z·o_z - i_x·o_x - i_y·o_y is summed exactly: at
/// s = 90° only the exact sum knows which cosine is left.
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
    using std::log, std::log1p;
    const T cos_i(w.cos_i);
    if (highlight == Highlight::half_vector) return scaled_exp(T(T(1) / cos_i), T(T(0.5) * n * log1p(T(w.tan2_h))));
    const T apart = T(0.5) * (square(T(w.hx)) + square(T(w.hy)) + square(T(w.cos_i) - T(w.cos_o)));
    const auto wide = apart > T(0.5);
    const T cosine = sum_of_products(std::array<T, 3>{T(w.cos_i), T(-w.ix), T(-w.iy)},
                                     std::array<T, 3>{T(w.cos_o), T(w.ox), T(w.oy)});
    const auto facing = !wide || cosine > T(0);
    const T log_cosine =
        select(wide, T(log(select(wide && facing, cosine, T(1)))), T(log1p(T(-select(wide, T(0), apart)))));
    return select(facing, scaled_exp(T(T(1) / cos_i), T(-n * log_cosine)), T(0));
  }
};

}  // namespace gonio
