#pragma once
#include "base/special.h"
#include "base/two_terms.h"
#include "brdf/direction_samplers.h"
#include "brdf/directions.h"

namespace gonio {

enum class OrenNayarForm { full, qualitative };

/// Oren & Nayar 1994 (SIGGRAPH, doi:10.1145/192161.192213): Lambertian V-cavities with Gaussian slope angles.
///   qualitative  f = ρ/π·(A + B·max(0, cos φ)·sin a·tan b),  A = 1 - σ²/(2(σ² + 0.33)), B = 0.45·σ²/(σ² + 0.09)
///   full         f = L1 + L2 with C1, C2, C3 of eqs. (41)-(43): below
/// a = max(θ_i, θ_o), b = min; φ = φ_o - φ_i. Symbols: sigma_rad standard deviation of the facet angle; ρ = 1 (ks scales).
/// With ρ = 1 the full form's interreflection L2 is that of white facets. Reciprocal; not exactly conserving (a fit to a
/// simulation). sin a·tan b·cos φ = (i_xy·o_xy)/max(cos_i, cos_o): no angle is taken for it. Next to grazing the full form multiplies
/// small differences by tan b: sin α - (2β/π)³ and 1 - |cos φ| = sin²φ/(1 + |cos φ|) are written without them.
template <class T>
struct OrenNayar {
  static constexpr bool kFacets = false, kDiffracts = false;
  T sigma_rad;
  OrenNayarForm form = OrenNayarForm::full;

  CosineSampler<T> sampler() const { return {}; }

  template <class G>
  T shape(const Directions<G>& w) const {
    const T cos_i(w.cos_i), cos_o(w.cos_o), s2 = square(sigma_rad);
    const T in_plane = T(w.ix) * T(w.ox) + T(w.iy) * T(w.oy);  // sin_i·sin_o·cos φ
    if (form == OrenNayarForm::qualitative) {
      const T a = T(1) - T(0.5) * s2 / (s2 + T(0.33)), b = T(0.45) * s2 / (s2 + T(0.09));
      return (a + b * larger_of(T(0), in_plane) / larger_of(cos_i, cos_o)) / kPi<T>;
    }
    return full(w, cos_i, cos_o, s2, in_plane);
  }

 private:
  /// θ from its sine and cosine, accurate at both ends.
  static T angle(const T& sine, const T& cosine) {
    using std::atan2;
    return atan2(sine, cosine);
  }

  template <class G>
  T full(const Directions<G>& w, const T& cos_i, const T& cos_o, const T& s2, const T& in_plane) const {
    const T sin_i = safe_sqrt(T(square(T(w.ix)) + square(T(w.iy)))),
            sin_o = safe_sqrt(T(square(T(w.ox)) + square(T(w.oy))));
    const T sin_a = larger_of(sin_i, sin_o), sin_b = smaller_of(sin_i, sin_o);
    const T cos_a = smaller_of(cos_i, cos_o), cos_b = larger_of(cos_i, cos_o), tan_b = sin_b / cos_b;
    const T alpha = angle(sin_a, cos_a), beta = angle(sin_b, cos_b);
    // At the normal the terms with cos φ carry tan β = 0, and its value does not matter.
    const T sines = larger_of(T(sin_i * sin_o), T(1e-30));
    const T cos_phi = larger_of(T(-1), smaller_of(T(1), T(in_plane / sines)));
    const T size_phi = larger_of(cos_phi, T(-cos_phi));
    const T across = sum_of_products(std::array<T, 2>{T(w.ix), T(-w.iy)}, std::array<T, 2>{T(w.oy), T(w.ox)}) / sines,
            aside = square(across) / (T(1) + size_phi);
    const T two_beta = T(2) * beta / kPi<T>, wide = s2 / (s2 + T(0.09));
    const T c1 = T(1) - T(0.5) * s2 / (s2 + T(0.33));
    // sin α - (2β/π)³ = (1 - (2β/π)³) - cos²α/(1 + sin α), with 1 - 2β/π from the other angle.
    const T left = T(2) * angle(cos_b, sin_b) / kPi<T>;
    const T steep = left * (T(1) + two_beta * (T(1) + two_beta)) - square(cos_a) / (T(1) + sin_a);
    const T c2 = T(0.45) * wide * select(in_plane >= T(0), sin_a, steep);
    const T c3 = T(0.125) * wide * square(T(4) * alpha * beta / square(kPi<T>));
    const T half_tangent = (sin_a + sin_b) / (cos_a + cos_b);  // tan((α+β)/2)
    const T once = c1 + cos_phi * c2 * tan_b + aside * c3 * half_tangent;
    const T twice = T(0.17) * s2 / (s2 + T(0.13)) * (T(1) - cos_phi * square(two_beta));
    return larger_of(T(0), T(once + twice)) / kPi<T>;
  }
};

}  // namespace gonio
