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

/// Directional(-hemispherical) reflectance of the lobe alone (ks = 1, kd = 0), E(θ) = ∫ R·shape·cos_o dω_o, for light from
/// theta_i_deg (0 to 89.99; reciprocal models: also the albedo seen from there), one value a wavelength. Coherent deltas are
/// not in it. Adaptive quadrature to `tolerance` (absolute); what it could not reach is in error and converged.
/// Faceted lobes: over the half vector's slopes, split at the kinks of the V-cavity and at the horizon.
/// beckmann-kirchhoff: over direction cosines around the mirror direction.
std::vector<Estimate> directional_reflectance(const Lobe<double>& lobe, double theta_i_deg, const SpectralSurface& surface,
                                              double tolerance = 1e-7);

/// The two methods by name; each works for every lobe, and they judge each other.
std::vector<Estimate> reflectance_over_slopes(const Lobe<double>& lobe, double theta_i_deg, const SpectralSurface& surface,
                                              double tolerance);
std::vector<Estimate> reflectance_over_direction_cosines(const Lobe<double>& lobe, double theta_i_deg,
                                                         const SpectralSurface& surface, double tolerance);

}  // namespace gonio
