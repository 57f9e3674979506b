#pragma once
#include "brdf/direction_samplers.h"
#include "brdf/directions.h"
#include "brdf/poisson_variants.h"
#include "surface/normals.h"

namespace gonio {

/// Which form of the series: the whole of it, one of its limits, the whole with another factor F (below); or the sum by another
/// method (brdf/poisson_variants.h): outwards from the largest term in every number type, 10 or 40 terms, a Gauss rule.
enum class KirchhoffForm {
  series,
  rough_limit,
  smooth_limit,
  nieto_vesperinas_1982,
  outwards,
  ten_terms,
  forty_terms,
  gauss_12
};

/// Beckmann-Kirchhoff diffraction by a Gaussian rough surface with autocorrelation exp(-τ²/T²).
/// Beckmann & Spizzichino 1963, ch. 5; Maillot 1996 eq. (18a), §I.2.3.2. With u, w the components of i + o in and across the
/// mean plane, v_xy = 2π·u/λ, g = (2πσ·w/λ)², F' = (u² + w²)/(2w) = cos_d/cos_h:
///   f = R(cos_d)·π·T²·F'²/(λ²·cos_i·cos_o) · Σ_{j>=1} Pois(j; g)/j · exp(-v_xy²T²/(4j)),
/// plus the coherent part, energy R·exp(-g) in the mirror direction (a delta, or the sinc² of a patch, eq. (18a)'s first term).
/// shape() is the incoherent lobe without R. Symbols: sigma_um height rms, correlation_um T, wavelength_um λ, all in µm.
/// Limits: g → ∞: D/(4·cos_i·cos_o) with alpha = 2σ/T (rough_limit); g → 0: the first term of the series (smooth_limit).
/// Validity: T ≫ λ, 4π·r_c·cos θ ≫ λ, patch ≫ λ² and T², no shadowing. Reciprocal; not conserving away from the normal and
/// unbounded at grazing (no shadowing).
///
/// nieto_vesperinas_1982: the F with which Mendez & O'Donnell 1987 compare (Maillot 1996 §I.2.5.2), cos_o for cos_i in its
/// denominator, F = (1 + cos_i·cos_o - sin_i·sin_o·cos δ)/(cos_o·(cos_i + cos_o)). (20a) has cos²_i·F² and f = (power per
/// steradian and area)/(E·cos_o), so with the rest kept f is (cos_i/cos_o)² times the thesis's: equal in the mirror direction
/// (and so is the coherent part), not reciprocal (f(i→o)/f(o→i) = (cos_i/cos_o)⁴), cos_o^-3 next to the horizon:
/// E is infinite, and refused.
/// Where F divides the amplitude of a plane wave (Nieto-Vesperinas, Opt. Acta 29, 961), whose radiant intensity has cos²_o in
/// place of (20a)'s cos²_i, the two cancel and f is `series` to the letter.
template <class T>
struct BeckmannKirchhoff {
  static constexpr bool kFacets = true, kDiffracts = true;
  T sigma_um, correlation_um;
  KirchhoffForm form = KirchhoffForm::series;

  /// Phase variance g = (2πσ(cos_i + cos_o)/λ)²; kept above 1e-30 so that the smooth limit stays finite.
  template <class G>
  T phase_variance(const Directions<G>& w, const T& wavelength_um) const {
    return larger_of(square(T(2) * kPi<T> * sigma_um * (T(w.cos_i) + T(w.cos_o)) / wavelength_um), T(1e-30));
  }

  KirchhoffSampler<T> sampler(const T& wavelength_um) const { return {sigma_um, correlation_um, wavelength_um}; }

  /// Whether shape() is the value of series().
  bool is_series() const { return form == KirchhoffForm::series || form == KirchhoffForm::nieto_vesperinas_1982; }
  template <class G>
  DiffractionSeries<T> series(const Directions<G>& w, const T& wavelength_um) const {
    const T cos_sum = T(w.cos_i) + T(w.cos_o), tan2_h(w.tan2_h), cosines = T(w.cos_i) * T(w.cos_o);
    const T f_prime = T(0.5) * cos_sum * (T(1) + tan2_h);
    const T b = square(kPi<T> * correlation_um * cos_sum / wavelength_um) * tan2_h;  // v_xy²T²/4
    T scale = kPi<T> * square(correlation_um / wavelength_um) * square(f_prime) / cosines;
    if (form == KirchhoffForm::nieto_vesperinas_1982) scale = scale * square(T(T(w.cos_i) / T(w.cos_o)));
    return {phase_variance(w, wavelength_um), b, scale};
  }

  template <class G>
  T shape(const Directions<G>& w, const T& wavelength_um) const {
    if (form == KirchhoffForm::rough_limit)
      return beckmann_d(T(w.tan2_h), T(T(2) * sigma_um / correlation_um),
                        T(T(1) / (T(4) * T(w.cos_i) * T(w.cos_o))));
    const DiffractionSeries<T> whole = series(w, wavelength_um);
    const auto& [g, b, scale] = whole;
    switch (form) {
      case KirchhoffForm::smooth_limit:
        return scaled_exp(T(scale * g), T(g + b));
      case KirchhoffForm::outwards:
        return poisson_lobe_sum(g, b, scale);
      case KirchhoffForm::ten_terms:
        return poisson_lobe_fixed_terms(g, b, scale, 10);
      case KirchhoffForm::forty_terms:
        return poisson_lobe_fixed_terms(g, b, scale, 40);
      case KirchhoffForm::gauss_12:
        return poisson_lobe_gauss<12>(g, b, scale);
      default:
        return value_of_series(whole);
    }
  }

  /// Whether the coherent part belongs to the form: the limits are of the incoherent lobe alone.
  bool has_coherent_part() const { return form != KirchhoffForm::rough_limit && form != KirchhoffForm::smooth_limit; }

  /// Share of the mirror's energy that stays coherent, exp(-g) at o = mirror of i (multiply by R(cos_i)).
  template <class C>
  T coherent_share(const C& cos_i, const T& wavelength_um) const {
    using std::exp;
    return exp(-square(T(4) * kPi<T> * sigma_um * T(cos_i) / wavelength_um));
  }

  /// Coherent part of a patch 2X × 2Y (X along the plane of incidence) as a BRDF without R:
  ///   exp(-g)·A·F'²/(λ²·cos_i·cos_o)·sinc²(v_x X)·sinc²(v_y Y), A = 4XY; h_x, h_y components of i + o, in and across
  /// the plane of incidence.
  template <class G>
  T coherent_patch(const Directions<G>& w, const T& h_x, const T& h_y, const T& patch_x_um, const T& patch_y_um,
                   const T& wavelength_um) const {
    using std::exp, std::sin;
    const auto sinc = [](const T& x) { return x == T(0) ? T(1) : T(sin(x) / x); };
    const T wave = T(2) * kPi<T> / wavelength_um, cos_sum = T(w.cos_i) + T(w.cos_o);
    const T f_prime = T(0.5) * cos_sum * (T(1) + T(w.tan2_h));
    return exp(-phase_variance(w, wavelength_um)) * T(4) * patch_x_um * patch_y_um * square(f_prime / wavelength_um) *
           square(sinc(wave * h_x * patch_x_um)) * square(sinc(wave * h_y * patch_y_um)) / (T(w.cos_i) * T(w.cos_o));
  }
};

}  // namespace gonio
