#pragma once
#include "brdf/directions.h"
#include "surface/normals.h"
#include "surface/shadowing.h"

namespace gonio {

/// Torrance & Sparrow 1967 (J. Opt. Soc. Am. 57, 1105) with a normalised Beckmann density of normals:
///   f = D(h)·G(i, o)·F(cos_d)/(4·cos_i·cos_o);  shape() is the lobe without F.
/// Symbols: alpha = √2·m > 0 (dimensionless), m slope rms; G by name (Shadowing). Single scattering: E <= 1 for every G but
/// `none`; reciprocal; finite up to grazing. As alpha → 0 it tends to a mirror's delta.
template <class T>
struct TorranceSparrow {
  static constexpr bool kFacets = true, kDiffracts = false;
  T alpha;
  Shadowing shadowing = Shadowing::smith_correlated;

  template <class G>
  T shape(const Directions<G>& w) const {
    const T g = shadowing_masking<T>(shadowing, w, alpha);
    return beckmann_d(T(w.tan2_h), alpha) * g / (T(4) * T(w.cos_i) * T(w.cos_o));
  }
};

}  // namespace gonio
