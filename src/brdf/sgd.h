#pragma once
#include "base/in_double.h"
#include "base/special.h"
#include "brdf/direction_samplers.h"
#include "brdf/directions.h"

namespace gonio {

/// 1 + Λ·(1 - exp(((θ - θ0)/θ_c)^k)) of the direction (x, y, z), kept from falling below 0.
template <class N>
N fitted_g1(const N& x, const N& y, const N& z, const N& theta0, const N& theta_c, const N& k, const N& lambda) {
  using std::atan, std::expm1, std::log, std::sqrt;
  const N past = N(atan(sqrt(larger_of(N((square(x) + square(y)) / square(z)), N(1e-30))))) - theta0;
  const auto shadowed = past > N(0);
  const N ratio = select(shadowed, past, theta_c) / theta_c;
  const N steep = fast_exp(smaller_of(N(k * log(ratio)), N(4)));
  return select(shadowed, larger_of(N(N(1) - lambda * expm1(smaller_of(steep, N(50)))), N(0)), N(1));
}

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
/// grazing. G1 is steep (k to 900), so float lanes take it in double.
template <class T>
struct ShiftedGamma {
  static constexpr bool kFacets = false, kDiffracts = false;
  T alpha, p, k_norm, f0, f_normal, lambda, theta_c, k, theta0;

  /// F in sums of equal signs: u⁵ + cos_d·(f_normal + F0·(u + u² + u³ + u⁴)), u = 1 - cos_d from |i - o|² = 4·sin²θ_d.
  template <class G>
  T facet(const Directions<G>& w) const {
    const T c = T(w.cos_d);
    const T u = T(one_minus_cos_d(w)), u2 = square(u);
    return larger_of(T(square(u2) * u + c * (f_normal + f0 * u * (T(1) + u) * (T(1) + u2))), T(0));
  }
  /// Of a direction, from its components: tan² rounded to float would cost k times that rounding.
  T g1(const T& x, const T& y, const T& z) const {
    return in_double([]<class N>(const N& x, const N& y, const N& z, const N& theta0, const N& theta_c, const N& k,
                                 const N& lambda) { return fitted_g1(x, y, z, theta0, theta_c, k, lambda); },
                     x, y, z, theta0, theta_c, k, lambda);
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
    const T rest = facet(w) * g1(T(w.ix), T(w.iy), T(w.cos_i)) * g1(T(w.ox), T(w.oy), T(w.cos_o)) /
                   (kPi<T> * T(w.cos_i) * T(w.cos_o));
    return d * rest * half;
  }
};

}  // namespace gonio
