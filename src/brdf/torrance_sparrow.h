#pragma once
#include "brdf/direction_samplers.h"
#include "brdf/directions.h"
#include "surface/normals.h"
#include "surface/shadowing.h"

namespace gonio {

/// Exact, or with rational functions in place of parts: Schlick 1992's F, D, G or all three; Walter et al. 2007's G. A rational G
/// stands for both directions apart (separable), whatever shadowing is named.
enum class FacetForm { exact, schlick_f, schlick_d, schlick_g, schlick, walter_g };

/// Torrance & Sparrow 1967 (J. Opt. Soc. Am. 57, 1105) with a normalised Beckmann density of normals:
///   f = D(h)·G(i, o)·F(cos_d)/(4·cos_i·cos_o);  shape() is the lobe without F.
/// Symbols: alpha = √2·m > 0 (dimensionless), m slope rms; G by name (Shadowing). Single scattering: E <= 1 for every G but
/// `none`; reciprocal; finite up to grazing. As alpha → 0 it tends to a mirror's delta.
template <class T>
struct TorranceSparrow {
  static constexpr bool kFacets = true, kDiffracts = false;
  T alpha;
  Shadowing shadowing = Shadowing::smith_correlated;
  FacetForm form = FacetForm::exact;
  bool schlick_fresnel = false;

  FacetSampler<T> sampler() const {
    const bool own_masking = form == FacetForm::exact || form == FacetForm::schlick_f || form == FacetForm::schlick_d;
    return facets_seen(alpha, alpha, SlopeKind::gaussian, own_masking ? shadowing : Shadowing::smith_separable);
  }

  template <class G>
  T shape(const Directions<G>& w) const {
    const bool rational_d = form == FacetForm::schlick_d || form == FacetForm::schlick;
    const T d = rational_d ? schlick_d(T(w.tan2_h), alpha) : beckmann_d(T(w.tan2_h), alpha);
    return d * masking(w) / (T(4) * T(w.cos_i) * T(w.cos_o));
  }

 private:
  template <class G>
  T masking(const Directions<G>& w) const {
    if (form == FacetForm::schlick_g || form == FacetForm::schlick)
      return schlick_g1(T(w.cos_i), alpha) * schlick_g1(T(w.cos_o), alpha);
    if (form == FacetForm::walter_g) return walter_g1(T(w.tan2_i), alpha) * walter_g1(T(w.tan2_o), alpha);
    return shadowing_masking<T>(shadowing, w, alpha);
  }
};

}  // namespace gonio
