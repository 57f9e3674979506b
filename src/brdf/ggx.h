#pragma once
#include "brdf/direction_samplers.h"
#include "brdf/directions.h"
#include "surface/shadowing.h"

namespace gonio {

/// GGX (Trowbridge & Reitz 1975; Walter et al. 2007, doi:10.2312/EGWR/EGSR07/195-206), anisotropic as in Heitz 2014 (JCGT 3(2)):
///   f = D·G·F/(4·cos_i·cos_o),  D = (1 + tan²_x/alpha_x² + tan²_y/alpha_y²)⁻²/(π·alpha_x·alpha_y·cos⁴_h),
///   Λ = ½(√(1 + α²tan²θ) - 1), α²tan²θ = (alpha_x²·x² + alpha_y²·y²)/z².
/// Symbols: alpha_x, alpha_y > 0 (dimensionless), x along the grain. shape() is the lobe without F. G by name: Smith
/// separable 1/((1+Λ_i)(1+Λ_o)), correlated 1/(1+Λ_i+Λ_o), V-cavity, none; `smith-1967` has no GGX form and is not offered.
/// Reciprocal; E <= 1 with each G but `none`; finite up to grazing.
template <class T>
struct Ggx {
  static constexpr bool kFacets = true, kDiffracts = false;
  T alpha_x, alpha_y;
  Shadowing shadowing = Shadowing::smith_correlated;

  /// α²tan²θ of a direction.
  T stretched(const T& x, const T& y, const T& z) const {
    return (square(alpha_x * x) + square(alpha_y * y)) / square(z);
  }

  /// ½(√(1+s) - 1) without cancellation at the normal.
  static T lambda(const T& s) {
    using std::sqrt;
    return T(0.5) * s / (T(1) + sqrt(T(1) + s));
  }

  FacetSampler<T> sampler() const { return facets_seen(alpha_x, alpha_y, SlopeKind::ggx, shadowing); }

  template <class G>
  Ratio<T> shape_fraction(const Directions<G>& w) const {
    using std::sqrt;
    const T cos_i(w.cos_i), cos_o(w.cos_o), inverse_sum = T(1) / (cos_i + cos_o);
    const T slopes = square(T(w.hx) * inverse_sum / alpha_x) + square(T(w.hy) * inverse_sum / alpha_y);
    // Divided before the square: (1 + slopes)² alone leaves float's range at alpha = 1e-4.
    const Ratio<T> d{square(T((T(1) + T(w.tan2_h)) / ((T(1) + slopes) * sqrt(alpha_x * alpha_y)))), kPi<T>};
    return d * masking(w, cos_i, cos_o) * Ratio<T>{T(1), T(4) * cos_i * cos_o};
  }
  template <class G>
  T shape(const Directions<G>& w) const {
    return shape_fraction(w).value();
  }

 private:
  /// 1 + 2Λ = √(1 + α²tan²θ).
  template <class G>
  Ratio<T> masking(const Directions<G>& w, const T& cos_i, const T& cos_o) const {
    using std::sqrt;
    if (shadowing == Shadowing::none) return whole(T(1));
    if (shadowing == Shadowing::v_cavity) return v_cavity(cos_i, cos_o, T(w.cos2_d()));
    const T i = sqrt(T(1) + stretched(T(w.ix), T(w.iy), cos_i)), o = sqrt(T(1) + stretched(T(w.ox), T(w.oy), cos_o));
    if (shadowing == Shadowing::smith_separable) return {T(4), (T(1) + i) * (T(1) + o)};
    return {T(2), i + o};
  }
};

}  // namespace gonio
