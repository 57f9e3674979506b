#pragma once
// From watts to lumens: spectral quantities (radiance, irradiance, flux … per nm) weighted by an eye. Sums run at whole
// nanometres, linear between points, as those of colorimetry.h.
#include "spectrum/colorimetry.h"

namespace gonio {

/// K_m, lm/W at the maximum of V(λ) (CIE 015:2018), and K'_m at that of V'(λ).
inline constexpr double kPhotopicEfficacy = 683.002;
inline constexpr double kScotopicEfficacy = 1700;

/// Σ of a spectral quantity over [lo_nm, hi_nm] cut to its table, per nm in, whole out (W/m² from W/(m²·nm), say).
double radiant(const Spectrum& per_nm, double lo_nm = 0, double hi_nm = 1e9);

/// The photometric quantity of a radiometric one: efficacy·Σ X(λ)·V(λ): lm of W, lx of W/m², cd/m² of W/(m²·sr) (each
/// per nm in). Over the wavelengths common to both; InputError when there are none.
double luminous(const Spectrum& per_nm, const Spectrum& efficiency, double efficacy);
double photopic(const Spectrum& per_nm, const Spectrum& v);
double scotopic(const Spectrum& per_nm, const Spectrum& v_prime);

/// The other way, for light of a known shape: the factor that makes `shape` carry the photometric quantity `wanted`.
double radiometric_scale(const Spectrum& shape, const Spectrum& efficiency, double efficacy, double wanted);

/// XYZ in photometric units: K_m·Σ X(λ)·x̄(λ) …; Y is then the photopic quantity of the observer's ȳ (color_of gives the
/// other normalisation, Y = 100 for the perfect diffuser).
Xyz<double> absolute_xyz(const Spectrum& per_nm, const Observer& observer);

/// Lumens a watt of this light carries within its own table, by day and by night.
struct LuminousEfficacy {
  double photopic_lm_per_w, scotopic_lm_per_w;
};
LuminousEfficacy luminous_efficacy(const Spectrum& light, const Spectrum& v, const Spectrum& v_prime);

}  // namespace gonio
