#pragma once
#include <vector>

#include "energy/directional_reflectance.h"

namespace gonio {

/// The surface over a range of wavelengths, as the limits need it.
struct SurfaceSamples {
  std::vector<double> wavelength_nm;  ///< increasing; one 0 where no wavelength matters
  SpectralSurface surface;            ///< in step with wavelength_nm
};

/// E at one incidence: the worst wavelength's, with the coherent delta's energy added in `total`. E of one lobe is that
/// of ks = 1; of a sum, that of its lobes each with its own ks.
struct LimitRow {
  double theta_deg = 0, wavelength_nm = 0;
  Estimate e;           ///< incoherent
  double coherent = 0;  ///< energy of the delta
  double total = 0;     ///< kd·ρd + ks·(E + coherent) of the material as given
  double phi_deg = 0;   ///< the light's azimuth from the grain, the worst one, where the lobe looks at it
};

/// Energy conservation, Maillot 1996 eq. (43): kd·ρd + ks·E <= 1 for every incidence and wavelength.
struct Limits {
  double ks_max = 0;  ///< 1/max E (kd = 0), lowered by the quadrature's error bound; of a sum, of all its ks together
  double kd_max = 0;  ///< min (1 - ks·E)/ρd at the material's own ks; 0 when the lobe alone breaks (43)
  double worst_total = 0, worst_theta_deg = 0, worst_wavelength_nm = 0;  ///< of the material as given
  double worst_error = 0;                                                ///< largest error bound of any E
  double coherent_energy = 0;  ///< at normal incidence, as in LimitRow, largest over wavelengths
  double theta_max_deg =
      90;               ///< limits hold up to here; below 90 the lobe is unbounded at grazing: "not conserving beyond"
  bool bounded = true;  ///< the lobe's E is bounded up to grazing
  double range_lo_nm = 0, range_hi_nm = 0;
  double diffuse_least = 0;  ///< min over wavelengths of kd·ρd
  double lobes_most = 0;     ///< max over wavelengths and incidences of ks·(E + coherent)
  std::vector<LimitRow> rows;

  /// Which part dominates under uniform light: "diffuse" where kd·min ρd > ks·max E, else "specular" (Maillot 1996, §III.8).
  const char* behaviour() const { return diffuse_least > lobes_most ? "diffuse" : "specular"; }
  /// (43) holds for the material as given.
  bool holds() const { return bounded && worst_total <= 1 + worst_error; }
};

/// Angles at which the limits look for the maximum: 5° apart, closer towards grazing, to 89.99°.
std::vector<double> limit_angles_deg();

/// The lobes of a material: one list for all wavelengths, or one for each of the samples', which differ in kd and ks.
using SampledLobes = std::vector<std::vector<Brdf<double>>>;

/// Limits of a material. Unbounded lobes are examined to theta_max_deg only. The maximum over θ is searched on `angles_deg`
/// and refined between its neighbours.
Limits conservation_limits(const SampledLobes& lobes, const SurfaceSamples& samples, std::vector<double> angles_deg,
                           double theta_max_deg_if_unbounded = 75, double tolerance = 1e-7);
inline Limits conservation_limits(const Brdf<double>& brdf, const SurfaceSamples& samples,
                                  std::vector<double> angles_deg) {
  return conservation_limits(SampledLobes{{brdf}}, samples, std::move(angles_deg));
}

}  // namespace gonio
