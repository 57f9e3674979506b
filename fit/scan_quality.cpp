#include "fit/scan_quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <tuple>

#include "base/error.h"
#include "brdf/directions.h"
#include "fit/robust.h"
#include "fit/scan.h"

namespace gonio {
namespace {

constexpr double kSameDeg = 0.05, kSameNm = 0.01;
constexpr int kEnoughPairs = 8;
constexpr double kMedianError = 1.2533141373155;  // √(π/2): the standard error of a median over that of a mean

/// Number of a cell of equal angles; the shift keeps its ends off the decimals that scans use.
std::int64_t cell(double angle, double width = kSameDeg) {
  return static_cast<std::int64_t>(std::floor(angle / width + 0.37));
}
std::int64_t turned_cell(double phi_deg) {
  return cell(phi_deg - 360 * std::floor((phi_deg + 0.37 * kSameDeg) / 360));  // just below 360 belongs to 0
}
std::int64_t wavelength_cell(const ScanPoint& p) { return p.has_wavelength() ? cell(p.wavelength_nm, kSameNm) : -1; }

struct Direction {
  std::int64_t theta, phi;
  auto operator<=>(const Direction&) const = default;
};
/// At the normal an azimuth says nothing.
Direction direction(double theta_deg, double phi_deg) {
  const std::int64_t theta = cell(theta_deg);
  return {theta, theta == 0 ? 0 : turned_cell(phi_deg)};
}

PairStatistics statistics(const std::vector<double>& log_ratios) {
  PairStatistics found;
  found.pairs = static_cast<int>(log_ratios.size());
  if (log_ratios.empty()) return found;
  double squares = 0, sides = 0;
  for (const double ratio : log_ratios) squares += ratio * ratio, sides += (ratio > 0) - (ratio < 0);
  found.rms_log10 = std::sqrt(squares / static_cast<double>(log_ratios.size()));
  found.spread_log10 = robust_spread(log_ratios, 0);
  found.median_log10 = median(log_ratios);
  const double scatter = robust_spread(log_ratios, found.median_log10);
  found.median_error_log10 = kMedianError * scatter / std::sqrt(static_cast<double>(log_ratios.size()));
  found.one_sided = sides / std::sqrt(static_cast<double>(log_ratios.size()));
  return found;
}

/// A pair of directions whichever of them is lit, and which way round the row has it.
struct Exchange {
  Direction first, second;
  bool exchanged, own;  ///< own: exchanging the two gives the same row
};

Exchange exchange(const ScanPoint& p, bool isotropic) {
  Direction i = direction(p.theta_i_deg, p.phi_i_deg), o = direction(p.theta_o_deg, p.phi_o_deg);
  if (isotropic) {
    const bool normal = i.theta == 0 || o.theta == 0;
    const std::int64_t between = normal ? 0 : turned_cell(std::abs(std::remainder(p.phi_deg(), 360)));
    i.phi = o.phi = between;
  }
  return {std::min(i, o), std::max(i, o), o < i, i == o};
}

bool one_azimuth_of_incidence(const Measurement& scan) {
  std::set<std::int64_t> azimuths;
  for (const ScanPoint& p : scan.points)
    if (const Direction i = direction(p.theta_i_deg, p.phi_i_deg); i.theta != 0) azimuths.insert(i.phi);
  return azimuths.size() <= 1;
}

// ------------------------------------------------------------ energy

constexpr int kCells = 64;  // across the disc of direction cosines: 0.031 each
constexpr double kReach = 0.15, kCovered = 0.98;

/// Values averaged in cells of the disc of direction cosines, where cos_o dω_o is the area; an empty cell takes those
/// nearest.
class Disc {
 public:
  void add(double x, double y, double f) {
    for (const double side : {y, -y}) {  // both sides of the plane of incidence
      Cell& c = cells_[at(x)][at(side)];
      c.sum += f, ++c.count;
    }
  }
  /// ∫ f dA, and the covered share.
  std::pair<double, double> integral() const {
    double sum = 0;
    int inside = 0, covered = 0;
    for (int x = 0; x < kCells; ++x)
      for (int y = 0; y < kCells; ++y) {
        if (std::hypot(centre(x), centre(y)) > 1) continue;
        ++inside;
        if (const Cell near = nearest(x, y); near.count > 0) ++covered, sum += near.sum / near.count;
      }
    return {covered ? kPi<double> * sum / covered : 0, static_cast<double>(covered) / inside};
  }

 private:
  struct Cell {
    double sum = 0;
    int count = 0;
  };
  static int at(double x) { return std::clamp(static_cast<int>(std::floor((x + 1) / 2 * kCells)), 0, kCells - 1); }
  static double centre(int cell) { return (2 * cell + 1.0) / kCells - 1; }

  Cell nearest(int x, int y) const {
    if (cells_[x][y].count > 0) return cells_[x][y];
    constexpr int kMost = static_cast<int>(kReach * kCells / 2);
    int best = kMost * kMost + 1;
    Cell found;
    for (int dx = -kMost; dx <= kMost; ++dx)
      for (int dy = -kMost; dy <= kMost; ++dy) {
        const int far = dx * dx + dy * dy, i = x + dx, j = y + dy;
        if (far > best || i < 0 || j < 0 || i >= kCells || j >= kCells || cells_[i][j].count == 0) continue;
        if (far < best) best = far, found = {};
        found.sum += cells_[i][j].sum / cells_[i][j].count, ++found.count;
      }
    return found;
  }

  std::array<std::array<Cell, kCells>, kCells> cells_{};
};

std::optional<ScanEnergy> energy_of(const std::vector<const ScanPoint*>& rows) {
  constexpr std::size_t kFewest = 30;  // fewer cannot cover the disc
  if (rows.size() < kFewest) return std::nullopt;
  Disc all, half;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const ScanPoint& p = *rows[k];
    const double phi = p.phi_deg() * kPi<double> / 180, sine = sin_deg(p.theta_o_deg);
    all.add(sine * std::cos(phi), sine * std::sin(phi), p.f_per_sr);
    if (k % 2 == 0) half.add(sine * std::cos(phi), sine * std::sin(phi), p.f_per_sr);
  }
  const auto [value, covered] = all.integral();
  if (covered < kCovered) return std::nullopt;
  const ScanPoint& first = *rows.front();
  return ScanEnergy{first.theta_i_deg,
                    first.phi_i_deg,
                    first.wavelength_nm,
                    value,
                    std::abs(value - half.integral().first),
                    static_cast<int>(rows.size())};
}

}  // namespace

PairStatistics repeats_of(const Measurement& scan) {
  using Key = std::tuple<std::int64_t, Direction, Direction, std::size_t>;
  std::vector<Key> keys;
  for (std::size_t k = 0; k < scan.points.size(); ++k) {
    const ScanPoint& p = scan.points[k];
    if (!(p.f_per_sr > 0)) continue;
    keys.emplace_back(wavelength_cell(p), direction(p.theta_i_deg, p.phi_i_deg), direction(p.theta_o_deg, p.phi_o_deg),
                      k);
  }
  std::sort(keys.begin(), keys.end());
  std::vector<double> log_ratios;
  for (std::size_t k = 1; k < keys.size(); ++k) {
    const auto& [nm, i, o, row] = keys[k];
    const auto& [nm_before, i_before, o_before, row_before] = keys[k - 1];
    if (nm == nm_before && i == i_before && o == o_before)
      log_ratios.push_back(std::log10(scan.points[row_before].f_per_sr / scan.points[row].f_per_sr));
  }
  return statistics(log_ratios);
}

PairStatistics reciprocal_pairs_of(const Measurement& scan) {
  using Key = std::tuple<std::int64_t, Direction, Direction, bool, std::size_t>;
  const bool isotropic = one_azimuth_of_incidence(scan);
  std::vector<Key> keys;
  for (std::size_t k = 0; k < scan.points.size(); ++k) {
    const ScanPoint& p = scan.points[k];
    if (const Exchange e = exchange(p, isotropic); p.f_per_sr > 0 && !e.own)
      keys.emplace_back(wavelength_cell(p), e.first, e.second, e.exchanged, k);
  }
  std::sort(keys.begin(), keys.end());
  std::vector<double> log_ratios;
  const auto same = [](const Key& a, const Key& b) {
    return std::get<0>(a) == std::get<0>(b) && std::get<1>(a) == std::get<1>(b) && std::get<2>(a) == std::get<2>(b);
  };
  for (std::size_t from = 0, end; from < keys.size(); from = end) {
    for (end = from; end < keys.size() && same(keys[end], keys[from]);) ++end;
    std::size_t other = from;
    while (other < end && !std::get<3>(keys[other])) ++other;
    for (std::size_t k = 0; from + k < other && other + k < end; ++k)
      log_ratios.push_back(std::log10(scan.points[std::get<4>(keys[from + k])].f_per_sr /
                                      scan.points[std::get<4>(keys[other + k])].f_per_sr));
  }
  return statistics(log_ratios);
}

std::vector<ScanEnergy> scan_energies(const Measurement& scan) {
  std::vector<ScanEnergy> energies;
  if (scan.quantity == "relative") return energies;
  std::map<std::pair<std::int64_t, Direction>, std::vector<const ScanPoint*>> groups;
  for (const ScanPoint& p : scan.points)
    groups[{wavelength_cell(p), direction(p.theta_i_deg, p.phi_i_deg)}].push_back(&p);
  for (const auto& [key, rows] : groups)
    if (const auto energy = energy_of(rows)) energies.push_back(*energy);
  return energies;
}

std::optional<std::string> reciprocity_broken(const PairStatistics& repeats, const PairStatistics& reciprocal) {
  if (reciprocal.pairs < kEnoughPairs) return std::nullopt;
  const double shift = std::abs(reciprocal.median_log10);
  constexpr double kTwoPercent = 0.0086;  // log10(1.02)
  if (shift > kTwoPercent && (shift > 5 * reciprocal.median_error_log10 || std::abs(reciprocal.one_sided) > 4.5))
    return fmt::format(
        "the values are not reciprocal: of {} pairs of exchanged directions the one lit from closer to the normal is "
        "{} by a factor of {:.3g} (median)",
        reciprocal.pairs, reciprocal.median_log10 > 0 ? "brighter" : "darker", std::pow(10, shift));
  if (repeats.pairs >= kEnoughPairs && reciprocal.spread_log10 > kTwoPercent &&
      reciprocal.spread_log10 > 2.5 * repeats.spread_log10)
    return fmt::format(
        "the values are not reciprocal within their noise: {} pairs of exchanged directions differ by a factor of "
        "{:.3g}, {} repeats by {:.3g}",
        reciprocal.pairs, std::pow(10, reciprocal.spread_log10), repeats.pairs, std::pow(10, repeats.spread_log10));
  return std::nullopt;
}

ScanQuality scan_quality(const Measurement& scan) {
  ScanQuality quality{repeats_of(scan), reciprocal_pairs_of(scan), scan_energies(scan), {}};
  if (const auto broken = reciprocity_broken(quality.repeats, quality.reciprocal)) quality.warnings.push_back(*broken);
  for (const ScanEnergy& e : quality.energies)
    if (e.reflectance > 1 + e.error)
      quality.warnings.push_back(fmt::format(
          "the values reflect {:.3g} (± {:.1g}) of the light at incidence {:g} degrees{}; at most 1 is possible",
          e.reflectance, e.error, e.theta_i_deg,
          e.wavelength_nm == e.wavelength_nm ? fmt::format(" and {:g} nm", e.wavelength_nm) : ""));
  return quality;
}

std::optional<NoiseEstimate> noise_estimate(const Measurement& scan) {
  const auto of = [](const PairStatistics& pairs, std::string_view from) -> std::optional<NoiseEstimate> {
    if (pairs.pairs < kEnoughPairs || !(pairs.spread_log10 > 0)) return std::nullopt;
    return NoiseEstimate{pairs.spread_log10 * std::log(10.0) / std::sqrt(2.0), from, pairs.pairs};
  };
  if (const auto repeated = of(repeats_of(scan), "repeats")) return repeated;
  return of(reciprocal_pairs_of(scan), "reciprocity");
}

}  // namespace gonio
