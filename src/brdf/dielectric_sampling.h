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
  bool transmitted;
};

/// A normal of GGX's surface as seen from v (z > 0), density D·G1(v)·(v·h)/v_z: Dupuy & Benyoub 2023 (HPG,
/// doi:10.1111/cgf.14867), a cap of the unit sphere in the stretched space. u1, u2 in (0, 1).
template <class T>
UnitVector<T> visible_ggx_normal(const T& alpha, const UnitVector<T>& v, const T& u1, const T& u2) {
  using std::cos, std::sin, std::sqrt;
  const UnitVector<T> w = normalised(T(alpha * v.x), T(alpha * v.y), v.z);
  const T phi = T(2) * kPi<T> * u1, z = (T(1) - u2) * (T(1) + w.z) - w.z;
  const T radius = sqrt(larger_of(T((T(1) - z) * (T(1) + z)), T(0)));
  return normalised(T(alpha * (radius * cos(phi) + w.x)), T(alpha * (radius * sin(phi) + w.y)), T(z + w.z));
}

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
  const T refracted = facet.a * facet.b / square(facet.length2) * square(n) * facet.transmittance * lobe.density(facet.tan2) *
                      lobe.g1(tan2_v) / v.z;
  return select(above, reflected, refracted);
}

/// Draws a visible normal of GGX, and reflects with probability F, else refracts; the weight is G1 of the direction drawn, and
/// 0 where that falls on the wrong side.
template <class T>
DielectricSample<T> sample_dielectric(const RoughDielectric<T>& lobe, const UnitVector<T>& v, const T& n, const T& u1, const T& u2,
                                      const T& u3) {
  const UnitVector<T> h = visible_ggx_normal(lobe.alpha, v, u1, u2);
  const T c = dot(v, h);
  const DielectricShares<T> shares = dielectric_shares(c, n);
  const bool transmitted = u3 >= shares.reflected.unpolarised();
  const T along = transmitted ? c / n - shares.cos_t : T(2) * c, back = transmitted ? T(1) / n : T(1);
  const UnitVector<T> to = normalised(T(along * h.x - back * v.x), T(along * h.y - back * v.y), T(along * h.z - back * v.z));
  if ((to.z < T(0)) != transmitted || to.z == T(0)) return {to, T(0), T(0), transmitted};
  const T tan2 = (square(to.x) + square(to.y)) / square(to.z);
  return {to, dielectric_pdf(lobe, v, to, n), lobe.g1(tan2), transmitted};
}

}  // namespace gonio
