#include "assess/fit_speed.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>

#include "fit/prepare.h"
#include "fit/start.h"

namespace gonio {
namespace {

constexpr std::size_t kFewPoints = 192, kSomePoints = 3000;  // those of gonio::fit()

/// kd and ks of each wavelength instead of shared ones.
void give_own_scales(FitSamples& samples, std::size_t wavelengths) {
  std::vector<FreeParameter> free;
  std::vector<double> truth;
  for (std::size_t i = 0; i < samples.problem.free.size(); ++i) {
    const std::size_t copies = samples.problem.free[i].linear ? wavelengths : 1;
    for (std::size_t group = 0; group < copies; ++group) {
      free.push_back(samples.problem.free[i]);
      if (free.back().linear) free.back().group = group;
      truth.push_back(samples.truth[i]);
    }
  }
  samples.problem.free = std::move(free), samples.truth = std::move(truth);
}

FitSamples ready(Measurement scan, const FitRequest& request) {
  FitSamples samples{std::move(scan), request, {}, {}};
  FitResult result;
  samples.problem = prepare(samples.scan, samples.request, result).problem;
  return samples;
}

/// Solves from x on some of the points; the lanes are ready already.
Solution solve_by(Derivatives derivatives, const LaneFit& lanes, std::span<const std::size_t> points,
                  std::vector<double> x, double tolerance) {
  if (derivatives == Derivatives::lanes) return lanes.solve(std::move(x), tolerance);
  return solve_with_ceres(lanes.problem(), points, std::move(x), derivatives, tolerance);
}

}  // namespace

std::string_view name_of(Derivatives derivatives) {
  return derivatives == Derivatives::lanes ? "lanes" : derivatives == Derivatives::jet ? "ceres::Jet" : "differences";
}

std::vector<double> typical_values(const ModelInfo& info) {
  std::vector<double> values;
  for (const ParameterInfo& p : info.parameters) {
    if (p.name == "kd")
      values.push_back(0.05);
    else if (p.name == "ks")
      values.push_back(0.9);
    else if (p.name == "m")
      values.push_back(0.15);
    else if (p.name == "sigma_um")
      values.push_back(0.15);
    else if (p.name == "correlation_um")
      values.push_back(2.5);
    else if (p.name == "alpha_2")
      values.push_back(0.5);
    else if (p.name == "weight_2")
      values.push_back(0.3);
    else if (p.name.starts_with("alpha"))
      values.push_back(0.15);
    else
      values.push_back(std::sqrt(p.fit_lo * p.fit_hi));
  }
  return values;
}

FitSamples fit_samples(const FitCase& wanted) {
  FitRequest request;
  request.model = lobe_sum(wanted.model);
  request.metric = wanted.metric, request.material = "Au", request.hold_out = HoldOut::none;
  std::vector<double> wavelengths_nm;
  for (std::size_t w = 0; w < wanted.wavelengths; ++w)
    wavelengths_nm.push_back(wanted.wavelengths == 1 ? 550 : 400 + 300 * double(w) / double(wanted.wavelengths - 1));
  const std::vector<double> values = typical_values(request.model.first().info());
  FitSamples samples = ready(filled(hemisphere_scan(wanted.directions, wavelengths_nm), request.model.first(), values, "Au",
                                    wanted.noise, wanted.seed),
                             request);
  for (const FreeParameter& p : samples.problem.free) samples.truth.push_back(std::log(values[p.place]));
  if (wanted.own_scales) give_own_scales(samples, wanted.wavelengths);
  return samples;
}

FitSamples with_model(const FitSamples& samples, const ModelSpec& model) {
  FitRequest request = samples.request;
  request.model = model;
  return ready(samples.scan, request);
}

ManyStarts solve_starts(const FitProblem& problem, int starts, Derivatives derivatives, double tolerance,
                        std::uint64_t seed, bool search) {
  const std::vector<std::size_t> every = every_point(problem);
  const bool many = every.size() > 2 * kSomePoints;
  const std::vector<std::size_t> searched = many ? thinned_points(problem, kSomePoints) : every;
  const LaneFit few(problem, thinned_points(problem, kFewPoints)), lanes(problem, searched);
  std::vector<Solution> ends(static_cast<std::size_t>(starts));
  tbb::parallel_for(0, starts, [&](int start) {
    std::vector<double> x = start_point(problem, start, seed);
    if (search)
      x = improve_start(few, std::move(x));
    else
      few.eliminate(x);
    ends[std::size_t(start)] = solve_by(derivatives, lanes, searched, std::move(x), tolerance);
  });
  ManyStarts found;
  found.best = *std::min_element(ends.begin(), ends.end(), [](auto& a, auto& b) { return a.cost < b.cost; });
  for (const Solution& end : ends) found.agreeing += end.cost <= found.best.cost * (1 + 1e-6);
  if (many) found.best = solve_by(derivatives, LaneFit(problem, every), every, found.best.x, tolerance);
  return found;
}

double rms_of(const FitProblem& problem, const Solution& solution) {
  return std::sqrt(2 * solution.cost / double(problem.points.size()));
}

double parameter_error(const FitSamples& samples, const std::vector<double>& x) {
  double worst = samples.truth.empty() ? NAN : 0;
  for (std::size_t i = 0; i < samples.truth.size(); ++i) worst = std::max(worst, std::abs(x[i] - samples.truth[i]));
  return worst;
}

void in_threads(int threads, const std::function<void()>& run) { tbb::task_arena(threads).execute(run); }

}  // namespace gonio
