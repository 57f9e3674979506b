#pragma once
// surface: slope and normal laws, shadowing. m = slope rms (one-dimensional), alpha = √2·m = tan β0 of Beckmann.
#include "base/ratio.h"
#include "base/scaled_exp.h"

namespace gonio {

/// exp(-2x)·(1 + tan²)²/norm, the exponential as the square of its scaled root: 1/(π α² 4 cos_i cos_o) reaches 1e18, and f keeps its digits
/// long after exp(-tan²ζ/α²) has left the range of float.
template <class T, class C>
Ratio<T> gaussian_fraction(const T& x, const C& tan2, const T& norm) {
  const C scale(16777216.0);
  return {square(T(exp_of_decay<0>(T(-x)) * multiply_add(scale, tan2, scale))), T(square(scale)) * norm};
}

/// Beckmann's density of normals, per steradian; ∫ D cos dω = 1.
/// Beckmann & Spizzichino 1963 (their p(β) as a density over solid angle); D = exp(-tan²ζ/α²)/(π α² cos⁴ζ).
template <class T, class C>
Ratio<T> beckmann_fraction(const C& tan2_h, const T& alpha) {
  return gaussian_fraction(T(tan2_h * T(T(0.5) / square(alpha))), tan2_h, T(kPi<T> * square(alpha)));
}
template <class T>
T beckmann_d(const T& tan2_h, const T& alpha) {
  return beckmann_fraction(tan2_h, alpha).value();
}
/// Times `scale`, which may bring back what float would flush.
template <class T>
T beckmann_d(const T& tan2_h, const T& alpha, const T& scale) {
  return scaled_exp(T(scale / (kPi<T> * square(alpha))), T(tan2_h / square(alpha)), T(T(1) + tan2_h));
}

/// Schlick 1992's rational density for Beckmann's, with its 1/π: (t - 1 + 2α²)³/(8π·t·α⁸), t = cos ζ, 0 below t = 1 - 2α²; meant for
/// α <= 1/√2 (above, it diverges at grazing half vectors). 1 - t is taken from tan², without cancellation.
template <class T>
T schlick_d(const T& tan2_h, const T& alpha) {
  using std::sqrt;
  const T root = sqrt(T(1) + tan2_h), fall = tan2_h / (root * (T(1) + root));  // 1 - t
  const T left = larger_of(T(0), T(T(2) - fall / square(alpha)));
  return left * square(left) * root / (T(8) * kPi<T> * square(alpha));
}

/// The thesis's slope law, Maillot 1996 eq. (28): P(ζ) = exp(-tan²ζ/(2m²))/(m √(2π) cos²ζ), a density over the angle ζ in
/// a plane, not over solid angle. Times `scale`.
template <class T>
T thesis_slope_density(const T& tan2_h, const T& slope_rms, const T& scale) {
  return scaled_exp(T(scale * (T(1) + tan2_h) / (slope_rms * kSqrt2Pi<T>)), T(tan2_h / (T(2) * square(slope_rms))));
}
template <class T>
T thesis_slope_density(const T& tan2_h, const T& slope_rms) {
  return thesis_slope_density(tan2_h, slope_rms, T(1));
}

}  // namespace gonio
