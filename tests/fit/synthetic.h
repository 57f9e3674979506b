#pragma once
#include <cmath>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "fit/fit.h"
#include "fit/prepare.h"

namespace gonio::test {

/// A scan in the plane of incidence without values: 0° to 60° by 15°, from -80° to 80° by `step_deg`.
inline Measurement empty_scan(double step_deg = 5) {
  Measurement scan;
  scan.id = "synthetic";
  scan.wavelength_nm = 550;
  for (const double theta_i_deg : {0.0, 15.0, 30.0, 45.0, 60.0}) {
    scan.incidences_deg.push_back(theta_i_deg);
    for (double angle = -80; angle <= 80; angle += step_deg) {
      ScanPoint point;
      point.theta_i_deg = theta_i_deg, point.theta_o_deg = std::abs(angle);
      point.phi_o_deg = angle < 0 ? 0 : 180;
      point.wavelength_nm = 550;
      point.f_per_sr = 1;
      point.incidence = scan.incidences_deg.size() - 1;
      scan.points.push_back(point);
    }
  }
  return scan;
}

/// The same scan with the values of a model, times exp(noise·N(0, 1)) where noise is given.
inline Measurement synthetic(Measurement scan, const ModelSpec& spec, std::span<const double> values,
                             const Interface<double>& surface, double noise = 0, std::uint64_t seed = 1) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const Brdf<double> brdf = make_brdf<double>(spec, values);
  for (ScanPoint& p : scan.points)
    p.f_per_sr = evaluate(brdf, directions_from_deg(p.theta_i_deg, p.theta_o_deg, p.phi_deg()), surface,
                          p.wavelength_nm * 1e-3) *
                 (noise > 0 ? std::exp(noise * normal(random)) : 1.0);
  return scan;
}

inline ModelSpec spec_of(std::string_view name) {
  ModelSpec spec;
  spec.id = model(name).id;
  return spec;
}

/// Whether any warning has the words.
inline bool warns(const FitResult& result, std::string_view words) {
  for (const std::string& warning : result.warnings)
    if (warning.find(words) != warning.npos) return true;
  return false;
}

}  // namespace gonio::test
