#pragma once
// brdf: the reflection models, each written once over its number type, their sampling and the list of them.
#include "base/number.h"

namespace gonio {

/// What a reflection model needs of a pair of directions: i towards the light, o towards the eye, both away from the
/// surface; h = i + o. Isotropic lobes about the half vector need the scalars alone; the others the components too.
/// Tangents come from components: a cosine near 1 has lost the angle (at alpha = 1e-4: 1e-8 in double, factors in float), so
/// it is never turned back into a sine.
template <class T>
struct Directions {
  T cos_i, cos_o;                                ///< with the mean normal, > 0
  T cos_d;                                       ///< half vector with either direction
  T tan2_h;                                      ///< half vector with the mean normal
  T tan2_i, tan2_o;                              ///< directions with the mean normal
  T ix = T(0), iy = T(0), ox = T(0), oy = T(0);  ///< components in the mean plane, x along the grain
  T hx = T(0), hy = T(0);                        ///< of h = i + o, not normalised

  T cos_h() const { return (cos_i + cos_o) / (T(2) * cos_d); }
  /// cos²θ_d = |i + o|²/4 = (cos_i + cos_o)²·(1 + tan²θ_h)/4, without the root of cos_d.
  T cos2_d() const { return T(0.25) * square(cos_i + cos_o) * (T(1) + tan2_h); }
};

/// From unit vectors in the surface's frame (z = mean normal).
template <class T>
Directions<T> reduce(const T& ix, const T& iy, const T& iz, const T& ox, const T& oy, const T& oz) {
  using std::sqrt;
  const T hx = ix + ox, hy = iy + oy, hz = iz + oz;
  const T h_xy2 = multiply_add(hx, hx, square(hy)), h_z2 = square(hz), i_z2 = square(iz), o_z2 = square(oz);
  // One division for three tangents, two in float, whose exponents end before (cos 1e-6)⁶.
  constexpr bool kFloat = std::is_same_v<scalar_t<T>, float>;
  const T both = i_z2 * o_z2, inverse = T(1) / (kFloat ? both : T(both * h_z2));
  const T inverse_both = kFloat ? inverse : T(inverse * h_z2), inverse_h = kFloat ? T(T(1) / h_z2) : T(inverse * both);
  return {iz,
          oz,
          T(0.5) * sqrt(h_xy2 + h_z2),  // |i + o| = 2 cos_d
          h_xy2 * inverse_h,
          multiply_add(ix, ix, square(iy)) * (inverse_both * o_z2),
          multiply_add(ox, ox, square(oy)) * (inverse_both * i_z2),
          ix,
          iy,
          ox,
          oy,
          hx,
          hy};
}

/// 1 - cos_d without loss next to retro-reflection, from |i - o|² = 4·sin²θ_d.
template <class T>
T one_minus_cos_d(const Directions<T>& w) {
  return (square(T(w.ix - w.ox)) + square(T(w.iy - w.oy)) + square(T(w.cos_i - w.cos_o))) / (T(4) * (T(1) + w.cos_d));
}

/// i replaced by its mirror image about the normal, (-ix, -iy, iz): a lobe of these directions peaks towards the light.
/// The "back vector" of Belcour et al. 2014, eq. (4).
template <class T>
Directions<T> turned_back(const Directions<T>& w) {
  return reduce(T(-w.ix), T(-w.iy), w.cos_i, w.ox, w.oy, w.cos_o);
}

/// The pair with light and eye exchanged (Helmholtz).
template <class T>
Directions<T> swapped(const Directions<T>& w) {
  return {w.cos_o, w.cos_i, w.cos_d, w.tan2_h, w.tan2_o, w.tan2_i, w.ox, w.oy, w.ix, w.iy, w.hx, w.hy};
}

/// Sine and cosine of an angle in degrees, 0 to 90: taken on the side of 45° where nothing is lost.
template <class T>
T sin_deg(const T& angle_deg);
template <class T>
T cos_deg(const T& angle_deg) {
  using std::cos, std::sin;
  return angle_deg <= T(45) ? T(cos(angle_deg * (kPi<T> / T(180)))) : T(sin((T(90) - angle_deg) * (kPi<T> / T(180))));
}
template <class T>
T sin_deg(const T& angle_deg) {
  using std::cos, std::sin;
  return angle_deg <= T(45) ? T(sin(angle_deg * (kPi<T> / T(180)))) : T(cos((T(90) - angle_deg) * (kPi<T> / T(180))));
}

/// From angles in degrees: zenith angles 0 <= theta < 90, phi = phi_o - phi_i (180 = mirror side), phi_i from the grain (x).
/// The component of i + o along the plane of incidence, sin_i - sin_o·cos δ with δ = phi - 180°, is formed from differences
/// of the angles:
///   u² = (sin_i - sin_o)² + 4 sin_i sin_o sin²(δ/2), w = cos_i + cos_o, tan²θ_h = u²/w², 4cos²θ_d = u² + w².
template <class T>
Directions<T> directions_from_deg(const T& theta_i_deg, const T& theta_o_deg, const T& phi_deg,
                                  const T& phi_i_deg = T(0)) {
  using std::abs, std::cos, std::fmod, std::sin, std::sqrt;
  const T to_radians = kPi<T> / T(180);
  T turned_deg = fmod(phi_deg, T(360));  // into (-180, 180], so that δ is small on the mirror side whatever the turn
  turned_deg =
      select(turned_deg > T(180), turned_deg - T(360), select(turned_deg <= T(-180), turned_deg + T(360), turned_deg));
  const T delta_deg = select(turned_deg > T(0), turned_deg - T(180), turned_deg + T(180));
  const T sin_i = sin_deg(theta_i_deg), sin_o = sin_deg(theta_o_deg);
  const T cos_i = cos_deg(theta_i_deg), cos_o = cos_deg(theta_o_deg);
  const T half_sum =
      T(0.5) * ((T(90) - theta_i_deg) + (T(90) - theta_o_deg));  // 90° - mean: its sine is the mean's cosine
  const T sine_difference = T(2) * sin(half_sum * to_radians) * sin(T(0.5) * (theta_i_deg - theta_o_deg) * to_radians);
  const T half_sine2 = square(T(sin(T(0.5) * delta_deg * to_radians)));
  const T u2 = square(sine_difference) + T(4) * sin_i * sin_o * half_sine2;
  const T w = cos_i + cos_o;
  // In and across the plane of incidence, then turned to the grain.
  const T h_in = sine_difference + T(2) * sin_o * half_sine2, h_across = -sin_o * sin(delta_deg * to_radians);
  const T c = cos(phi_i_deg * to_radians), s = sin(phi_i_deg * to_radians);
  const T ix = sin_i * c, iy = sin_i * s, hx = h_in * c - h_across * s, hy = h_in * s + h_across * c;
  return {cos_i,
          cos_o,
          T(0.5) * T(sqrt(u2 + square(w))),
          u2 / square(w),
          square(sin_i / cos_i),
          square(sin_o / cos_o),
          ix,
          iy,
          hx - ix,
          hy - iy,
          hx,
          hy};
}

}  // namespace gonio
