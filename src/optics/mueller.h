#pragma once
// Polarised light as intensities: Stokes vectors and Mueller matrices.
//
// (I, Q, U, V), Q = I_s - I_p, U = I_+45 - I_-45, V = I_right - I_left. For the direction of propagation k and the normal n:
// s = k×n/|k×n|, p = k×s, so that (s, p, k) is right-handed; +45° lies between s and p. In fields (time factor e^{-iωt})
// Q + I = 2|E_s|², U + iV = 2·E_s·conj(E_p): right is clockwise for who looks towards the source (Bohren & Huffman 1983, §2.11).
// At normal incidence p turns over on reflection, so a mirror has m33 = m44 = -1.
#include <array>

#include "optics/complex.h"

namespace gonio {

template <class T>
using Stokes = std::array<T, 4>;

/// m[row][column]; m[0][0] is what files call m11.
template <class T>
struct Mueller {
  std::array<std::array<T, 4>, 4> m;
};

/// Of light that adds up without interfering.
template <class T>
Mueller<T>& operator+=(Mueller<T>& sum, const Mueller<T>& one) {
  for (std::size_t r = 0; r < 4; ++r)
    for (std::size_t c = 0; c < 4; ++c) sum.m[r][c] += one.m[r][c];
  return sum;
}

/// What an element does to the field: E_out = J·E_in, first index the polarisation that leaves.
template <class T>
struct Jones {
  Complex<T> ss, sp, ps, pp;
};

template <class T>
Mueller<T> filled_mueller(const T& value) {
  std::array<T, 4> row;
  row.fill(value);
  Mueller<T> all;
  all.m.fill(row);
  return all;
}

/// Unpolarised light whatever comes in.
template <class T>
Mueller<T> depolariser() {
  Mueller<T> all = filled_mueller(T(0));
  all.m[0][0] = T(1);
  return all;
}

template <class T>
Mueller<T> operator*(const Mueller<T>& a, const Mueller<T>& b) {
  Mueller<T> product = filled_mueller(T(0));
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      for (int i = 0; i < 4; ++i) product.m[row][column] += a.m[row][i] * b.m[i][column];
  return product;
}
template <class T>
Mueller<T> operator*(const T& factor, const Mueller<T>& a) {
  Mueller<T> scaled = a;
  for (auto& row : scaled.m)
    for (T& element : row) element = factor * element;
  return scaled;
}
template <class T>
Stokes<T> operator*(const Mueller<T>& a, const Stokes<T>& light) {
  Stokes<T> out;
  for (int row = 0; row < 4; ++row)
    out[row] = a.m[row][0] * light[0] + a.m[row][1] * light[1] + a.m[row][2] * light[2] + a.m[row][3] * light[3];
  return out;
}

/// The same element as intensities (van de Hulst 1957, §5.14, in the conventions above).
template <class T>
Mueller<T> mueller_of(const Jones<T>& j) {
  const T half = T(0.5), ss = norm(j.ss), sp = norm(j.sp), ps = norm(j.ps), pp = norm(j.pp);
  const Complex<T> s_row = j.ss * conj(j.sp), p_row = j.ps * conj(j.pp), s_column = j.ss * conj(j.ps),
                   p_column = j.sp * conj(j.pp);
  const Complex<T> straight = j.ss * conj(j.pp), crossed = j.sp * conj(j.ps);
  Mueller<T> out;
  out.m[0] = {half * ((ss + pp) + (sp + ps)), half * ((ss - pp) + (ps - sp)), s_row.re + p_row.re,
              -s_row.im - p_row.im};
  out.m[1] = {half * ((ss - pp) - (ps - sp)), half * ((ss + pp) - (sp + ps)), s_row.re - p_row.re, p_row.im - s_row.im};
  out.m[2] = {s_column.re + p_column.re, s_column.re - p_column.re, straight.re + crossed.re, crossed.im - straight.im};
  out.m[3] = {s_column.im + p_column.im, s_column.im - p_column.im, straight.im + crossed.im, straight.re - crossed.re};
  return out;
}

/// Stokes vectors seen from a frame (s, p) turned by ψ about k, s' = s·cos ψ + p·sin ψ, from the cosine and sine of 2ψ.
template <class T>
Mueller<T> stokes_rotation(const T& cos_2psi, const T& sin_2psi) {
  Mueller<T> turned = depolariser<T>();
  turned.m[1] = {T(0), cos_2psi, sin_2psi, T(0)};
  turned.m[2] = {T(0), -sin_2psi, cos_2psi, T(0)};
  turned.m[3][3] = T(1);
  return turned;
}

/// Linearly polarised light of intensity 1, its field at the angle α from s towards p (Maillot 1996, eq. (3)).
template <class T>
struct LinearLight {
  T cos_alpha, sin_alpha;
  /// (1, cos 2α, sin 2α, 0).
  Stokes<T> stokes() const {
    return {T(1), (cos_alpha - sin_alpha) * (cos_alpha + sin_alpha), T(2) * sin_alpha * cos_alpha, T(0)};
  }
};

/// What of it leaves the element, all polarisations together: (1, 0, 0, 0)·M·stokes() without its cancellation.
template <class T>
T intensity_of(const Jones<T>& j, const LinearLight<T>& light) {
  const T &s = light.cos_alpha, &p = light.sin_alpha;
  return norm(s * j.ss + p * j.sp) + norm(s * j.ps + p * j.pp);
}
/// The same of unpolarised light: m11.
template <class T>
T unpolarised_intensity_of(const Jones<T>& j) {
  return T(0.5) * ((norm(j.ss) + norm(j.pp)) + (norm(j.sp) + norm(j.ps)));
}

}  // namespace gonio
