#include "fit/signature.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "brdf/directions.h"

namespace gonio {
namespace {

constexpr double kSameAngle = 1e-6;   // degrees
constexpr double kMostOfValue = 0.9;  // of a value that may be signature

}  // namespace

double from_mirror_deg(const ScanPoint& p) {
  const double degree = kPi<double> / 180;
  const double i = p.theta_i_deg * degree, o = p.theta_o_deg * degree, off = (p.phi_deg() - 180) * degree;
  // Half the chord between the two: good at small angles, where an arc cosine has lost them.
  const double dx = std::sin(o) * std::cos(off) - std::sin(i), dy = std::sin(o) * std::sin(off),
               dz = std::cos(o) - std::cos(i);
  return 2 * std::asin(std::min(1.0, 0.5 * std::sqrt(dx * dx + dy * dy + dz * dz))) / degree;
}

Signature::Signature(const Measurement& scan) {
  std::vector<std::pair<double, double>> all;
  for (const ScanPoint& p : scan.points)
    if (p.f_per_sr > 0) all.emplace_back(from_mirror_deg(p), p.f_per_sr * cos_deg(p.theta_o_deg));
  std::sort(all.begin(), all.end());
  for (std::size_t from = 0; from < all.size();) {
    std::size_t end = from;
    double sum = 0;
    while (end < all.size() && all[end].first - all[from].first <= kSameAngle) sum += all[end++].second;
    points_.emplace_back(all[from].first, sum / static_cast<double>(end - from));
    from = end;
  }
  if (points_.size() < 2)
    throw input_error("{}: no instrument signature ({} angles of positive value); expected two or more", scan.id,
                      points_.size());
}

double Signature::at(double angle_deg) const {
  if (angle_deg <= points_.front().first) return points_.front().second;
  if (angle_deg > points_.back().first + kSameAngle) return 0;
  angle_deg = std::min(angle_deg, points_.back().first);
  const auto next = std::lower_bound(points_.begin() + 1, points_.end() - 1, std::pair(angle_deg, 0.0));
  const auto& [lo, from] = *(next - 1);
  return from * std::pow(next->second / from, (angle_deg - lo) / (next->first - lo));
}

Measurement without_signature(const Measurement& scan, const Signature& signature, double scale) {
  if (!(scale >= 0 && scale <= 1e6))
    throw input_error("signature scale {}: cannot be; expected 0 or more, up to 1e6", scale);
  Measurement clean = scan;
  clean.points.clear();
  int lost = 0;
  for (ScanPoint p : scan.points) {
    const double seen = scale * signature.at(from_mirror_deg(p)) / cos_deg(p.theta_o_deg);
    if (p.f_per_sr > 0 && seen >= kMostOfValue * p.f_per_sr) {
      ++lost;
      continue;
    }
    p.f_per_sr -= seen;
    clean.points.push_back(p);
  }
  if (lost > 0) clean.left_out["90 % or more is the instrument's signature"] = lost;
  if (clean.points.empty())
    throw input_error("{}: is nothing but the instrument's signature; expected values above it", scan.id);
  group_by_incidence(clean);
  return clean;
}

}  // namespace gonio
