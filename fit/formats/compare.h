#pragma once
// Two measurements of one surface, point by point.
#include <cstddef>
#include <optional>

#include "fit/scan.h"

namespace gonio {

struct ScanComparison {
  std::size_t points_a = 0, points_b = 0;
  std::size_t matched = 0;            ///< points of A with a partner in B
  std::size_t compared = 0;           ///< those where both values are positive: the figures below are of them
  double mean_ratio = kNotStated;     ///< of A / B
  double rms_log10 = kNotStated;      ///< of log10(A / B)
  double largest_log10 = kNotStated;  ///< log10(A / B) of the largest magnitude
  std::optional<ScanPoint> largest_a, largest_b;  ///< where it stands
};

/// Matches each point of A with the nearest of B: both zenith angles and phi = phi_o - phi_i (of no meaning where a
/// direction is the normal) within `tolerance_deg`, the wavelengths within 0.5 nm where both are stated.
ScanComparison compare_scans(const Measurement& a, const Measurement& b, double tolerance_deg);

}  // namespace gonio
