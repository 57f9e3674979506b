#pragma once
#include "brdf/poisson_series.h"

namespace gonio {

/// The factor F of scattering by a profile: Beckmann's, or Marx & Vorburger's with + sin·sin as printed.
enum class ProfileFactor { beckmann, marx_vorburger_1990 };

/// Σ_{j>=1} Pois(j; g)/√j · exp(-b/j), the series of a surface that is rough along one direction only: term by term
/// from the largest outwards (the two-dimensional one, poisson_lobe_sum, divides by j).
template <class T>
T poisson_profile_sum(const T& g, const T& b) {
  using std::floor, std::sqrt;
  const auto g0 = value_of(g), b0 = value_of(b);
  using V = std::remove_cvref_t<decltype(g0)>;
  const V cut(SeriesPrecision<scalar_t<T>>::cut);
  const V middle = larger_of(V(floor(V(g0 + poisson_lobe_peak_offset(g0, b0) + V(0.5)))), V(1));
  const auto term = [&](const V& j) {
    const T x(larger_of(j, V(1)));
    return T(sqrt(x) * poisson_lobe_term(x, T(x - g), g, b));
  };
  T sum = term(middle);
  for (const V step : {V(1), V(-1)})
    for (V j = middle + step;; j += step) {
      const auto inside = j > V(0.5);
      const T next = select(inside, term(j), T(0));
      sum += next;
      if (!any(inside && value_of(next) > cut * value_of(sum))) break;
    }
  return sum * T(0x1p-60);  // the terms are 2^60 times as large
}

/// Diffraction by a Gaussian surface that is rough along one direction x only, in the plane of incidence along x:
/// Beckmann & Spizzichino 1963, ch. 5; Marx & Vorburger, Appl. Opt. 29, 3613 (1990), as Maillot 1996 §I.2.5.2 reports
/// it. Scattered power per radian over the incident power, R = 1:
///   P(θ_o) = √π·T·F'²/(λ·cos_i) · Σ_{j>=1} Pois(j; g)/√j · exp(-v_x²T²/(4j)),  v_x = 2π(sin_i - sin_o)/λ,
/// g = (2πσ(cos_i + cos_o)/λ)². All light stays in that plane, so P is no BRDF: per radian, without solid angle.
///   beckmann             F' = (1 + cos_i·cos_o - sin_i·sin_o)/(cos_i + cos_o), cos_i times the thesis's F;
///   marx_vorburger_1990  + sin_i·sin_o, as printed. With θ_o counted positive on the mirror side it makes the mirror
///                        direction 1/cos²_i instead of 1 (8.4 in power at 54°); the thesis finds it "curious". It is
///                        Beckmann's where θ_o is counted negative on the mirror side, as the printed sign may mean.
/// Symbols: sigma_um height rms, correlation_um T, µm; θ_o in degrees, positive on the mirror side, past 90° the theory
/// goes on (it has no horizon) as long as cos_i + cos_o > 0. Limits: g → 0 at the normal, T ≫ λ: energy 1 - exp(-g); g
/// → ∞: one-dimensional Gaussian slopes of rms √2·σ/T seen by geometrical optics. Validity and flaws as
/// beckmann_kirchhoff.h. Pinned by tests/brdf/kirchhoff_variants_test.cpp.
template <class T>
struct KirchhoffProfile {
  T sigma_um, correlation_um;
  ProfileFactor factor = ProfileFactor::beckmann;

  T power_per_rad(const T& theta_i_deg, const T& theta_o_deg, const T& wavelength_um) const {
    using std::cos, std::sin;
    const T degree = kPi<T> / T(180), half_sum = T(0.5) * (theta_i_deg + theta_o_deg) * degree,
            half_difference = T(0.5) * (theta_i_deg - theta_o_deg) * degree;
    const T cos_sum = T(2) * cos(half_sum) * cos(half_difference);          // cos_i + cos_o
    const T sine_difference = T(2) * cos(half_sum) * sin(half_difference);  // sin_i - sin_o
    const T angle = factor == ProfileFactor::beckmann ? half_sum : half_difference;
    const T f_prime = T(2) * square(T(cos(angle))) / cos_sum;
    const T g = square(T(T(2) * kPi<T> * sigma_um * cos_sum / wavelength_um));
    const T b = square(T(kPi<T> * correlation_um * sine_difference / wavelength_um));
    return kSqrtPi<T> * correlation_um * square(f_prime) * poisson_profile_sum(g, b) /
           (wavelength_um * cos(theta_i_deg * degree));
  }
  /// Share of the mirror's energy that stays coherent.
  T coherent_share(const T& theta_i_deg, const T& wavelength_um) const {
    using std::cos, std::exp;
    return exp(-square(T(T(4) * kPi<T> * sigma_um * cos(theta_i_deg * kPi<T> / T(180)) / wavelength_um)));
  }
};

}  // namespace gonio
