#pragma once
// spectrum: wavelength grids, sums over observers, colour spaces and differences. Formulas here; sums in colorimetry.h.
// CIE 015:2018 (exact constants), ISO/CIE 11664-4, -5, -6; IEC 61966-2-1 for sRGB.
#include <array>
#include <cmath>

#include "base/number.h"

namespace gonio {

/// Tristimulus values. Their scale is the caller's (Y = 100 for the perfect diffuser in reports, Y = 1 in renders).
template <class T>
struct Xyz {
  T x, y, z;
};

template <class T>
struct Chromaticity {
  T x, y;
};

/// CIELAB (L, a, b) or CIELUV (L, u, v).
template <class T>
struct Lab {
  T l, a, b;
};
template <class T>
struct Luv {
  T l, u, v;
};
template <class T>
struct Rgb {
  T r, g, b;
};

/// x, y; (0, 0) for black, which has none.
template <class T>
Chromaticity<T> chromaticity(const Xyz<T>& c) {
  const T sum = c.x + c.y + c.z, safe = select(sum > T(0), sum, T(1));
  return {c.x / safe, c.y / safe};
}

/// u' = 4X/(X + 15Y + 3Z), v' = 9Y/(…); (0, 0) for black.
template <class T>
Chromaticity<T> uniform_chromaticity(const Xyz<T>& c) {
  const T sum = c.x + T(15) * c.y + T(3) * c.z, safe = select(sum > T(0), sum, T(1));
  return {T(4) * c.x / safe, T(9) * c.y / safe};
}

/// CIE's cube root with its linear branch below (6/29)³: (841/108)·t + 16/116.
template <class T>
T lightness_root(const T& t) {
  using std::cbrt;
  const T branch = T(216) / T(24389);
  return select(t > branch, cbrt(t), T(841) / T(108) * t + T(4) / T(29));
}

/// L* from Y/Yn; 0 to 100 for 0 to 1.
template <class T>
T lightness(const T& y_ratio) {
  return T(116) * lightness_root(y_ratio) - T(16);
}

template <class T>
Lab<T> lab(const Xyz<T>& c, const Xyz<T>& white) {
  const T fx = lightness_root(T(c.x / white.x)), fy = lightness_root(T(c.y / white.y)),
          fz = lightness_root(T(c.z / white.z));
  return {T(116) * fy - T(16), T(500) * (fx - fy), T(200) * (fy - fz)};
}

/// Below (6/29)³ of the white L* = (29/3)³·Y/Yn, the same line as lightness(). Black lies at u = v = 0.
template <class T>
Luv<T> luv(const Xyz<T>& c, const Xyz<T>& white) {
  const T l = lightness(T(c.y / white.y));
  const Chromaticity<T> at = uniform_chromaticity(c), origin = uniform_chromaticity(white);
  return {l, T(13) * l * (at.x - origin.x), T(13) * l * (at.y - origin.y)};
}

template <class T>
T delta_e_ab(const Lab<T>& p, const Lab<T>& q) {
  using std::sqrt;
  return sqrt(square(p.l - q.l) + square(p.a - q.a) + square(p.b - q.b));
}

template <class T>
T delta_e_uv(const Luv<T>& p, const Luv<T>& q) {
  using std::sqrt;
  return sqrt(square(p.l - q.l) + square(p.u - q.u) + square(p.v - q.v));
}

/// CIEDE2000 with k_L = k_C = k_H = 1: ISO/CIE 11664-6:2014; Sharma, Wu & Dalal, Color Res. Appl. 30, 21-30 (2005),
/// whose rules decide the hue difference and mean where hues lie on both sides of 0° or one colour is grey.
template <class T>
T delta_e_2000(const Lab<T>& p, const Lab<T>& q) {
  using std::abs, std::atan2, std::cos, std::exp, std::pow, std::sin, std::sqrt;
  const T pi = kPi<T>, degree = pi / T(180), power_25_7 = T(6103515625.0);
  const auto chroma = [](const T& a, const T& b) { return sqrt(square(a) + square(b)); };
  const auto chroma_share = [&](const T& c) { return sqrt(pow(c, T(7)) / (pow(c, T(7)) + power_25_7)); };
  const T stretch = T(1.5) - T(0.5) * chroma_share((chroma(p.a, p.b) + chroma(q.a, q.b)) / T(2));
  const T a1 = stretch * p.a, a2 = stretch * q.a, c1 = chroma(a1, p.b), c2 = chroma(a2, q.b);
  const auto hue = [&](const T& a, const T& b) {  // 0 to 2π
    const T h = a == T(0) && b == T(0) ? T(0) : T(atan2(b, a));
    return h < T(0) ? T(h + T(2) * pi) : h;
  };
  const T h1 = hue(a1, p.b), h2 = hue(a2, q.b);
  const bool grey = c1 * c2 == T(0), wraps = abs(h2 - h1) > pi;
  const T turn = grey || !wraps ? T(0) : h2 > h1 ? T(T(-2) * pi) : T(T(2) * pi);
  const T dh = T(2) * sqrt(c1 * c2) * sin(grey ? T(0) : T((h2 - h1 + turn) / T(2)));
  const T sum = h1 + h2;
  const T mean_turn = grey || !wraps ? T(0) : sum < T(2) * pi ? T(2) * pi : T(T(-2) * pi);
  const T h = grey ? sum : T((sum + mean_turn) / T(2));
  const T l = (p.l + q.l) / T(2), c = (c1 + c2) / T(2), l50 = square(l - T(50));
  const T t = T(1) - T(0.17) * cos(h - T(30) * degree) + T(0.24) * cos(T(2) * h) +
              T(0.32) * cos(T(3) * h + T(6) * degree) - T(0.20) * cos(T(4) * h - T(63) * degree);
  const T s_l = T(1) + T(0.015) * l50 / sqrt(T(20) + l50), s_c = T(1) + T(0.045) * c, s_h = T(1) + T(0.015) * c * t;
  const T rotation = T(60) * degree * exp(-square((h / degree - T(275)) / T(25)));
  const T r_t = -sin(rotation) * T(2) * chroma_share(c);
  const T x = (q.l - p.l) / s_l, y = (c2 - c1) / s_c, z = dh / s_h;
  return sqrt(square(x) + square(y) + square(z) + r_t * y * z);
}

/// Linear sRGB (Rec. 709 primaries, D65) of tristimulus values with Y = 1 for white; not clipped.
/// IEC 61966-2-1, the seven-digit matrix of its amendment 1.
template <class T>
Rgb<T> linear_srgb(const Xyz<T>& c) {
  return {T(3.2406255) * c.x - T(1.5372080) * c.y - T(0.4986286) * c.z,
          T(-0.9689307) * c.x + T(1.8757561) * c.y + T(0.0415175) * c.z,
          T(0.0557101) * c.x - T(0.2040211) * c.y + T(1.0569959) * c.z};
}

/// The sRGB transfer curve, linear 0..1 to encoded 0..1 (IEC 61966-2-1); the caller clips.
template <class T>
T srgb_encoded(const T& linear) {
  using std::pow;
  const T in_curve = larger_of(linear, T(0.0031308));
  return select(linear <= T(0.0031308), T(12.92) * linear, T(1.055) * pow(in_curve, T(1) / T(2.4)) - T(0.055));
}

/// Its inverse.
template <class T>
T srgb_decoded(const T& encoded) {
  using std::pow;
  const T in_curve = larger_of(encoded, T(0.04045));
  return select(encoded <= T(0.04045), encoded / T(12.92), pow((in_curve + T(0.055)) / T(1.055), T(2.4)));
}

}  // namespace gonio
