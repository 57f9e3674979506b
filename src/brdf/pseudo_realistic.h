#pragma once
#include "brdf/direction_samplers.h"
#include "brdf/directions.h"
#include "surface/normals.h"
#include "surface/shadowing.h"

namespace gonio {

/// The pseudo-realistic model, Maillot 1996, eq. (31), §II.3:
///   f = kd·R0/π + ks·G·R(cos_d)·P(ζ_h)/(4·cos_i·cos_o), V-cavity G, P the slope law (28), R unpolarised Fresnel.
/// shape() is the lobe without R. Symbols: slope_rms m > 0 (dimensionless), ζ_h angle of the half vector.
/// P is no density over solid angle: the hemispherical reflectance is about √(2π)·m for small m and exceeds 1 near grazing
/// at m = 1 (F = 1, 89°: 1.149), hence the conservation tables. Reciprocal; bounded.
template <class T>
struct PseudoRealistic {
  static constexpr bool kFacets = true, kDiffracts = false;
  T slope_rms;

  FacetSampler<T> sampler() const {
    const T alpha = kSqrt2<T> * slope_rms;
    return facets_seen(alpha, alpha, SlopeKind::gaussian, Shadowing::v_cavity);
  }

  template <class G>
  T shape(const Directions<G>& w) const {
    const T g = v_cavity(T(w.cos_i), T(w.cos_o), T(w.cos2_d())).value();
    return thesis_slope_density(T(w.tan2_h), slope_rms, T(g / (T(4) * T(w.cos_i) * T(w.cos_o))));
  }
};

}  // namespace gonio
