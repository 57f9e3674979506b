#pragma once
#include "base/scaled_exp.h"
#include "brdf/direction_samplers.h"
#include "brdf/directions.h"
#include "optics/fresnel.h"

namespace gonio {

/// Which reflectance the facets have, in the order of the model's variants.
enum class AshikhminShirleyForm { schlick, fresnel };

/// log1p(t)/t, 1 at t = 0.
template <class T>
T log1p_over(const T& t) {
  using std::log1p;
  const auto small = t < T(1e-18);
  const T safe = select(small, T(1), t);
  return select(small, T(1), T(log1p(safe) / safe));
}

/// Ashikhmin & Shirley 2000 (J. Graphics Tools 5(2), 25, doi:10.1080/10867651.2000.10487522), specular and coupled diffuse:
///   f_s = √((n_u+1)(n_v+1))/(8π)·cos_h^((n_u·h_x² + n_v·h_y²)/(h_x² + h_y²))·F(cos_d)/(cos_d·max(cos_i, cos_o)),
///   f_d = 28·rd/(23π)·(1 - f0)·(1 - (1 - cos_i/2)⁵)·(1 - (1 - cos_o/2)⁵).
/// Symbols: n_u, n_v exponents along x and y (isotropic where equal), f0 reflectance at normal incidence, rd that of the
/// diffuse layer below (0: the specular term alone, as Ngan et al. 2005 and Low et al. 2012 fit it).
///   schlick   F = f0 + (1 - f0)(1 - cos_d)⁵, as published;
///   fresnel   F of the dielectric n = (1+√f0)/(1-√f0): the "eta" of Low et al. is that n.
/// Reciprocal; the specular E <= max F since f_s·cos_o/(4·cos_d) <= a density of h; f grows without bound only as both
/// directions graze. The exponent is taken as -½(n_u·h_x² + n_v·h_y²)/h_z²·log1p(t)/t, t = tan²θ_h: no 0/0 at h = normal.
template <class T>
struct AshikhminShirley {
  static constexpr bool kFacets = false, kDiffracts = false;
  T n_u, n_v, f0, rd;
  AshikhminShirleyForm form = AshikhminShirleyForm::schlick;

  template <class G>
  T facet(const Directions<G>& w, const T& cos_d) const {
    using std::sqrt;
    if (form == AshikhminShirleyForm::schlick) return f0 + (T(1) - f0) * fifth_power(T(one_minus_cos_d(w)));
    // Fresnel's law in n - 1 = 2√f0/(1-√f0) = 2√f0·(1+√f0)/(1-f0), so that f0 → 0 loses nothing: g² = n² - 1 + c², g - c = (n²-1)/(g+c).
    const T root = sqrt(f0), m = T(2) * root * (T(1) + root) / (T(1) - f0), contrast = m * (m + T(2));
    const T sum = sqrt(contrast + square(cos_d)) + cos_d, r_s = contrast / square(sum);
    return T(0.5) * square(r_s) * (T(1) + square(T((cos_d * sum - T(1)) / (cos_d * contrast / sum + T(1)))));
  }

  AshikhminShirleySampler<T> sampler() const {
    const T diffuse = rd * (T(1) - f0), specular = f0 + T(0.05) * (T(1) - f0);
    return {n_u, n_v, smaller_of(T(diffuse / (diffuse + specular)), T(0.9))};
  }

  template <class G>
  T shape(const Directions<G>& w) const {
    using std::sqrt;
    const T h_z2 = T(square(w.cos_i + w.cos_o)), cos_i = T(w.cos_i), cos_o = T(w.cos_o), cos_d = T(w.cos_d);
    const T exponent = T(0.5) * (n_u * T(square(w.hx)) + n_v * T(square(w.hy))) / h_z2 * T(log1p_over(w.tan2_h));
    const T scale = sqrt((n_u + T(1)) * (n_v + T(1))) / (T(8) * kPi<T>);
    const T specular = scaled_exp(T(scale * facet(w, cos_d) / (cos_d * larger_of(cos_i, cos_o))), exponent);
    return specular + T(28) / (T(23) * kPi<T>)*rd * (T(1) - f0) * below(cos_i) * below(cos_o);
  }

  /// 1 - (1 - c/2)⁵ without loss at c = 0.
  static T below(const T& c) {
    const T x = T(0.5) * c, y = T(1) - x;
    return x * (T(1) + y * (T(1) + y * (T(1) + y * (T(1) + y))));
  }
};

}  // namespace gonio
