#pragma once
// Fresnel's amplitudes and what they do to polarised light. Signs: time factor e^{-iωt}, index n + ik, s = k×n, p = k×s
// (optics/mueller.h); p turns over at normal incidence, where r_p = -r_s (Born & Wolf, Principles of Optics, §1.5).
#include "base/special.h"
#include "optics/absorption.h"
#include "optics/complex.h"
#include "optics/interface.h"
#include "optics/mueller.h"
#include "optics/smooth_dielectric.h"

namespace gonio {

template <class T>
struct FresnelAmplitudes {
  Complex<T> s, p;
};

/// w = √(N² - sin²θ) = N·cos θ_t, N = n + ik, Im w >= 0: a + ib of optics/fresnel.h.
template <class T>
Complex<T> refracted_root(const T& cos_theta, const T& n, const T& k) {
  const ComplexIndex<T> w =
      index_of_permittivity(T((n - T(1)) * (n + T(1)) - square(k) + square(cos_theta)), T(T(2) * n * k));
  return {w.n, w.k};
}

/// r_s = (c - w)/(c + w) = (1 - N²)/(c + w)²,  r_p = (N²c - w)/(N²c + w) = r_s·(s² - c·w)/(s² + c·w), s² = 1 - c²: the
/// second forms lose nothing near index match. |r_s|², |r_p|² are R_s, R_p of fresnel(); in total reflection the phases
/// differ by δ_s - δ_p, tan(½(δ_s - δ_p)) = c·√(s² - n²)/s². Domain as there; at c = 0 r_s = r_p = -1.
template <class T>
FresnelAmplitudes<T> fresnel_amplitudes(const T& cos_theta, const T& n, const T& k) {
  const T& c = cos_theta;
  const Complex<T> w = refracted_root(c, n, k), sum{c + w.re, w.im}, cw = c * w;
  const auto opens = norm(sum) > T(0);  // only n = 1, k = 0 at c = 0 does not
  const Complex<T> divisor{select(opens, sum.re, T(1)), sum.im},
      contrast{square(k) - (n - T(1)) * (n + T(1)), T(-2) * n * k};
  const Complex<T> s = contrast / (divisor * divisor);
  const T s2 = (T(1) - c) * (T(1) + c);
  const Complex<T> p = s * (Complex<T>{s2 - cw.re, -cw.im} / Complex<T>{s2 + cw.re, cw.im});
  return {{select(opens, s.re, T(-1)), s.im}, {select(opens, p.re, T(-1)), p.im}};
}

/// Amplitudes behind a dielectric (k = 0): t_s = 2c/(c + w), t_p = 2nc/(n²c + w) = n·t_s/(s² + c·w); w imaginary in total
/// reflection (the evanescent field at the boundary). T_s = |t_s|²·Re w/c, T_p likewise, are those of dielectric_shares().
template <class T>
FresnelAmplitudes<T> transmission_amplitudes(const T& cos_theta, const T& n) {
  const T& c = cos_theta;
  const Complex<T> w = refracted_root(c, n, T(0)), sum{c + w.re, w.im}, cw = c * w;
  const auto opens = norm(sum) > T(0);
  const Complex<T> divisor{select(opens, sum.re, T(1)), sum.im};
  const Complex<T> s = Complex<T>{T(2) * c, T(0)} / divisor;
  const Complex<T> p = n * (s / Complex<T>{(T(1) - c) * (T(1) + c) + cw.re, cw.im});
  return {s, p};
}

namespace detail {
/// In the frames of the plane of incidence; cross = r_s·conj(r_p) (or the transmitted pair's).
template <class T>
Mueller<T> interface_of(const Polarised<T>& shares, const Complex<T>& cross) {
  const T mean = shares.unpolarised(), difference = T(0.5) * (shares.s - shares.p);
  Mueller<T> out = filled_mueller(T(0));
  out.m[0][0] = out.m[1][1] = mean;
  out.m[0][1] = out.m[1][0] = difference;
  out.m[2][2] = out.m[3][3] = cross.re;
  out.m[2][3] = -cross.im;
  out.m[3][2] = cross.im;
  return out;
}
}  // namespace detail

/// Mueller matrix of reflection at a plane interface, from the plane of incidence's frame into that of reflection:
///   m11 = m22 = (R_s + R_p)/2, m12 = m21 = (R_s - R_p)/2, m33 = m44 = Re r_s·conj(r_p), m43 = -m34 = Im r_s·conj(r_p),
///   r_s·conj(r_p) = R_s·((s² - ac)(s² + ac) - b²c² + 2i·bc·s²)/|s² + c·w|², w = a + ib.
/// A dielectric at Brewster's angle reflects s only: m12 = m11. `perfect` is a perfect conductor: diag(1, 1, -1, -1).
template <class T>
Mueller<T> reflection_mueller(const T& cos_theta, const Interface<T>& surface) {
  const T& c = cos_theta;
  const Polarised<T> shares = surface.polarised(c);
  if (surface.perfect) return detail::interface_of(shares, Complex<T>{T(-1), T(0)});
  const T s2 = (T(1) - c) * (T(1) + c);
  const Complex<T> cw = c * refracted_root(c, surface.n, surface.k);
  const T scale = shares.s / (square(s2 + cw.re) + square(cw.im));
  const Complex<T> cross{scale * ((s2 - cw.re) * (s2 + cw.re) - square(cw.im)), scale * T(2) * cw.im * s2};
  return detail::interface_of(shares, cross);
}

/// Mueller matrix of refraction into a dielectric: shares of energy, √(T_s·T_p) > 0 in place of the cross term.
template <class T>
Mueller<T> refraction_mueller(const T& cos_theta, const T& n) {
  const Polarised<T> shares = dielectric_shares(cos_theta, n).transmitted;
  return detail::interface_of(shares, Complex<T>{safe_sqrt(T(shares.s * shares.p)), T(0)});
}

/// What an interface reflects of linearly polarised light (Maillot 1996, eq. (3), there for T): R = R_s·cos²α + R_p·sin²α, α
/// between the field and s, the perpendicular to the plane of incidence.
template <class T>
T linear_share(const Polarised<T>& shares, const LinearLight<T>& light) {
  return shares.s * square(light.cos_alpha) + shares.p * square(light.sin_alpha);
}

}  // namespace gonio
