#pragma once
// Reflection models as textbooks print them and published code computes them, in plain float or double: what the
// stability maps set beside this project's own forms. Kept for the assessment only.
#include <algorithm>
#include <array>
#include <cmath>

#include "base/unit_vector.h"

namespace gonio::published {

template <class S>
constexpr S kPi = S(3.14159265358979323846L);

/// Formulas (5) of Maillot 1996 as printed, R_p with sin·tan: unpolarised.
template <class S>
S fresnel(S c, S n, S k) {
  const S s2 = 1 - c * c, s = std::sqrt(s2), t = n * n - k * k - s2, q = std::sqrt(t * t + 4 * n * n * k * k);
  const S a = std::sqrt((q + t) / 2), b2 = (q - t) / 2, st = s * (s / c);
  const S rs = ((a - c) * (a - c) + b2) / ((a + c) * (a + c) + b2);
  return (rs + rs * ((a - st) * (a - st) + b2) / ((a + st) * (a + st) + b2)) / 2;
}

/// Smith's Λ as the difference of an exponential and erfc, from the angle.
template <class S>
S smith_lambda(S theta, S alpha) {
  const S a = 1 / (alpha * std::tan(theta));
  return (std::exp(-a * a) / (a * std::sqrt(kPi<S>)) - std::erfc(a)) / 2;
}

/// Half vector normalised, its angle from acos, Beckmann's D, separable Smith, Fresnel.
template <class S>
S torrance_sparrow(S alpha, const UnitVector<S>& i, const UnitVector<S>& o, S n, S k) {
  const UnitVector<S> h = normalised(S(i.x + o.x), S(i.y + o.y), S(i.z + o.z));
  const S zeta = std::acos(std::min(S(1), h.z)), t = std::tan(zeta), c2 = h.z * h.z;
  const S d = std::exp(-t * t / (alpha * alpha)) / (kPi<S> * alpha * alpha * c2 * c2);
  const S g = 1 / ((1 + smith_lambda(std::acos(i.z), alpha)) * (1 + smith_lambda(std::acos(o.z), alpha)));
  return d * g * fresnel(dot(i, h), n, k) / (4 * i.z * o.z);
}

/// Beckmann's D of two widths, the azimuth of the half vector from atan2.
template <class S>
S anisotropic_beckmann(S alpha_x, S alpha_y, const UnitVector<S>& i, const UnitVector<S>& o) {
  const UnitVector<S> h = normalised(S(i.x + o.x), S(i.y + o.y), S(i.z + o.z));
  const S c2 = h.z * h.z, t2 = (1 - c2) / c2, phi = std::atan2(h.y, h.x), cx = std::cos(phi) / alpha_x,
          cy = std::sin(phi) / alpha_y;
  return std::exp(-t2 * (cx * cx + cy * cy)) / (kPi<S> * alpha_x * alpha_y * c2 * c2) / (4 * i.z * o.z);
}

/// Angles of a pair: cos_i, sin_i, cos_o, sin_o, and cos φ.
template <class S>
std::array<S, 5> angles_of(const UnitVector<S>& i, const UnitVector<S>& o) {
  const S si = std::sqrt(1 - i.z * i.z), so = std::sqrt(1 - o.z * o.z);
  const S phi = std::atan2(o.y, o.x) - std::atan2(i.y, i.x);
  return {i.z, si, o.z, so, std::cos(phi)};
}

/// (18a) with `terms` terms of g^m/m! by a running product from exp(-g), F' from 1 + cos·cos - sin·sin·cos θ3 (θ3 = φ -
/// 180°).
template <class S>
S kirchhoff_sum(S g, S b, int terms) {
  S power = std::exp(-g), sum = 0;
  for (int m = 1; m <= terms; ++m) {
    power *= g / S(m);
    sum += power / S(m) * std::exp(-b / S(m));
  }
  return sum;
}
template <class S>
S kirchhoff(S sigma_um, S correlation_um, S wavelength_um, const UnitVector<S>& i, const UnitVector<S>& o, int terms) {
  const auto [ci, si, co, so, cos_phi] = angles_of(i, o);
  const S f = (1 + ci * co + si * so * cos_phi) / (ci + co), wave = 2 * kPi<S> / wavelength_um;
  const S v2 = wave * wave * (si * si + 2 * si * so * cos_phi + so * so), root = wave * sigma_um * (ci + co);
  const S sum = kirchhoff_sum(S(root * root), S(v2 * correlation_um * correlation_um / 4), terms);
  return kPi<S> * correlation_um * correlation_um * f * f / (wavelength_um * wavelength_um * ci * co) * sum;
}

/// He et al. 1991: G from cross products of s and p, Newton for the effective roughness, Λ as a difference, `terms`
/// terms.
template <class S>
S he(S sigma0_um, S correlation_um, S wavelength_um, const UnitVector<S>& i, const UnitVector<S>& o, int terms) {
  const auto cross = [](const UnitVector<S>& a, const UnitVector<S>& b) {
    return UnitVector<S>{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  };
  const UnitVector<S> ki{-i.x, -i.y, -i.z}, up{0, 0, 1}, ci = cross(ki, up), co = cross(o, up);
  const UnitVector<S> si = normalised(ci.x, ci.y, ci.z), so = normalised(co.x, co.y, co.z), pi = cross(si, ki),
                      po = cross(so, o);
  const UnitVector<S> v{o.x - ki.x, o.y - ki.y, o.z - ki.z}, across = cross(o, ki);
  const S v2 = dot(v, v), c2 = dot(across, across), a = dot(so, ki), b = dot(po, ki), c = dot(si, o), d = dot(pi, o);
  const S geometry = v2 * v2 / (v.z * v.z) * (a * a + b * b) * (c * c + d * d) / (c2 * c2);
  const auto slope = [&](S z) { return correlation_um / (2 * sigma0_um * std::tan(std::acos(z))); };
  const auto hidden = [&](S z) { return std::tan(std::acos(z)) * std::erfc(slope(z)); };
  const auto seen = [&](S z) {
    const S x = slope(z), e = std::erfc(x);
    return (1 - e / 2) / (1 + (std::exp(-x * x) / (x * std::sqrt(kPi<S>)) - e) / 2);
  };
  const S right = (hidden(i.z) + hidden(o.z)) * sigma0_um / 4;
  S z0 = 0;
  for (int step = 0; step < 20; ++step) {
    const S e = std::exp(-z0 * z0 / (2 * sigma0_um * sigma0_um)), f = std::sqrt(kPi<S> / 2) * z0 - right * e;
    z0 -= f / (std::sqrt(kPi<S> / 2) + right * e * z0 / (sigma0_um * sigma0_um));
  }
  const S ratio = z0 / sigma0_um, sigma = sigma0_um / std::sqrt(1 + ratio * ratio), wave = 2 * kPi<S> / wavelength_um;
  const S root = wave * sigma * v.z, flat2 = wave * wave * (v.x * v.x + v.y * v.y);
  const S sum = kirchhoff_sum(S(root * root), S(flat2 * correlation_um * correlation_um / 4), terms);
  return geometry * seen(i.z) * seen(o.z) * kPi<S> * correlation_um * correlation_um /
         (4 * wavelength_um * wavelength_um) * sum / (i.z * o.z);
}

}  // namespace gonio::published
