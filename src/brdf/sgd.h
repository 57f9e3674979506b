#pragma once
#include "brdf/direction_samplers.h"
#include "brdf/directions.h"

namespace gonio {

/// Bagher, Soler & Holzschuch 2012 (Comput. Graph. Forum 31(4), 1509, doi:10.1111/j.1467-8659.2012.03147.x), shifted gamma:
///   f = F·D(h)·G1(i)·G1(o)/(π·cos_i·cos_o),
///   D = K·exp(-τ)/τ^p/(π·cos⁴θ_h), τ = alpha + tan²θ_h/alpha, K = 1/(alpha·Γ(1-p, alpha)): ∫ D cos dω = 1,
///   F = F0 - F1·cos_d + (1 - F0)(1 - cos_d)⁵,
///   G1(θ) = 1 + Λ·(1 - exp(c·(θ - θ0)^k)) for θ > θ0, else 1 (a fit of the integral that D implies).
/// Symbols: alpha roughness, p decay; f_normal = F0 - F1, the reflectance at normal incidence; θ0 in radians;
/// theta_c = c^(-1/k) in radians stands for the table's c, so that c·(θ-θ0)^k = ((θ-θ0)/theta_c)^k (c runs to 1e109).
/// K and G1's constants are inputs, as tabulated; nothing checks that they belong to alpha and p. ks is ρs; the 1/π is the
/// tables' (with it they agree with Low's fits of the same materials, not with 4).
/// Reciprocal. F and the fitted G1 are kept from falling below 0. Where Λ = 0 there is no shadowing and E is unbounded at
/// grazing. G1 is steep (k to 900): in float it loses up to k·1e-7.
template <class T>
struct ShiftedGamma {
  static constexpr bool kFacets = false, kDiffracts = false;
  T alpha, p, k_norm, f0, f_normal, lambda, theta_c, k, theta0;

  /// F in sums of equal signs: u⁵ + cos_d·(f_normal + F0·(u + u² + u³ + u⁴)), u = 1 - cos_d from |i - o|² = 4·sin²θ_d.
  template <class G>
  T facet(const Directions<G>& w) const {
    const T c = T(w.cos_d);
    const T u = T(square(w.ix - w.ox) + square(w.iy - w.oy) + square(w.cos_i - w.cos_o)) / (T(4) * (T(1) + c)), u2 = square(u);
    return larger_of(T(square(u2) * u + c * (f_normal + f0 * u * (T(1) + u) * (T(1) + u2))), T(0));
  }
  /// tan² of the angle with the normal.
  T g1(const T& tan2) const {
    using std::atan, std::exp, std::expm1, std::log, std::sqrt;
    const T past = atan(sqrt(larger_of(tan2, T(1e-30)))) - theta0;
    const auto shadowed = past > T(0);
    const T ratio = select(shadowed, past, theta_c) / theta_c;
    const T steep = exp(smaller_of(T(k * log(ratio)), T(4)));
    return select(shadowed, larger_of(T(T(1) - lambda * expm1(smaller_of(steep, T(50)))), T(0)), T(1));
  }
  FacetSampler<T> sampler() const {
    using std::sqrt;
    return {sqrt(alpha), sqrt(alpha), {SlopeKind::shifted_gamma, alpha, p}};
  }

  template <class G>
  T shape(const Directions<G>& w) const {
    using std::exp, std::log, std::log1p;
    const T t = T(w.tan2_h), tau = alpha + t / alpha;
    // In two halves: exp of the whole would leave float's range long before f does.
    const T half = exp(T(0.5) * (-tau - p * log(tau)) + log1p(t));
    const T d = k_norm / kPi<T> * half;
    const T rest = facet(w) * g1(T(w.tan2_i)) * g1(T(w.tan2_o)) / (kPi<T> * T(w.cos_i) * T(w.cos_o));
    return d * rest * half;
  }
};

}  // namespace gonio
