#include "fit/scan_traps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "base/error.h"
#include "fit/signature.h"

namespace gonio {
namespace {

constexpr double kGap = 2.5;  // degrees from the peak's direction that a scan may leave out unmentioned
constexpr double kNear = 20;  // degrees of zenith angle and azimuth: what is farther off is no neighbour of the peak
constexpr std::size_t kPlateau = 3;  // equal values that chance does not make
constexpr double kEqual = 1e-9;      // relative

bool is_diffuse(const ModelSpec& lobe) {
  return lobe.id == ModelId::lambert || lobe.id == ModelId::oren_nayar || lobe.id == ModelId::oren_nayar_qualitative;
}

/// The same point seen with the light turned back: the retro direction takes the mirror's place.
ScanPoint turned_back(ScanPoint p) {
  p.phi_i_deg += 180;
  return p;
}

/// The angle to the mirror direction (of the light turned back) of each incidence's nearest point, the middle of them; infinite where an
/// incidence has none near.
double usual_gap_deg(const Measurement& scan, bool retro) {
  std::vector<double> nearest(scan.incidences_deg.size(), std::numeric_limits<double>::infinity());
  for (const ScanPoint& given : scan.points) {
    if (std::abs(given.theta_o_deg - given.theta_i_deg) > kNear) continue;
    const ScanPoint p = retro ? turned_back(given) : given;
    const double off = std::abs(std::remainder(p.phi_deg() - 180, 360));
    if (off > kNear && std::min(p.theta_i_deg, p.theta_o_deg) > kNear) continue;
    nearest[p.incidence] = std::min(nearest[p.incidence], from_mirror_deg(p));
  }
  const auto middle = nearest.begin() + static_cast<std::ptrdiff_t>(nearest.size() / 2);
  std::nth_element(nearest.begin(), middle, nearest.end());
  return *middle;
}

void warn_of_gap(const Measurement& scan, FitResult& result) {
  for (const bool retro : {false, true}) {
    const auto& lobes = result.model.lobes();
    if (std::none_of(lobes.begin(), lobes.end(), [&](auto& l) { return !is_diffuse(l) && l.retro == retro; })) continue;
    const double gap = usual_gap_deg(scan, retro);
    if (gap <= kGap) continue;
    result.warnings.push_back(fmt::format(
        "{} of the {} direction: a narrower peak there would go unseen, and the fit is of what lies beside it",
        std::isfinite(gap) ? fmt::format("most incidences have no point within {:.2g} degrees", gap)
                           : std::string("most incidences have no point in the neighbourhood"),
        retro ? "light's own" : "mirror"));
  }
}

/// A pair of directions but for what symmetry and reciprocity make equal; rounded to 1e-6 degrees.
std::array<long, 3> pair_of(const ScanPoint& p) {
  const auto rounded = [](double deg) { return std::lround(deg * 1e6); };
  const double lo = std::min(p.theta_i_deg, p.theta_o_deg), hi = std::max(p.theta_i_deg, p.theta_o_deg);
  return {rounded(lo), rounded(hi), lo == 0 ? 0 : rounded(std::abs(std::remainder(p.phi_deg(), 360)))};
}

void warn_of_plateau(const Measurement& scan, FitResult& result) {
  double brightest = 0;
  for (const ScanPoint& p : scan.points) brightest = std::max(brightest, p.f_per_sr);
  std::set<std::array<long, 3>> pairs;
  std::size_t equal = 0;
  for (const ScanPoint& p : scan.points)
    if (p.f_per_sr >= brightest * (1 - kEqual)) pairs.insert(pair_of(p)), ++equal;
  if (!(brightest > 0) || pairs.size() < kPlateau || equal == scan.points.size()) return;
  result.warnings.push_back(
      fmt::format("{} points share the scan's largest value ({:.6g} per sr): the detector may have been at its end, "
                  "and the peak higher",
                  equal, brightest));
}

}  // namespace

void warn_of_traps(const Measurement& scan, FitResult& result) {
  warn_of_gap(scan, result);
  warn_of_plateau(scan, result);
}

}  // namespace gonio
