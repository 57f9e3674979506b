#pragma once
// Scans whose truth is known: where a goniophotometer would look, and what a model shows there.
#include <cstdint>
#include <span>
#include <vector>

#include "brdf/models.h"
#include "fit/scan.h"

namespace gonio {

/// Where a scan looks, in the plane of incidence and, if wanted, across it (phi = 90°); degrees.
struct ScanPlan {
  std::vector<double> incidences_deg{0, 15, 30, 45, 60};
  double largest_theta_o_deg = 80;
  double step_deg = 5;
  double offset_deg = 0;  ///< of the first angle, so that the mirror directions need not be on the grid
  bool across = false;    ///< anisotropic lobes show both their widths only so
};
/// The points of a plan at 550 nm, all of value 1.
Measurement planned_scan(const ScanPlan& plan);

/// `directions` pairs that fill the hemisphere evenly (five incidences up to 60°, theta_o to 80°, all azimuths), at each wavelength.
Measurement hemisphere_scan(std::size_t directions, std::span<const double> wavelengths_nm);

/// The values of a model on a material of the database (or `perfect`), times exp(noise·N(0, 1)).
Measurement filled(Measurement scan, const ModelSpec& spec, std::span<const double> values, const std::string& material,
                   double noise, std::uint64_t seed);

}  // namespace gonio
