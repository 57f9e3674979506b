#include "fit/choose.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

#include "base/error.h"
#include "fit/fitted_material.h"

namespace gonio {
namespace {

constexpr std::size_t kMostFolds = 8, kMostPoints = 4000;
constexpr double kNoMatter =
    0.02;  ///< excess of the squared error, as a share of the best one's, that is of no consequence (1 % of the error)

/// Fold of each point: incidences dealt out in turn, so that no fold holds all grazing ones.
std::vector<std::size_t> folds_of(const Measurement& scan, std::size_t folds) {
  std::vector<std::size_t> all;
  for (const ScanPoint& p : scan.points) all.push_back(p.incidence % folds);
  return all;
}

/// The scan without a fold, and the fold alone.
struct Split {
  Measurement rest, left_out;
};
Split split(const Measurement& scan, const std::vector<std::size_t>& fold, std::size_t out) {
  Split s{scan, scan};
  s.rest.points.clear(), s.left_out.points.clear();
  for (std::size_t i = 0; i < scan.points.size(); ++i)
    (fold[i] == out ? s.left_out : s.rest).points.push_back(scan.points[i]);
  return s;
}

/// Few enough points that many fits take seconds, of every incidence alike.
Measurement thinned(const Measurement& scan) {
  if (scan.points.size() <= kMostPoints) return scan;
  Measurement some = scan;
  some.points.clear();
  const double step = static_cast<double>(scan.points.size()) / kMostPoints;
  for (std::size_t i = 0; i < kMostPoints; ++i) {
    const double turn = 0.6180339887498949 * static_cast<double>(i);
    some.points.push_back(
        scan.points[static_cast<std::size_t>((static_cast<double>(i) + turn - std::floor(turn)) * step)]);
  }
  return some;
}

/// Which scan a point belongs to: an incidence and 30 degrees of azimuth.
constexpr std::size_t kSectors = 12;
std::size_t scan_of(const ScanPoint& p) {
  const double turn = p.phi_deg() / 360 + 0.5 / kSectors;
  return p.incidence * kSectors +
         std::min(kSectors - 1, static_cast<std::size_t>((turn - std::floor(turn)) * kSectors));
}

/// Adds the squared log10 errors of a fit at points it has not seen, scan by scan; those that a logarithm cannot judge are passed over.
void add_errors(const FitResult& fitted, const Measurement& points, std::vector<double>& squares) {
  const FittedMaterial material = fitted_material(fitted);
  const Brdf<double> brdf = material.brdf();
  std::map<double, Interface<double>> surfaces;
  for (const ScanPoint& p : points.points) {
    if (!(p.f_per_sr > 0)) continue;
    const double nm = p.has_wavelength() ? p.wavelength_nm : fitted.assumed_wavelength_nm.value_or(1000);
    const auto surface =
        surfaces.find(nm) != surfaces.end() ? surfaces.find(nm) : surfaces.emplace(nm, material.surface(nm)).first;
    const double f = evaluate(brdf, directions_from_deg(p.theta_i_deg, p.theta_o_deg, p.phi_deg(), p.phi_i_deg),
                              surface->second, nm * 1e-3);
    squares[scan_of(p)] += square(std::log10((f + fitted.floor_per_sr) / (p.f_per_sr + fitted.floor_per_sr)));
  }
}

/// Whether a lobe's own factor (A of the ABC laws) does what ks does.
bool has_own_scale(const ModelInfo& info) {
  return std::any_of(info.parameters.begin(), info.parameters.end(),
                     [](const ParameterInfo& p) { return p.name == "a" && p.unit == "1/sr"; });
}

int free_parameters(const FitResult& result) {
  return static_cast<int>(std::count_if(result.parameters.begin(), result.parameters.end(),
                                        [](const FittedParameter& p) { return !p.held; }));
}

void information_criteria(Candidate& c) {
  const double n = c.result.points_used, k = c.parameters + 1;  // the errors' variance is one more
  const double fit = n * std::log(std::max(square(c.result.all.rms), 1e-300));
  c.aicc = fit + 2 * k + (n > k + 1 ? 2 * k * (k + 1) / (n - k - 1) : 0);
  c.bic = fit + k * std::log(n);
}

std::string name_of(const ModelSpec& spec) {
  return fmt::format("{}{}", spec.info().name, spec.retro ? " (turned back)" : "");
}

/// Excess of each candidate over the best, scan by scan.
void compare(ModelChoice& choice) {
  const std::vector<int>& points = choice.scan_points;
  double all = 0;
  for (const int n : points) all += n;
  const auto mean = [&](const std::vector<double>& of) {
    double sum = 0;
    for (std::size_t s = 0; s < of.size(); ++s) sum += points[s] * of[s];
    return sum / all;
  };
  for (Candidate& c : choice.candidates) c.held_out_log10 = std::sqrt(mean(c.scan_error));
  const auto less = [](const Candidate& a, const Candidate& b) { return a.held_out_log10 < b.held_out_log10; };
  choice.best = static_cast<std::size_t>(std::min_element(choice.candidates.begin(), choice.candidates.end(), less) -
                                         choice.candidates.begin());
  const auto standard_error = [&](const std::vector<double>& of) {
    const double middle = mean(of), scans = static_cast<double>(of.size());
    double squares = 0;
    for (std::size_t s = 0; s < of.size(); ++s) squares += square(points[s] * (of[s] - middle) / all);
    return std::sqrt(squares * scans / std::max(1.0, scans - 1));
  };
  const std::vector<double> best = choice.candidates[choice.best].scan_error;
  choice.best_uncertain = standard_error(best);
  for (Candidate& c : choice.candidates) {
    std::vector<double> excess = c.scan_error;
    for (std::size_t s = 0; s < best.size(); ++s) excess[s] -= best[s];
    c.worse = mean(excess), c.uncertain = standard_error(excess);
    c.told_apart = c.worse > std::max(std::min(c.uncertain, choice.best_uncertain), kNoMatter * mean(best));
  }
  const auto enough = std::find_if(choice.candidates.begin(), choice.candidates.end(),
                                   [](const Candidate& c) { return !c.told_apart; });
  choice.chosen = static_cast<std::size_t>(enough - choice.candidates.begin());
}

std::string sentence_of(const ModelChoice& choice) {
  const Candidate &best = choice.candidates[choice.best], &chosen = choice.candidates[choice.chosen];
  if (choice.best == choice.chosen)
    return fmt::format(
        "{} predicts left-out scans best (rms_log10 {:.3g}), and every cheaper model is worse by more than one "
        "standard error: the data need its {} parameters",
        name_of(chosen.result.model), chosen.held_out_log10, chosen.parameters);
  return fmt::format(
      "{} ({} parameters, held-out rms_log10 {:.3g}) is the simplest that these data cannot tell from the best, {} ({} "
      "parameters, {:.3g}): no more model than the data need",
      name_of(chosen.result.model), chosen.parameters, chosen.held_out_log10, name_of(best.result.model),
      best.parameters, best.held_out_log10);
}

}  // namespace

std::vector<ModelSpec> all_candidates(const Measurement& measurement) {
  const bool wavelength = !measurement.wavelengths().empty() || measurement.material_wavelength_nm;
  std::vector<ModelSpec> specs;
  for (const ModelInfo& info : models()) {
    if (info.id == ModelId::mirror || (info.needs_wavelength && !wavelength)) continue;
    ModelSpec spec;
    spec.id = info.id;
    const auto& names = info.shadowings;
    if (!names.empty() && std::find(names.begin(), names.end(), gonio::name_of(spec.shadowing)) == names.end())
      set_shadowing(spec, names.front());
    specs.push_back(spec);
    const bool diffuse =
        info.id == ModelId::lambert || info.id == ModelId::oren_nayar || info.id == ModelId::oren_nayar_qualitative;
    if (!diffuse) specs.push_back(spec), specs.back().retro = true;
  }
  return specs;
}

ModelChoice choose_model(const Measurement& measurement, const FitRequest& request, std::vector<ModelSpec> specs,
                         const std::function<void(const std::string&, int, int)>& progress) {
  if (measurement.incidences_deg.size() < 3)
    throw input_error("{}: too few incidence angles ({}); expected 3 or more to choose a model by leaving scans out",
                      measurement.id, measurement.incidences_deg.size());
  ModelChoice choice;
  choice.folds = static_cast<int>(std::min(kMostFolds, measurement.incidences_deg.size()));
  const auto cost = [](const ModelSpec& s) {
    return std::tuple(s.info().parameters.size(), s.info().needs_wavelength, s.retro);
  };
  std::stable_sort(specs.begin(), specs.end(), [&](auto& a, auto& b) { return cost(a) < cost(b); });

  const Measurement some = thinned(measurement);
  const std::vector<std::size_t> fold = folds_of(some, static_cast<std::size_t>(choice.folds));
  std::vector<Split> splits;
  for (int f = 0; f < choice.folds; ++f) splits.push_back(split(some, fold, static_cast<std::size_t>(f)));

  std::vector<int> count_of(measurement.incidences_deg.size() * kSectors, 0);
  for (const ScanPoint& p : some.points) count_of[scan_of(p)] += p.f_per_sr > 0;
  for (const int n : count_of)
    if (n > 0) choice.scan_points.push_back(n);

  for (const ModelSpec& spec : specs) {
    if (progress) progress(name_of(spec), static_cast<int>(choice.candidates.size()), static_cast<int>(specs.size()));
    FitRequest whole = request;
    whole.model = spec, whole.hold_out = HoldOut::none, whole.progress = {};
    if (has_own_scale(spec.info())) whole.held["ks"] = 1;
    Candidate candidate;
    candidate.result = fit(measurement, whole);
    candidate.parameters = free_parameters(candidate.result);
    std::vector<std::vector<double>> squares(splits.size(), std::vector<double>(count_of.size(), 0.0));
    tbb::parallel_for(std::size_t{0}, splits.size(), [&](std::size_t f) {
      FitRequest without = whole;
      without.begin = candidate.result.values(), without.starts = 1;
      without.floor_per_sr = candidate.result.floor_per_sr;
      add_errors(fit(splits[f].rest, without), splits[f].left_out, squares[f]);
    });
    for (std::size_t s = 0; s < count_of.size(); ++s) {
      if (count_of[s] == 0) continue;
      double sum = 0;
      for (const auto& of_fold : squares) sum += of_fold[s];
      candidate.scan_error.push_back(sum / count_of[s]);
    }
    information_criteria(candidate);
    choice.candidates.push_back(std::move(candidate));
  }
  compare(choice);
  choice.sentence = sentence_of(choice);
  return choice;
}

}  // namespace gonio
