#pragma once
#include <span>
#include <variant>

#include "brdf/beckmann_kirchhoff.h"
#include "brdf/lambert.h"
#include "brdf/models.h"
#include "brdf/pseudo_realistic.h"
#include "brdf/torrance_sparrow.h"
#include "optics/interface.h"

namespace gonio {

/// The closed list of lobes: adding a model is one header, one line here and one in models.cpp, and its reference test.
template <class T>
using Lobe = std::variant<Lambert, PseudoRealistic<T>, TorranceSparrow<T>, BeckmannKirchhoff<T>>;

/// f = kd·ρd/π + ks·lobe, in sr⁻¹, without cosine. ρd = R0 in `pseudo-realistic`, 1 elsewhere.
template <class T>
struct Brdf {
  Lobe<T> lobe;
  T kd = T(0), ks = T(1);

  bool diffuse_times_r0() const { return std::holds_alternative<PseudoRealistic<T>>(lobe); }
};

/// The lobe without its reflectance R: sr⁻¹. Only beckmann-kirchhoff looks at the wavelength.
template <class T, class G>
T lobe_shape(const Lobe<T>& lobe, const Directions<G>& w, const T& wavelength_um) {
  return std::visit(
      [&]<class L>(const L& one) -> T {
        if constexpr (std::is_same_v<L, Lambert>) return T(0);
        else if constexpr (std::is_same_v<L, BeckmannKirchhoff<T>>) return one.shape(w, wavelength_um);
        else return one.shape(w);
      },
      lobe);
}

/// f_r in sr⁻¹ of a pair of directions above the horizon (cosines > 0). Deltas (the coherent part) evaluate to 0 here.
template <class T, class G>
T evaluate(const Brdf<T>& brdf, const Directions<G>& w, const Interface<T>& surface, const T& wavelength_um) {
  const T rho_d = brdf.diffuse_times_r0() ? surface.r0() : T(1);
  return brdf.kd * rho_d / kPi<T> + brdf.ks * surface.reflectance(T(w.cos_d)) * lobe_shape(brdf.lobe, w, wavelength_um);
}

/// Values in the order of the model's parameter list (kSlope…, kd, ks; lambert: kd).
template <class T>
Brdf<T> make_brdf(const ModelSpec& spec, std::span<const T> values) {
  using std::sqrt;
  switch (spec.id) {
    case ModelId::lambert: return {Lambert{}, values[0], T(0)};
    case ModelId::pseudo_realistic: return {PseudoRealistic<T>{values[0]}, values[1], values[2]};
    case ModelId::torrance_sparrow:
      return {TorranceSparrow<T>{kSqrt2<T> * values[0], spec.shadowing}, values[1], values[2]};
    case ModelId::beckmann_kirchhoff:
      return {BeckmannKirchhoff<T>{values[0], values[1], spec.form}, values[2], values[3]};
  }
  return {Lambert{}, T(0), T(0)};
}

/// Energy of the coherent delta in the mirror direction, R·exp(-g)·ks; 0 for the other models.
template <class T, class C>
T coherent_energy(const Brdf<T>& brdf, const C& cos_i, const Interface<T>& surface, const T& wavelength_um) {
  const auto* kirchhoff = std::get_if<BeckmannKirchhoff<T>>(&brdf.lobe);
  if (!kirchhoff || kirchhoff->form != KirchhoffForm::series) return T(0);
  return brdf.ks * surface.reflectance(T(cos_i)) * kirchhoff->coherent_share(cos_i, wavelength_um);
}

}  // namespace gonio
