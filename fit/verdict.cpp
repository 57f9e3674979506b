#include "fit/verdict.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"

namespace gonio {
namespace {

constexpr double kCore = 0.1, kTails = 1e-3;  // of the brightest measured point of an incidence angle
constexpr double kOffset = 0.15;              // mean log10 from which on core or tails are called missed
constexpr double kStructured = 0.5;           // correlation of neighbouring residuals

/// Sums that become Residuals.
struct Tally {
  int points = 0, positive = 0;
  double squares = 0, log_squares = 0, logs = 0;

  void add(const FitProblem& problem, const FitPoint& point, double fitted) {
    ++points;
    squares += square((problem.compared(fitted, point) - problem.compared(point.f_per_sr, point)) * point.confidence);
    if (!(point.f_per_sr > 0)) return;
    ++positive;
    const double ratio = std::log10((fitted + problem.floor_per_sr) / (point.f_per_sr + problem.floor_per_sr));
    log_squares += square(ratio);
    logs += ratio;
  }
  void write(Residuals& to) const {
    to.points = points;
    to.rms = points ? std::sqrt(squares / points) : 0;
    to.rms_log10 = positive ? std::sqrt(log_squares / positive) : 0;
    to.mean_log10 = positive ? logs / positive : 0;
  }
};

void tally_all(const Prepared& prepared, FitResult& result) {
  Tally all;
  std::vector<Tally> incidences(result.by_incidence.size());
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    const FittedPoint& point = result.points[i];
    if (!point.used && !point.held_out) continue;
    if (point.used) all.add(prepared.problem, prepared.points[i], point.fitted_per_sr);
    incidences[point.incidence].add(prepared.problem, prepared.points[i], point.fitted_per_sr);
  }
  all.write(result.all);
  for (std::size_t i = 0; i < incidences.size(); ++i) {
    incidences[i].write(result.by_incidence[i]);
    result.by_incidence[i].held_out = prepared.held_incidence == i;
  }
  if (prepared.held_incidence) result.held_out = result.by_incidence[*prepared.held_incidence];
}

/// Correlation of residuals that lie next to each other: same incidence, side by side in azimuth, then in zenith angle.
double neighbour_correlation(const Prepared& prepared, const FitResult& result) {
  std::vector<std::tuple<std::size_t, double, double, std::size_t>> keys;
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    const FittedPoint& p = result.points[i];
    if (!p.used) continue;
    keys.emplace_back(p.incidence, std::round(10 * (p.phi_deg - 360 * std::floor(p.phi_deg / 360))), p.theta_o_deg, i);
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::size_t> order;
  for (const auto& key : keys) order.push_back(std::get<3>(key));
  double products = 0, squares = 0, last = 0;
  for (std::size_t at = 0; at < order.size(); ++at) {
    const FitPoint& point = prepared.points[order[at]];
    const double residual =
        point.confidence * (prepared.problem.compared(result.points[order[at]].fitted_per_sr, point) -
                            prepared.problem.compared(point.f_per_sr, point));
    if (at > 0 && result.points[order[at]].incidence == result.points[order[at - 1]].incidence)
      products += last * residual;
    squares += square(residual);
    last = residual;
  }
  return squares > 0 ? products / squares : 0;
}

/// Mean log10 of fitted over measured in the core and in the tails of the lobe.
struct CoreAndTails {
  int core_points = 0, tail_points = 0;
  double core = 0, tails = 0;
};

CoreAndTails core_and_tails(const FitResult& result) {
  std::vector<double> peak(result.by_incidence.size(), 0);
  for (const FittedPoint& p : result.points)
    if (p.used) peak[p.incidence] = std::max(peak[p.incidence], p.measured_per_sr);
  CoreAndTails found;
  for (const FittedPoint& p : result.points) {
    if (!p.used || !(p.measured_per_sr > 0)) continue;
    const double level = p.measured_per_sr / peak[p.incidence];
    const double ratio =
        std::log10((p.fitted_per_sr + result.floor_per_sr) / (p.measured_per_sr + result.floor_per_sr));
    if (level >= kCore) ++found.core_points, found.core += ratio;
    if (level <= kTails) ++found.tail_points, found.tails += ratio;
  }
  if (found.core_points) found.core /= found.core_points;
  if (found.tail_points) found.tails /= found.tail_points;
  return found;
}

std::string factor(double log10_ratio) {
  return fmt::format("{} by a factor of {:.3g}", log10_ratio > 0 ? "too bright" : "too dark",
                     std::pow(10, std::abs(log10_ratio)));
}

void say_what_is_missed(FitResult& result) {
  if (!(result.all.rms_log10 > kExplains)) return;
  result.warnings.push_back(
      fmt::format("{} does not explain these data: model and measurement differ by a factor of {:.3g} (rms; rms_log10 "
                  "= {:.3g}); its "
                  "parameters are no measure of the surface",
                  result.model.name(), std::pow(10, result.all.rms_log10), result.all.rms_log10));
  const CoreAndTails parts = core_and_tails(result);
  std::string text;
  if (parts.core_points > 0 && std::abs(parts.core) > kOffset)
    text += fmt::format(
        "in the core of the lobe (above {} of each incidence's brightest point, {} points) the fit is on average {}",
        kCore, parts.core_points, factor(parts.core));
  if (parts.tail_points > 0 && std::abs(parts.tails) > kOffset)
    text += fmt::format("{}in the tails (below {} of it, {} points) {}{}", text.empty() ? "" : "; ", kTails,
                        parts.tail_points, text.empty() ? "the fit is on average " : "", factor(parts.tails));
  if (text.empty()) return;
  if (parts.core_points > 0 && parts.tail_points > 0 && !result.model.is_sum() &&
      result.model.first().id != ModelId::lambert)
    text += ": a narrow core on long tails, which a single Gaussian lobe cannot follow";
  result.warnings.push_back(text);
}

/// Beckmann-Kirchhoff's lobe tends to a law of sigma/T alone as 1/g: from g = 100 on sigma and T rest on differences of
/// about a percent, which exact data show and measured data seldom do.
void say_when_only_the_slope_counts(const Prepared& prepared, FitResult& result) {
  constexpr double kLargeG = 100;
  if (result.model.is_sum() || result.model.first().id != ModelId::beckmann_kirchhoff) return;
  if (result.model.variant() != "exact") return;
  if (!result.find("sigma_um")->identifiable) return;  // said already
  const BeckmannKirchhoff<double> kirchhoff{result.value("sigma_um"), result.value("correlation_um")};
  std::vector<double> g;
  for (const FitPoint& point : prepared.problem.points)
    g.push_back(kirchhoff.phase_variance(point.directions, point.wavelength_um));
  std::nth_element(g.begin(), g.begin() + static_cast<std::ptrdiff_t>(g.size() / 2), g.end());
  const double median = g[g.size() / 2];
  if (median > kLargeG)
    result.warnings.push_back(
        fmt::format("rough limit (median g = {:.3g}): the lobe depends almost only on sigma_um/correlation_um = "
                    "{:.6g}; sigma_um and "
                    "correlation_um apart rest on differences of order 1/g",
                    median, kirchhoff.sigma_um / kirchhoff.correlation_um));
}

}  // namespace

void judge(const Prepared& prepared, FitResult& result) {
  tally_all(prepared, result);
  result.neighbour_correlation = neighbour_correlation(prepared, result);
  say_what_is_missed(result);
  say_when_only_the_slope_counts(prepared, result);
  if (result.neighbour_correlation > kStructured && result.all.rms_log10 > 1e-3)
    result.warnings.push_back(
        fmt::format("residuals are structured (neighbours correlate {:.2f}; 0 if errors were independent): standard "
                    "errors and intervals "
                    "are too small",
                    result.neighbour_correlation));
  if (result.held_out && result.held_out->rms_log10 > 2 * result.all.rms_log10 && result.held_out->rms_log10 > 0.01)
    result.warnings.push_back(
        fmt::format("the incidence left out ({} degrees) is predicted worse than the fit: rms_log10 {:.3g} "
                    "against {:.3g}",
                    result.held_out->theta_i_deg, result.held_out->rms_log10, result.all.rms_log10));
}

}  // namespace gonio
