#pragma once
// A smooth interface between transparent media, and a slab of two of them. All of it is delta: what is given are shares of
// energy, never densities. The index n(λ) of the far over the near medium comes from the caller (SurfaceMaterial::at), so
// that dispersion is in the direction and in the shares alike. Born & Wolf, Principles of Optics, §1.5.
#include "base/unit_vector.h"
#include "optics/absorption.h"
#include "optics/fresnel.h"

namespace gonio {

/// What an interface does with light of each polarisation; reflected + transmitted = 1.
template <class T>
struct DielectricShares {
  Polarised<T> reflected, transmitted;
  T cos_t;  ///< cosine of the refracted direction, 0 in total reflection
};

/// T_s = 4nc·c_t/(c + n·c_t)², T_p = 4nc·c_t/(nc + c_t)², without the difference 1 - R; c_t² = 1 - (1-c)(1+c)/n².
/// Domain: 0 <= cos_theta <= 1, n > 0 (n < 1: towards the thinner medium, total reflection from sin θ = n). At c = 0 T = 0.
template <class T>
DielectricShares<T> dielectric_shares(const T& cos_theta, const T& n) {
  using std::sqrt;
  const T& c = cos_theta;
  // n² - 1 + c² as a sum that keeps n → 1; below 0 the light is totally reflected.
  const T squared = multiply_add(T(n - T(1)), T(n + T(1)), T(square(c)));
  const auto enters = squared > T(0) && c > T(0);
  const T n_cos_t = select(enters, T(sqrt(select(enters, squared, T(1)))), T(0));
  const T cos_t = n_cos_t / n;
  const T numerator = T(4) * c * n_cos_t;
  const T s = select(enters, T(c + n_cos_t), T(1)), p = select(enters, T(n * c + cos_t), T(1));
  const Polarised<T> through{numerator / square(s), numerator / square(p)};
  // c - n·c_t = -(n²-1)/s and n·c - c_t = (n²-1)(c·s - 1)/(s·n): no difference left as n → 1.
  const T contrast = (n - T(1)) * (n + T(1));
  const Polarised<T> back{select(enters, T(square(contrast / square(s))), T(1)),
                          select(enters, T(square(contrast * (c * s - T(1)) / (s * n * p))), T(1))};
  return {back, through, cos_t};
}

/// The direction into which light from `from` (towards the source, z > 0) is refracted, z < 0; (0, 0, 0) in total reflection.
template <class T>
UnitVector<T> refracted(const UnitVector<T>& from, const T& n) {
  const T cos_t = dielectric_shares(from.z, n).cos_t;
  const T scale = select(cos_t > T(0), T(T(-1) / n), T(0));
  return {from.x * scale, from.y * scale, -cos_t};
}

/// A plane-parallel slab thicker than the coherence length, of index n + ik against the surrounding medium, k ≪ n: every
/// path between its faces summed, t = exp(-4πk·d/(λ·cos_t)) a pass, r a face's reflectance (the same from inside):
///   R = r + r(1-r)²t²/(1 - r²t²), T = (1-r)²t/(1 - r²t²); absorbed is the rest.
template <class T>
struct SlabShares {
  Polarised<T> reflected, transmitted;
};

template <class T>
SlabShares<T> slab_shares(const T& cos_theta, const T& n, const T& k, const T& thickness, const T& wavelength) {
  const DielectricShares<T> face = dielectric_shares(cos_theta, n);
  const auto enters = face.cos_t > T(0);
  const T pass = internal_transmittance(k, T(thickness / select(enters, face.cos_t, T(1))), wavelength);
  const auto through = [&](const T& r, const T& t) {
    const T left = select(enters, T(T(1) - square(r * pass)), T(1));  // r < 1 wherever light enters
    return select(enters, T(square(t) * pass / left), T(0));
  };
  const T s = through(face.reflected.s, face.transmitted.s), p = through(face.reflected.p, face.transmitted.p);
  return {{face.reflected.s * (T(1) + pass * s), face.reflected.p * (T(1) + pass * p)}, {s, p}};
}

}  // namespace gonio
