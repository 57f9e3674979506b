#pragma once
#include "base/ratio.h"

namespace gonio {

/// Reflectances for light polarised perpendicular (s) and parallel (p) to the plane of incidence.
template <class T>
struct Polarised {
  T s, p;
  T unpolarised() const { return T(0.5) * (s + p); }
};

/// What Fresnel's formulas take from the index N = n + ik and from the angle. With c = cos θ, w = a + ib = √(N² - sin²θ):
///   w² = t + 2ink,  t = (n-1)(n+1) - k² + c²,  q = |w²| = √(t² + 4n²k²) = a² + b²,
/// the larger of a, b from 2·max(a², b²) = q + |t|, the other from a·b = n·k.
template <class T>
struct FresnelTerms {
  T q, t, twice;   ///< twice max(a², b²)
  T two_a_c;       ///< 2·a·c
  T contrast2;     ///< |N² - 1|²
  T s_sum, p_sum;  ///< |c + w|² and q·c² + 2ac·s² + s⁴
  T p_even;        ///< q·c² + s⁴
};

/// cos2 may be a number without derivatives where n and k have some.
template <class C, class T>
FresnelTerms<T> fresnel_terms(const C& cos2, const T& n, const T& k) {
  using std::abs, std::sqrt;
  const T two_nk = T(2) * n * k, four_n2k2 = square(two_nk), contrast = (n - T(1)) * (n + T(1)) - square(k);
  FresnelTerms<T> f;
  const C s2 = C(1) - cos2;
  f.contrast2 = square(contrast) + four_n2k2;
  f.t = contrast + cos2;
  f.q = sqrt(larger_of(multiply_add(f.t, f.t, four_n2k2), T(1e-36)));  // its root has no derivative at 0
  f.twice = f.q + abs(f.t);
  f.two_a_c = select(f.t >= T(0), f.twice, two_nk) * sqrt(larger_of(T((cos2 + cos2) / f.twice), T(1e-36)));
  f.p_even = multiply_add(f.q, cos2, C(square(s2)));
  f.s_sum = f.q + f.two_a_c + cos2;
  f.p_sum = multiply_add(f.two_a_c, s2, f.p_even);
  return f;
}

/// Unpolarised reflectance of an interface with complex index n + ik (k >= 0) relative to the incident medium, as a
/// function of cos²θ. Maillot 1996, §I.1.3, eq. (5), from the amplitude r_s = (c - w)/(c + w) = (1 - N²)/(c + w)², so that
///   R_s = |N² - 1|²/|c + w|⁴,  R = R_s·(q·c² + s⁴)/(q·c² + 2ac·s² + s⁴):
/// sums of positive terms, also near index match, in total reflection and with weak absorption. Next to the critical angle R
/// is ill-conditioned by nature.
/// Domain: 0 <= cos²θ <= 1, n > 0, k >= 0. At grazing incidence R = 1; at normal incidence ((n-1)²+k²)/((n+1)²+k²).
template <class C, class T>
Ratio<T> unpolarised_reflectance(const C& cos2, const T& n, const T& k) {
  const FresnelTerms<T> f = fresnel_terms(cos2, n, k);
  return {f.contrast2 * f.p_even, square(f.s_sum) * f.p_sum};
}

/// The same for each polarisation: R_p = R_s·((ac - s²)² + b²c²)/(q·c² + 2ac·s² + s⁴), whose numerator is a sum of squares.
/// At c = 0 both are 1, but for n = 1, k = 0, where there is no boundary.
template <class T>
Polarised<T> fresnel(const T& cos_theta, const T& n, const T& k) {
  using std::sqrt;
  const T& c = cos_theta;
  const T cos2 = square(c), s2 = (T(1) - c) * (T(1) + c);
  const FresnelTerms<T> f = fresnel_terms(cos2, n, k);
  const T root = sqrt(T(T(0.5) * f.twice)), other = n * k / root;
  const T a = select(f.t >= T(0), root, other), b = select(f.t >= T(0), other, root);
  const T r_s = f.contrast2 / square(f.s_sum);
  return {r_s, r_s * (square(a * c - s2) + square(b * c)) / f.p_sum};
}

/// Schlick's approximation of the unpolarised reflectance (1992, Comput. Graph. Forum 13, 233, eq. (24)).
template <class T>
T schlick_fresnel(const T& cos_theta, const T& f0) {
  const T c = T(1) - cos_theta, c2 = square(c);
  return f0 + (T(1) - f0) * square(c2) * c;
}

/// Reflectance at normal incidence, R0.
template <class T>
T normal_reflectance(const T& n, const T& k) {
  return (square(n - T(1)) + square(k)) / (square(n + T(1)) + square(k));
}

}  // namespace gonio
