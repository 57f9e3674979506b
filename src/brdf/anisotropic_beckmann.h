#pragma once
#include "brdf/direction_samplers.h"
#include "brdf/directions.h"
#include "surface/normals.h"
#include "surface/shadowing.h"

namespace gonio {

/// Gaussian slopes of two widths (Beckmann & Spizzichino 1963; anisotropic as in Heitz 2014, JCGT 3(2)):
///   f = D·G·F/(4·cos_i·cos_o),  D = exp(-tan²_x/alpha_x² - tan²_y/alpha_y²)/(π·alpha_x·alpha_y·cos⁴_h),
/// Smith's Λ of each direction at its own α, α²tan²θ = (alpha_x²·x² + alpha_y²·y²)/z².
/// Symbols: alpha_x, alpha_y > 0 (√2 times the slope rms along and across the grain). With alpha_x = alpha_y it is
/// `torrance-sparrow`. Reciprocal; E <= 1 with each G but `none`; finite up to grazing.
template <class T>
struct AnisotropicBeckmann {
  static constexpr bool kFacets = true, kDiffracts = false;
  T alpha_x, alpha_y;
  Shadowing shadowing = Shadowing::smith_correlated;

  FacetSampler<T> sampler() const { return facets_seen(alpha_x, alpha_y, SlopeKind::gaussian, shadowing); }

  template <class G>
  Ratio<T> shape_fraction(const Directions<G>& w) const {
    const T cos_i(w.cos_i), cos_o(w.cos_o), cos_sum = cos_i + cos_o;
    const T slopes = square(T(w.hx) / (alpha_x * cos_sum)) + square(T(w.hy) / (alpha_y * cos_sum));
    const Ratio<T> d = gaussian_fraction(T(T(0.5) * slopes), w.tan2_h,
                                         T(T(4) * kPi<T> * alpha_x * alpha_y * cos_i * cos_o));
    // Smith's functions take α²·tan² only: the stretched tangents stand in for a surface of alpha = 1.
    Directions<T> stretched{
        cos_i, cos_o, T(w.cos_d), T(w.tan2_h), stretch(T(w.ix), T(w.iy), cos_i), stretch(T(w.ox), T(w.oy), cos_o)};
    return d * shadowing_masking<T>(shadowing, stretched, T(1));
  }
  template <class G>
  T shape(const Directions<G>& w) const {
    return shape_fraction(w).value();
  }

 private:
  T stretch(const T& x, const T& y, const T& z) const {
    return (square(alpha_x * x) + square(alpha_y * y)) / square(z);
  }
};

}  // namespace gonio
