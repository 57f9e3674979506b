#pragma once
// The reflection models with polarised light: Mueller matrices of a BRDF, per steradian.
//
// Stokes vectors are taken in the frames of the mean plane: incident light (propagating along -i) in that of i and the normal,
// reflected light (along o) in that of o and the normal; signs in optics/mueller.h. Known are
//   faceted lobes   the facet that mirrors i into o acts as Fresnel's amplitudes say (Torrance-Sparrow's facets; for the
//                   Kirchhoff models, Beckmann's, Stogryn's and He's, the field of the stationary points, as He et al. 1991 take it);
//   the diffuse part, Oren-Nayar's Lambertian facets: ideal depolarisers.
// Not stated: lobes whose parameters hold their reflectance (Ward, Lafortune, …), lobes turned back (`retro`), Stogryn's
// in-plane forms. polarisation_law() tells.
#include "base/special.h"
#include "brdf/brdf.h"
#include "optics/fresnel_amplitudes.h"

namespace gonio {

/// phi = phi_o - phi_i, from what stays accurate on the mirror side (phi = 180°): sin phi and 1 + cos phi.
template <class T>
struct Azimuth {
  T sin_phi, one_plus_cos;
  T cos_phi() const { return one_plus_cos - T(1); }
};

template <class T>
Azimuth<T> azimuth_from_deg(const T& phi_deg) {
  using std::abs, std::fmod;
  const T turned_deg = fmod(phi_deg, T(360));
  const T delta_deg = turned_deg > T(0) ? turned_deg - T(180) : turned_deg + T(180);  // in [-180, 180]
  const T size = abs(delta_deg), sine = sin_deg(size <= T(90) ? size : T(T(180) - size));
  return {delta_deg > T(0) ? T(-sine) : sine, T(2) * square(sin_deg(T(T(0.5) * size)))};
}

/// From the components of i and h. A direction along the normal has no azimuth: it is put on the mirror side of the other
/// (any choice is a turn of the frames about the normal); one who knows the azimuth meant gives it.
template <class T>
Azimuth<T> azimuth_of(const Directions<T>& w) {
  const T sines = safe_sqrt(T((square(w.ix) + square(w.iy)) * (square(w.ox) + square(w.oy))));
  const auto known = sines > T(0);
  const T divisor = select(known, sines, T(1)), sine = (w.ix * w.hy - w.iy * w.hx) / divisor;
  const T cosine = (w.ix * w.ox + w.iy * w.oy) / divisor;
  const auto mirror_side = cosine < T(0);
  const T near = square(sine) / (T(1) - select(mirror_side, cosine, T(0)));
  return {select(known, sine, T(0)), select(known, select(mirror_side, near, T(1) + cosine), T(0))};
}

/// The facet's Jones matrix between the frames of the mean plane is Rot(-ψ_o)·diag(r_s, r_p)·Rot(ψ_i), where
///   |i×o|·(cos, sin)ψ_i = (-o·p_i, o·s_i),  |i×o|·(cos, sin)ψ_o = (-i·p_o, i·s_o):
/// He et al.'s and Stogryn's separated form, 0/0 where o = i. In sums and differences of the ψ the divisor goes: with
/// S, C sines and cosines, φ the azimuth between i and o,
///   2cos²θ_d·(cos, sin)(ψ_i + ψ_o) = (-(S_i·S_o + (1 + C_i·C_o)cos φ), (C_i + C_o)sin φ)   =: sum
///   2sin²θ_d·(cos, sin)(ψ_i - ψ_o) = (S_i·S_o - (1 - C_i·C_o)cos φ, (C_i - C_o)sin φ)       =: difference
/// for o on either side of the surface. ½(r_s - r_p) and ½(r_s + r_p) weigh the two as w·cos θ_d to sin²θ_d
/// (optics/fresnel_amplitudes.h), so that J ∝ (w/cos θ_d)·[sum] + [difference], finite everywhere above the horizon:
/// exactly normal, retro (J ∝ diag(1, -1)) and mirror (ψ = 0) directions.
template <class T>
struct FacetTurn {
  T sum_cos, sum_sin, difference_cos, difference_sin;
};
template <class T>
FacetTurn<T> facet_turn(const Directions<T>& w, const Azimuth<T>& azimuth) {
  const T sines = safe_sqrt(T((square(w.ix) + square(w.iy)) * (square(w.ox) + square(w.oy)))),
          cosines = w.cos_i * w.cos_o;
  // 2cos²θ_d - (1 + cos φ)(1 + C_i·C_o + S_i·S_o): the form above would cancel where both directions graze.
  return {T(2) * square(w.cos_d) - azimuth.one_plus_cos * ((T(1) + cosines) + sines),
          (w.cos_i + w.cos_o) * azimuth.sin_phi, sines - (T(1) - cosines) * azimuth.cos_phi(),
          (w.cos_i - w.cos_o) * azimuth.sin_phi};
}

/// The facet's Jones matrix but for a factor; never 0.
template <class T, class G>
Jones<T> facet_jones(const Directions<G>& w, const Azimuth<G>& azimuth, const Interface<T>& surface) {
  const FacetTurn<G> turn = facet_turn(w, azimuth);
  const T cos_d(w.cos_d), sum_cos(turn.sum_cos), sum_sin(turn.sum_sin);
  // A perfect conductor has r_p = -r_s: the difference drops out.
  const T still = surface.perfect ? T(0) : T(1);
  const Complex<T> root = surface.perfect ? Complex<T>{T(1), T(0)} : refracted_root(cos_d, surface.n, surface.k);
  const Complex<T> u = T(T(1) / cos_d) * root;
  const T difference_cos = still * T(turn.difference_cos), difference_sin = still * T(turn.difference_sin);
  return {{u.re * sum_cos + difference_cos, u.im * sum_cos},
          {u.re * sum_sin + difference_sin, u.im * sum_sin},
          {u.re * sum_sin - difference_sin, u.im * sum_sin},
          {difference_cos - u.re * sum_cos, -u.im * sum_cos}};
}

/// The same for light that a facet refracts from i into o below the surface (o.z < 0). t_s : t_p = -(i·o) : 1 (Snell's law at
/// the facet), so that J ∝ [difference] - [sum] whatever the index.
template <class T>
Jones<T> refraction_jones(const UnitVector<T>& i, const UnitVector<T>& o, const Azimuth<T>& azimuth) {
  const T sines = safe_sqrt(T((square(i.x) + square(i.y)) * (square(o.x) + square(o.y)))), cos_phi = azimuth.cos_phi();
  const auto real = [](const T& x) { return Complex<T>{x, T(0)}; };
  return {real(T(sines + i.z * o.z * cos_phi)), real(T(-o.z * azimuth.sin_phi)), real(T(-i.z * azimuth.sin_phi)),
          real(T(-cos_phi))};
}

/// Mueller matrix divided by its m11. (Where R = 0 for want of a contrast it is the limit as the contrast vanishes.)
template <class T>
Mueller<T> normalised_mueller(const Jones<T>& jones) {
  const Mueller<T> mueller = mueller_of(jones);
  return T(T(1) / mueller.m[0][0]) * mueller;
}
template <class T, class G>
Mueller<T> facet_polarisation(const Directions<G>& w, const Azimuth<G>& azimuth, const Interface<T>& surface) {
  return normalised_mueller(facet_jones(w, azimuth, surface));
}

/// What the model says becomes of polarisation.
enum class PolarisationLaw { facets, depolarising, not_stated };

template <class T>
PolarisationLaw polarisation_law(const Brdf<T>& brdf) {
  if (std::holds_alternative<Lambert>(brdf.lobe) || std::holds_alternative<OrenNayar<T>>(brdf.lobe))
    return brdf.retro ? PolarisationLaw::not_stated : PolarisationLaw::depolarising;
  const auto* stogryn = std::get_if<Stogryn<T>>(&brdf.lobe);
  const bool one_polarisation = stogryn && stogryn->form != StogrynForm::exact;
  return brdf.facets() && !brdf.retro && !one_polarisation ? PolarisationLaw::facets : PolarisationLaw::not_stated;
}
inline std::string_view name_of(PolarisationLaw law) {
  if (law == PolarisationLaw::facets) return "facets";
  return law == PolarisationLaw::depolarising ? "depolarising" : "not stated";
}
template <class T>
bool states_polarisation(const Brdf<T>& brdf) {
  return polarisation_law(brdf) != PolarisationLaw::not_stated;
}

/// The BRDF as a Mueller matrix, 1/sr, of a model that states polarisation; m11 is evaluate() of the same. `lobe_per_sr` is added
/// to its lobe (the coherent part of a patch).
template <class T, class G>
Mueller<T> evaluate_mueller(const Brdf<T>& brdf, const Directions<G>& w, const Azimuth<G>& azimuth,
                            const Interface<T>& surface, const T& wavelength_um, const T& lobe_per_sr = T(0)) {
  const T lobe = evaluate_lobe(brdf, w, surface, wavelength_um) + lobe_per_sr;
  Mueller<T> f = lobe * (brdf.facets() ? facet_polarisation(w, azimuth, surface) : depolariser<T>());
  f.m[0][0] = evaluate_diffuse(brdf, surface) + lobe;
  return f;
}

/// f_r in sr⁻¹ of linearly polarised light, received in any polarisation: m11 + m12·cos 2α + m13·sin 2α of the above.
template <class T, class G>
T evaluate_linear(const Brdf<T>& brdf, const Directions<G>& w, const Azimuth<G>& azimuth, const Interface<T>& surface,
                  const T& wavelength_um, const LinearLight<T>& light, const T& lobe_per_sr = T(0)) {
  const T lobe = evaluate_lobe(brdf, w, surface, wavelength_um) + lobe_per_sr;
  if (!brdf.facets()) return evaluate_diffuse(brdf, surface) + lobe;
  const Jones<T> jones = facet_jones(w, azimuth, surface);
  return evaluate_diffuse(brdf, surface) + lobe * (intensity_of(jones, light) / unpolarised_intensity_of(jones));
}

/// The coherent delta in the mirror direction: energies.
template <class T, class C>
Mueller<T> coherent_mueller(const Brdf<T>& brdf, const C& cos_i, const Interface<T>& surface, const T& wavelength_um) {
  if (!has_delta(brdf.lobe)) return filled_mueller(T(0));
  return T(brdf.ks * coherent_share(brdf.lobe, cos_i, wavelength_um)) * reflection_mueller(T(cos_i), surface);
}

}  // namespace gonio
