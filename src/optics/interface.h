#pragma once
// optics: Fresnel reflection, dispersion formulas.
#include "optics/fresnel.h"

namespace gonio {

/// The boundary a facet shows to light: complex index n + ik relative to the incident medium, or a perfect mirror.
template <class T>
struct Interface {
  T n = T(1), k = T(0);  // not {1}: a SIMD batch would take that for a list of lanes
  bool perfect = false;  ///< reflects 1 at every angle

  /// Unpolarised reflectance at the local angle of incidence (cos_d between a direction and the facet's normal).
  T reflectance(const T& cos_d) const { return reflectance_of_cos2(square(cos_d)).value(); }
  /// The same from cos²_d, as a fraction.
  template <class C>
  Ratio<T> reflectance_of_cos2(const C& cos2_d) const {
    return perfect ? whole(T(1)) : unpolarised_reflectance(cos2_d, n, k);
  }
  /// For light polarised in, or across, the plane of incidence of the facet.
  Polarised<T> polarised(const T& cos_d) const { return perfect ? Polarised<T>{T(1), T(1)} : fresnel(cos_d, n, k); }
  /// Schlick 1992: f0 + (1 - f0)(1 - cos_d)^5, f0 = R0.
  T schlick_reflectance(const T& cos_d) const { return perfect ? T(1) : schlick_fresnel(cos_d, r0()); }
  /// At normal incidence.
  T r0() const { return perfect ? T(1) : normal_reflectance(n, k); }
};

template <class T>
Interface<T> perfect_interface() {
  return {T(1), T(0), true};
}

}  // namespace gonio
