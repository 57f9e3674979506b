#pragma once
#include "brdf/beckmann_kirchhoff.h"
#include "surface/shadowing.h"

namespace gonio {

/// Rival readings of He et al. 1991: ours; Λ as printed, without its exponential; the raw σ0 in the phase as well.
enum class HeReading { corrected, lambda_without_exponential, sigma0_in_phase };

/// He, Torrance, Sillion & Greenberg 1991 (SIGGRAPH, doi:10.1145/122718.122738), directional-diffuse part:
///   f = R(cos_d)·S(i)·S(o)·[lobe of beckmann-kirchhoff with the effective σ],
///   σ = σ0/√(1 + z0²/σ0²),  z0²/σ0² = W(b²),  b = (K_i + K_o)/(4√(π/2)),  K = tan θ·erfc(T·cot θ/(2σ0)),
///   S(θ) = (1 - ½·erfc(a))/(1 + Λ),  a = T·cot θ/(2σ0)  (smith_1967 with alpha = 2σ0/T).
/// Coherent: energy R·S²·exp(-g) in the mirror direction; uniform-diffuse: kd. Unpolarised light: the paper's cross products
/// (s_r·k_i)² + (p_r·k_i)² are |k_r×k_i|² for every pair of unit vectors, so its G = (v·v/v_z)² is 4F'² exactly: nothing to
/// divide by at the normal or in retro-reflection.
/// Symbols: sigma0_um height rms, correlation_um T, λ in µm. z0 in closed form by Lambert's W: z0·exp(z0²/(2σ0²)) = b·σ0.
/// Misprints set right: S lacks its ½, Λ its exponential. shape() is without R. Reciprocal; bounded at grazing by S; not
/// strictly conserving.
template <class T>
struct HeTorrance {
  static constexpr bool kFacets = true, kDiffracts = true;
  T sigma0_um, correlation_um;
  HeReading reading = HeReading::corrected;

  T alpha() const { return T(2) * sigma0_um / correlation_um; }

  /// σ of the part of the surface that both directions see.
  T effective_sigma(const T& tan2_i, const T& tan2_o) const {
    using std::sqrt;
    const T b = (hidden_slope(tan2_i) + hidden_slope(tan2_o)) / (T(2) * kSqrt2Pi<T>);
    return sigma0_um / sqrt(T(1) + lambert_w0(T(square(b))));
  }

  /// Share of the surface that a direction sees.
  T shadowing(const T& tan2) const {
    const T s = slope_ratio(tan2), hidden = erfc_of_inverse(s);
    const T lambda =
        reading == HeReading::lambda_without_exponential ? T(0.5) * (s / kSqrtPi<T> - hidden) : smith_lambda_core(s);
    return (T(1) - T(0.5) * hidden) / (T(1) + lambda);
  }

  KirchhoffSampler<T> sampler(const T& wavelength_um) const { return {sigma0_um, correlation_um, wavelength_um}; }

  bool is_series() const { return true; }
  template <class G>
  DiffractionSeries<T> series(const Directions<G>& w, const T& wavelength_um) const {
    const T tan2_i(w.tan2_i), tan2_o(w.tan2_o);
    const T sigma = reading == HeReading::sigma0_in_phase ? sigma0_um : effective_sigma(tan2_i, tan2_o);
    const auto [g, b, scale] = BeckmannKirchhoff<T>{sigma, correlation_um}.series(w, wavelength_um);
    return {g, b, scale * shadowing(tan2_i) * shadowing(tan2_o)};
  }
  template <class G>
  T shape(const Directions<G>& w, const T& wavelength_um) const {
    return value_of_series(series(w, wavelength_um));
  }

  template <class C>
  T coherent_share(const C& cos_i, const T& wavelength_um) const {
    const T c(cos_i), tan2 = (T(1) - c) * (T(1) + c) / square(c);
    const T sigma = reading == HeReading::sigma0_in_phase ? sigma0_um : effective_sigma(tan2, tan2);
    return square(shadowing(tan2)) * BeckmannKirchhoff<T>{sigma, correlation_um}.coherent_share(c, wavelength_um);
  }

 private:
  /// alpha·tan θ = 1/a; at the normal sqrt(0) has no derivative, and 1e-30 gives the same in every number type.
  T slope_ratio(const T& tan2) const {
    using std::sqrt;
    return alpha() * sqrt(larger_of(tan2, T(1e-30)));
  }
  T hidden_slope(const T& tan2) const {
    using std::sqrt;
    return sqrt(larger_of(tan2, T(1e-30))) * erfc_of_inverse(slope_ratio(tan2));
  }
};

}  // namespace gonio
