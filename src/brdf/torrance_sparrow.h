#pragma once
#include "brdf/direction_samplers.h"
#include "brdf/directions.h"
#include "surface/normals.h"
#include "surface/smith_table.h"

namespace gonio {

/// Exact (1 + 2Λ as a fraction of polynomials: base/special.h), or with other functions in place of parts: Schlick 1992's F, D, G
/// or all three; Walter et al. 2007's G; Λ from erfcx, to the last place; Λ as Smith prints it, exp and erfc, which cancel where
/// Λ is small; G1 from a table (surface/smith_table.h). A rational G1 stands for both directions apart (separable), whatever shadowing is named; erfcx and erfc for
/// the Smith form that is named, and so the table.
enum class FacetForm { exact, schlick_f, schlick_d, schlick_g, schlick, walter_g, erfcx, erfc, tabulated };

/// Torrance & Sparrow 1967 (J. Opt. Soc. Am. 57, 1105) with a normalised Beckmann density of normals:
///   f = D(h)·G(i, o)·F(cos_d)/(4·cos_i·cos_o);  shape() is the lobe without F, shape_fraction() before its division.
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
    const bool other_masking =
        form == FacetForm::schlick_g || form == FacetForm::schlick || form == FacetForm::walter_g;
    return facets_seen(alpha, alpha, SlopeKind::gaussian, other_masking ? Shadowing::smith_separable : shadowing);
  }

  template <class G>
  Ratio<T> shape_fraction(const Directions<G>& w) const {
    const bool rational_d = form == FacetForm::schlick_d || form == FacetForm::schlick;
    const Ratio<T> d = rational_d ? whole(schlick_d(T(w.tan2_h), alpha)) : beckmann_fraction(w.tan2_h, alpha);
    return (d * masking(w)).divided_by(G(G(4) * w.cos_i * w.cos_o));
  }
  template <class G>
  T shape(const Directions<G>& w) const {
    return shape_fraction(w).value();
  }

 private:
  template <class G>
  Ratio<T> masking(const Directions<G>& w) const {
    switch (form) {
      case FacetForm::schlick_g:
      case FacetForm::schlick:
        return whole(T(schlick_g1(T(w.cos_i), alpha) * schlick_g1(T(w.cos_o), alpha)));
      case FacetForm::walter_g:
        return whole(T(walter_g1(T(w.tan2_i), alpha) * walter_g1(T(w.tan2_o), alpha)));
      case FacetForm::erfcx:
      case FacetForm::erfc:
      case FacetForm::tabulated:
        return from_lambda(lambda(T(w.tan2_i)), lambda(T(w.tan2_o)), w);
      default:
        return shadowing_masking<T>(shadowing, w, alpha);
    }
  }
  T lambda(const T& tan2) const {
    if (form == FacetForm::tabulated) return T(1) / smith_g1_tabulated(tan2, alpha) - T(1);
    return form == FacetForm::erfc ? smith_lambda_as_printed(tan2, alpha) : smith_lambda(tan2, alpha);
  }
  template <class G>
  Ratio<T> from_lambda(const T& i, const T& o, const Directions<G>& w) const {
    if (shadowing == Shadowing::smith_correlated) return {T(1), T(1) + i + o};
    if (shadowing == Shadowing::smith_separable) return {T(1), (T(1) + i) * (T(1) + o)};
    return shadowing_masking<T>(shadowing, w, alpha);
  }
};

}  // namespace gonio
