#include "fit/formats/compare.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace gonio {
namespace {

constexpr double kSameWavelengthNm = 0.5;

/// θ_i, θ_o and φ from 0 to 360.
std::array<double, 3> angles_of(const ScanPoint& p, double tolerance) {
  if (p.theta_i_deg <= tolerance / 2 || p.theta_o_deg <= tolerance / 2) return {p.theta_i_deg, p.theta_o_deg, 0};
  const double phi = std::fmod(p.phi_deg(), 360);
  return {p.theta_i_deg, p.theta_o_deg, phi < 0 ? phi + 360 : phi};
}

/// Points of B in cubes as wide as the tolerance: a partner stands in the same one or a neighbour.
class Cubes {
 public:
  Cubes(const Measurement& b, double tolerance) : b_(b), tolerance_(tolerance), width_(std::max(tolerance, 1e-6)) {
    for (std::size_t k = 0; k < b.points.size(); ++k) {
      std::array<double, 3> angles = angles_of(b.points[k], tolerance);
      add(angles, k);
      const double phi = angles[2];
      angles[2] = phi + 360;
      if (phi <= tolerance) add(angles, k);
      angles[2] = phi - 360;
      if (phi >= 360 - tolerance) add(angles, k);
    }
  }

  const ScanPoint* partner(const ScanPoint& a) const {
    const std::array<double, 3> angles = angles_of(a, tolerance_);
    const ScanPoint* nearest = nullptr;
    double least = 0;
    for (int n = 0; n < 27; ++n) {
      std::array<double, 3> shifted = angles;
      for (std::size_t k = 0, m = static_cast<std::size_t>(n); k < 3; ++k, m /= 3)
        shifted[k] += (static_cast<double>(m % 3) - 1) * width_;
      const auto cube = cubes_.find(key(shifted));
      if (cube == cubes_.end()) continue;
      for (const auto& [there, index] : cube->second) {
        const ScanPoint& b = b_.points[index];
        const double far =
            std::max({std::abs(there[0] - angles[0]), std::abs(there[1] - angles[1]), std::abs(there[2] - angles[2])});
        const bool other =
            a.has_wavelength() && b.has_wavelength() && std::abs(a.wavelength_nm - b.wavelength_nm) > kSameWavelengthNm;
        if (far > tolerance_ + 1e-9 || other || (nearest != nullptr && far >= least)) continue;
        nearest = &b, least = far;
      }
    }
    return nearest;
  }

 private:
  std::uint64_t key(const std::array<double, 3>& angles) const {
    std::uint64_t packed = 0;
    for (const double angle : angles)
      packed = packed * 1000003u + static_cast<std::uint64_t>(std::llround(std::floor(angle / width_)));
    return packed;
  }
  void add(const std::array<double, 3>& angles, std::size_t index) { cubes_[key(angles)].emplace_back(angles, index); }

  const Measurement& b_;
  double tolerance_, width_;
  std::unordered_map<std::uint64_t, std::vector<std::pair<std::array<double, 3>, std::size_t>>> cubes_;
};

}  // namespace

ScanComparison compare_scans(const Measurement& a, const Measurement& b, double tolerance_deg) {
  ScanComparison result;
  result.points_a = a.points.size(), result.points_b = b.points.size();
  const Cubes cubes(b, tolerance_deg);
  double ratios = 0, squares = 0;
  for (const ScanPoint& p : a.points) {
    const ScanPoint* q = cubes.partner(p);
    if (q == nullptr) continue;
    ++result.matched;
    if (!(p.f_per_sr > 0 && q->f_per_sr > 0)) continue;
    ++result.compared;
    const double ratio = p.f_per_sr / q->f_per_sr, decades = std::log10(p.f_per_sr) - std::log10(q->f_per_sr);
    ratios += ratio, squares += decades * decades;
    if (result.largest_a && std::abs(decades) <= std::abs(result.largest_log10)) continue;
    result.largest_log10 = decades, result.largest_a = p, result.largest_b = *q;
  }
  if (result.compared == 0) return result;
  result.mean_ratio = ratios / static_cast<double>(result.compared);
  result.rms_log10 = std::sqrt(squares / static_cast<double>(result.compared));
  return result;
}

}  // namespace gonio
