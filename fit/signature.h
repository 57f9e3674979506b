#pragma once
#include <utility>
#include <vector>

#include "fit/scan.h"

namespace gonio {

/// What an instrument sees of its own beam (stray light, finite aperture, scatter of its optics): f_r·cos θ_o of a scan without a sample, or
/// of a good mirror, against the angle from the mirror direction (ASTM E2387, "instrument signature").
class Signature {
 public:
  /// Values at equal angles are averaged. InputError below two angles, or where none is positive.
  explicit Signature(const Measurement& scan);

  /// per sr; ln f·cos is linear between the angles measured, level before the first one and 0 beyond the last.
  double at(double from_mirror_deg) const;
  double last_deg() const { return points_.back().first; }

 private:
  std::vector<std::pair<double, double>> points_;  ///< degrees, per sr; rising
};

/// Angle between the direction of observation and the mirror direction.
double from_mirror_deg(const ScanPoint& point);

/// The scan less `scale` times the signature (the sample's specular reflectance over that of what the signature was taken of). Values of which the
/// signature is 90 % or more say nothing of the sample: they are left out and counted.
Measurement without_signature(const Measurement& scan, const Signature& signature, double scale);

}  // namespace gonio
