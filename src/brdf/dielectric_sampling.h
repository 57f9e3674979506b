#pragma once
#include "brdf/rough_dielectric.h"
#include "optics/smooth_dielectric.h"

namespace gonio {

/// A direction drawn from a rough dielectric as seen from v, with f(v→to)·|cos_to|/pdf of it. Where v is the eye and light
/// comes from `to`, the other way's f is that over n² for transmitted light.
template <class T>
struct DielectricSample {
  UnitVector<T> direction;
  T pdf_per_sr;
  T weight;
  decltype(std::declval<T>() < std::declval<T>()) transmitted;  ///< bool, or a mask of lanes
};

/// Walter et al. 2007, eq. (14), (17): the density of visible normals turned into one of directions,
///   reflected D·G1(v)·F/(4·v_z), refracted D·G1(v)·(v·h)/v_z·(1-F)·n²·|t·h|/|v + n·t|² = f_t·|t_z|/G1(t).
/// v (z > 0) is where the light is known, n the index of the far over v's side (below the surface: turn both over, 1/n).
template <class T>
T dielectric_pdf(const RoughDielectric<T>& lobe, const UnitVector<T>& v, const UnitVector<T>& to, const T& n) {
  const T tan2_v = (square(v.x) + square(v.y)) / square(v.z);
  const auto above = to.z > T(0);
  const T z = select(above, to.z, T(1));
  const Directions<T> w = reduce(v.x, v.y, v.z, to.x, to.y, z);
  const T reflected = lobe.density(w.tan2_h) * lobe.g1(tan2_v) / (T(4) * v.z) * fresnel(w.cos_d, n, T(0)).unpolarised();
  const RefractingFacet<T> facet = refracting_facet(v, to, n);
  const T refracted = facet.a * facet.b / square(facet.length2) * square(n) * facet.transmittance *
                      lobe.density(facet.tan2) * lobe.g1(tan2_v) / v.z;
  return select(above, reflected, refracted);
}

/// Draws a normal as v sees it, Smith's (facet_sampler.h), from u1 and u2, and reflects with probability F, else refracts, by u3; the weight
/// is G1 of the direction drawn, and 0 (empty) where that falls on the wrong side.
template <class T>
DielectricSample<T> sample_dielectric(const RoughDielectric<T>& lobe, const UnitVector<T>& v, const T& n, const T& u1,
                                      const T& u2, const T& u3) {
  const UnitVector<T> h = lobe.sampler().normal(v, u1, u2);
  const T c = dot(v, h);
  const DielectricShares<T> shares = dielectric_shares(c, n);
  const auto transmitted = u3 >= shares.reflected.unpolarised();
  const T along = select(transmitted, T(c / n - shares.cos_t), T(T(2) * c)),
          back = select(transmitted, T(T(1) / n), T(1));
  const UnitVector<T> to =
      normalised(T(along * h.x - back * v.x), T(along * h.y - back * v.y), T(along * h.z - back * v.z));
  const T up = select(transmitted, T(-to.z), to.z);
  const auto valid = c > T(0) && up > T(0);
  const UnitVector<T> safe{select(valid, to.x, v.x), select(valid, to.y, v.y), select(valid, to.z, v.z)};
  const T tan2 = (square(safe.x) + square(safe.y)) / square(safe.z);
  return {to, select(valid, dielectric_pdf(lobe, v, safe, n), T(0)), select(valid, lobe.g1(tan2), T(0)), transmitted};
}

}  // namespace gonio
