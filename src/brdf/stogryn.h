#pragma once
#include "brdf/direction_samplers.h"
#include "brdf/directions.h"
#include "optics/interface.h"
#include "surface/normals.h"

namespace gonio {

/// Which reflectance multiplies the lobe, in the order of the model's variants: of unpolarised light, or the in-plane
/// expression for s or p light.
enum class StogrynForm { exact, in_plane_s, in_plane_p };

/// Stogryn 1967 (Radio Science 2(4), 415), very rough surfaces (g ≫ 1) of finite conductivity, as Maillot 1996 §I.2.3.4 gives it:
///   f = R·D(h)/(4·cos_i·cos_o), D Beckmann's with alpha = 2σ/T,
/// the rough limit of Beckmann-Kirchhoff, with R by polarisation at θ_d, half the angle between i and o:
///   in-plane-s, in-plane-p   R_s(θ_d), R_p(θ_d): meant in the plane of incidence, where light keeps its polarisation;
///   exact                    ½(R_s + R_p), the mean of the two expressions out of the plane (stogryn_out_of_plane below), which
///                            are what incident s and p light gives (`--polarisation s`, `p`), received in any polarisation.
/// The thesis stops there: the expressions do not tell the components of the reflected field. The facet that mirrors i into
/// o does (brdf/polarised.h), and its sums over the received polarisation are these expressions.
/// Symbols: alpha = √2·m. No shadowing: unbounded at grazing, not conserving. Reciprocal (unpolarised).
template <class T>
struct Stogryn {
  static constexpr bool kFacets = true, kDiffracts = false;
  T alpha;
  StogrynForm form = StogrynForm::exact;

  T facet_reflectance(const T& cos_d, const Interface<T>& surface) const {
    if (form == StogrynForm::exact) return surface.reflectance(cos_d);
    const Polarised<T> r = surface.polarised(cos_d);
    return form == StogrynForm::in_plane_s ? r.s : r.p;
  }

  FacetSampler<T> sampler() const { return facets_seen(alpha, alpha, SlopeKind::gaussian, Shadowing::none); }

  template <class G>
  T shape(const Directions<G>& w) const {
    return beckmann_d(T(w.tan2_h), alpha) / (T(4) * T(w.cos_i) * T(w.cos_o));
  }
};

/// Reflectances of s and p light out of the plane (received polarisations together), as printed:
///   I = s: (R_s·(q_ip·q_r)² + R_p·(q_is·q_r)²)/((q_ip·q_r)² + (q_is·q_r)²);  I = p: s and p of R exchanged,
/// q_ip, q_is the incident light's p and s; the printed divisor (of q_rp, q_rs on q_i) is the same, |i×o|².
/// As i → o (retro-reflection, 0/0) both are R at normal incidence. sin_phi, cos_phi: azimuth of o less that of i.
template <class T>
Polarised<T> stogryn_out_of_plane(const Directions<T>& w, const T& sin_phi, const T& cos_phi,
                                  const Interface<T>& surface) {
  using std::sqrt;
  const T sin_i = sqrt(square(w.ix) + square(w.iy)), sin_o = sqrt(square(w.ox) + square(w.oy));
  const T p_o = square(w.cos_i * sin_o * cos_phi - sin_i * w.cos_o), s_o = square(sin_o * sin_phi), sum = p_o + s_o;
  const T share = select(sum > T(0), T(p_o / select(sum > T(0), sum, T(1))), T(1));  // of R_s in incident s light
  const Polarised<T> r = surface.polarised(w.cos_d);
  return {r.s * share + r.p * (T(1) - share), r.p * share + r.s * (T(1) - share)};
}

}  // namespace gonio
