#pragma once
#include <span>
#include <vector>

#include "brdf/brdf.h"

namespace gonio {

/// A number with a bound on its error (absolute).
struct Estimate {
  double value = 0, error = 0;
  bool converged = true;
};

/// The surface at some wavelengths: one interface and one wavelength each, in step.
struct SpectralSurface {
  std::vector<Interface<double>> interfaces;
  std::vector<double> wavelength_um;

  std::size_t size() const { return interfaces.size(); }
};

/// Directional(-hemispherical) reflectance of the lobe alone (ks = 1, kd = 0), E(θ, φ) = ∫ R·shape·cos_o dω_o, for light from
/// theta_i_deg (0 to 89.99; reciprocal models: also the albedo seen from there) at phi_i_deg from the grain, one value a wavelength.
/// Coherent deltas are not in it. Adaptive quadrature to `tolerance` (absolute); what it could not reach is in error and converged.
/// Lobes about the half vector: over its slopes, split at the kinks of the V-cavity and at the horizon.
/// beckmann-kirchhoff and he: over direction cosines around the mirror direction. lafortune: about its axis, the turn in closed form.
std::vector<Estimate> directional_reflectance(const Lobe<double>& lobe, double theta_i_deg,
                                              const SpectralSurface& surface, double tolerance = 1e-7,
                                              double phi_i_deg = 0);

/// InputError for a lobe whose E is infinite (f grows as cos_o^-3 next to the horizon).
void refuse_infinite(const Lobe<double>& lobe);

/// Whether E depends on phi_i_deg (it is the same at -phi and 180° - phi).
bool looks_at_the_grain(const Lobe<double>& lobe);

/// The methods by name; the first works for every lobe, the second for isotropic ones, and they judge each other.
std::vector<Estimate> reflectance_over_slopes(const Lobe<double>& lobe, double theta_i_deg,
                                              const SpectralSurface& surface, double tolerance, double phi_i_deg = 0);
std::vector<Estimate> reflectance_over_direction_cosines(const Lobe<double>& lobe, double theta_i_deg,
                                                         const SpectralSurface& surface, double tolerance);
std::vector<Estimate> reflectance_about_axis(const Lafortune<double>& lobe, double theta_i_deg,
                                             const SpectralSurface& surface, double tolerance, double phi_i_deg = 0);

}  // namespace gonio
