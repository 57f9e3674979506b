#pragma once
#include <optional>
#include <span>

#include "energy/directional_reflectance.h"

namespace gonio {

/// Directions within half_angle_deg (0 to 90) of an axis; phi = phi_o - phi_i (180 = mirror side). What lies below the
/// horizon is not in it.
struct Cone {
  double theta_deg = 0, phi_deg = 0, half_angle_deg = 90;
};

/// Every direction of reflection.
inline constexpr Cone kHemisphere{0, 0, 90};

struct ConeReflectance {
  Estimate total;       ///< share of the light that reaches the cone, coherent part included
  double coherent = 0;  ///< the delta's share of it: there when the mirror direction lies in the cone
};

/// What a collector sees of lobes that add up (kd of the first), ∫_cone f·cos_o dω_o for light from theta_i_deg (0 to
/// below 90) at phi_i_deg from the grain; `stop`: a cone whose directions are left out (a hole for the specular beam).
/// Total integrated scatter: the hemisphere less a stop about the mirror direction, over the hemisphere (ISO 13696
/// divides by the light instead: this number).
///
/// Nested adaptive quadrature in rings about the direction where a lobe is highest (mirror, retro, lafortune's axis;
/// for the diffuse part the cone's axis), cut where a ring meets the cone, the stop and the horizon: the edges are
/// exact, and a lobe much narrower than the cone is found. Until the error is below relative_tolerance of the value;
/// what it could not reach is in error and converged.
ConeReflectance cone_reflectance(std::span<const Brdf<double>> lobes, double theta_i_deg,
                                 const Interface<double>& surface, double wavelength_um, const Cone& cone,
                                 const std::optional<Cone>& stop = std::nullopt, double relative_tolerance = 1e-6,
                                 double phi_i_deg = 0);

}  // namespace gonio
