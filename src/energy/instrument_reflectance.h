#pragma once
#include <optional>
#include <span>

#include "energy/cone_reflectance.h"

namespace gonio {

/// Where light comes from or where it is collected: the cone less the stop; half angle 0: the one direction.
struct Opening {
  Cone cone;
  std::optional<Cone> stop = std::nullopt;

  bool is_direction() const { return cone.half_angle_deg == 0; }
  bool is_hemisphere() const { return cone.half_angle_deg == 90 && cone.theta_deg == 0 && !stop; }
};

/// One of the nine of Nicodemus et al. 1977 (NBS Monograph 160), or such openings with holes. phi of the source
/// from the grain, of the collector from the source's axis (180 = mirror side); so do the stops'.
struct InstrumentGeometry {
  Opening source, collector;
};

struct InstrumentReflectance {
  /// ρ = (1/Ω_i)·∫_source ∫_collector f·cos_o dω_o cos_i dω_i, the share of the light that is collected; none for a
  /// directional collector, which collects nothing.
  std::optional<Estimate> reflectance;
  /// R = π·ρ/Ω_r, over what a perfect diffuser gives in the same geometry; π·(mean of f) for a directional collector.
  Estimate factor;
  double coherent_factor = 0;              ///< what deltas add to R
  double source_sr = 0, collector_sr = 0;  ///< projected solid angles Ω_i, Ω_r; 0 for a direction
};

/// What an instrument reports of lobes that add up (kd of the first), under a source of uniform radiance.
///
/// One side a direction: as cone_reflectance, over i as over o (no reciprocity is used). Two cones: rings about the axis
/// of the smaller, cut where the mirror image of the larger one's edge lies, of integrals over the larger; over the whole
/// hemisphere directional_reflectance, so that bihemispherical reflectance of an isotropic lobe is 2·∫E·sin θ·cos θ dθ.
/// To relative_tolerance of the value or 1e-12 of the perfect diffuser's; what it could not reach is in error and
/// converged. Deltas count with R·cos_i over the directions of the source whose mirror direction is collected.
///
/// InputError: an opening with nothing above the horizon, a direction beyond 89.99 degrees, a delta between two
/// directions, an infinite integral (f grows as cos_o^-3) up to the horizon.
/// Pinned by tests/energy/instrument_reflectance_test.cpp: closed forms of Lambert and mirrors, plain Monte Carlo.
InstrumentReflectance instrument_reflectance(std::span<const Brdf<double>> lobes, const InstrumentGeometry& geometry,
                                             const Interface<double>& surface, double wavelength_um,
                                             double relative_tolerance = 1e-6);

}  // namespace gonio
