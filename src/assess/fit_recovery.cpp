#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "assess/fit_stability.h"

namespace gonio {
namespace {

constexpr int kStarts = 4;
constexpr double kMostDecades = 3;

/// The true parameters at a roughness.
std::vector<double> truth_at(ModelId id, double roughness) {
  if (id == ModelId::torrance_sparrow) return {roughness, 0.05, 0.9};
  if (id == ModelId::ggx) return {roughness, roughness, 0.05, 0.9};
  return {roughness, 5, 0.05, 0.9};
}

MapAxis roughness_axis(ModelId id) {
  if (id == ModelId::torrance_sparrow) return {"log₁₀ slope rms m", -2, 0};
  if (id == ModelId::ggx) return {"log₁₀ alpha", -2, 0};
  return {"log₁₀ sigma in um, T = 5 um", -2, 0};
}

MapAxis swept_axis(RecoverySweep sweep) {
  if (sweep == RecoverySweep::noise) return {"log₁₀ noise of ln f", -3, 0};
  if (sweep == RecoverySweep::step) return {"log₁₀ step in degrees", -0.3, 1.2};
  return {"largest theta_o, degrees", 10, 85, false};
}

struct Repeat {
  double decades = 0;
  int inside = 0, parameters = 0;
  bool silent = false;
};

Repeat judged(const FitResult& result, const std::vector<double>& truth) {
  Repeat repeat;
  bool wrong = false;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const FittedParameter& p = result.parameters[i];
    const double off = p.value > 0 ? std::min(std::abs(std::log10(p.value / truth[i])), kMostDecades) : kMostDecades;
    const bool inside = p.lo95 <= truth[i] && truth[i] <= p.hi95;
    repeat.decades = std::max(repeat.decades, off);
    repeat.inside += inside, ++repeat.parameters;
    wrong = wrong || (off > kFailedDecades && !inside);
  }
  repeat.silent = wrong && result.warnings.empty();
  return repeat;
}

Repeat recover(const ModelSpec& spec, RecoverySweep sweep, const std::vector<double>& truth, double y, int seed) {
  ScanPlan plan;
  plan.across = spec.id == ModelId::ggx;
  double noise = 0.03;
  if (sweep == RecoverySweep::noise) noise = std::pow(10, y);
  if (sweep == RecoverySweep::largest_theta_o) plan.largest_theta_o_deg = y;
  if (sweep == RecoverySweep::step) plan.step_deg = std::pow(10, y), plan.offset_deg = 0.5 * plan.step_deg;
  FitRequest request;
  request.model = spec, request.material = "Au", request.starts = kStarts;
  return judged(fit(filled(planned_scan(plan), spec, truth, "Au", noise, std::uint64_t(seed)), request), truth);
}

RecoveryCell cell_of(const std::vector<Repeat>& repeats, double x, double y) {
  RecoveryCell cell{x, y};
  std::vector<double> decades;
  int inside = 0, parameters = 0;
  for (const Repeat& r : repeats) {
    decades.push_back(r.decades);
    inside += r.inside, parameters += r.parameters;
    cell.share_silent += double(r.silent) / double(repeats.size());
  }
  std::nth_element(decades.begin(), decades.begin() + std::ptrdiff_t(decades.size() / 2), decades.end());
  cell.decades = decades[decades.size() / 2];
  cell.share_inside = double(inside) / parameters;
  return cell;
}

}  // namespace

std::string_view name_of(RecoverySweep sweep) {
  return sweep == RecoverySweep::noise ? "noise" : sweep == RecoverySweep::step ? "step" : "largest theta_o";
}

RecoveryMap recovery_map(const std::string& name, RecoverySweep sweep, std::size_t columns, std::size_t rows,
                         int repeats) {
  const ModelSpec spec{model(name).id};
  RecoveryMap map{name, sweep, roughness_axis(spec.id), swept_axis(sweep), columns, rows, {}};
  map.cells.resize(columns * rows);
  tbb::parallel_for(std::size_t(0), map.cells.size(), [&](std::size_t c) {
    const double x = map.x.at(double(c % columns) / double(columns - 1)),
                 y = map.y.at(double(c / columns) / double(rows - 1));
    const std::vector<double> truth = truth_at(spec.id, std::pow(10, x));
    std::vector<Repeat> all;
    for (int repeat = 0; repeat < repeats; ++repeat)
      all.push_back(recover(spec, sweep, truth, y, 1 + repeat + 100 * int(c)));
    map.cells[c] = cell_of(all, x, y);
  });
  return map;
}

}  // namespace gonio
