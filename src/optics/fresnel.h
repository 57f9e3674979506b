#pragma once
#include "base/number.h"

namespace gonio {

/// Reflectances for light polarised perpendicular (s) and parallel (p) to the plane of incidence.
template <class T>
struct Polarised {
  T s, p;
  T unpolarised() const { return T(0.5) * (s + p); }
};

/// Fresnel's reflectance of an interface with complex index n + ik (k >= 0) relative to the incident medium.
///
/// Maillot 1996, §I.1.3, eq. (5) with a², b² (Ditchburn's form), written so that nothing cancels:
///   s² = (1-c)(1+c), t = (n-1)(n+1) - k² + c², q = √(t² + 4n²k²),
///   a² = (q+t)/2, b² = (q-t)/2 (the larger from its root, the other from a·b = n·k),
///   R_s = (q - 2ac + c²)/(q + 2ac + c²),  R_p = R_s·(q·c² - 2ac·s² + s⁴)/(q·c² + 2ac·s² + s⁴).
/// The numerators are taken as sums of squares, (a-c)² + b² and (ac-s²)² + b²c², and near index match
///   a - c = ((n-1)(n+1) - k² + b²)/(a + c).
/// Domain: 0 <= cos_theta <= 1, n > 0, k >= 0; covers k = 0, weak absorption and total reflection (n < 1).
/// At grazing incidence R = 1; at normal incidence R = ((n-1)²+k²)/((n+1)²+k²).
template <class T>
Polarised<T> fresnel(const T& cos_theta, const T& n, const T& k) {
  using std::abs, std::sqrt;
  const T& c = cos_theta;
  const T s2 = (T(1) - c) * (T(1) + c);
  const T t = (n - T(1)) * (n + T(1)) - square(k) + square(c);
  const T nk = n * k;
  const T q = sqrt(square(t) + T(4) * square(nk));
  const T larger = sqrt(T(0.5) * (q + abs(t)));
  const T smaller = select(larger > T(0), nk / select(larger > T(0), larger, T(1)), T(0));
  const T a = select(t >= T(0), larger, smaller), b = select(t >= T(0), smaller, larger);
  const T contrast = (n - T(1)) * (n + T(1)), a_plus_c = a + c;
  const T a_minus_c = select(square(k) < abs(contrast) && t >= T(0) && a_plus_c > T(0),
                             (contrast - square(k) + square(b)) / select(a_plus_c > T(0), a_plus_c, T(1)), a - c);
  const T cross = T(2) * a * c;
  const T s_sum = q + cross + square(c);
  const T r_s = select(s_sum > T(0), (square(a_minus_c) + square(b)) / select(s_sum > T(0), s_sum, T(1)), T(1));
  const T p_sum = q * square(c) + cross * s2 + square(s2);
  const T p_difference = square(a * c - s2) + square(b * c);
  return {r_s, r_s * p_difference / p_sum};
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
