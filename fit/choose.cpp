#include "fit/choose.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

#include "base/error.h"

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
  const std::vector<double> f = predict(fitted, points.points);
  const double floor = fitted.floor_per_sr;
  for (std::size_t i = 0; i < f.size(); ++i)
    if (const ScanPoint& p = points.points[i]; p.f_per_sr > 0)
      squares[scan_of(p)] += square(std::log10((f[i] + floor) / (p.f_per_sr + floor)));
}

/// Lobes with a factor of their own (A of the ABC laws), which does what ks does, keep ks = 1.
void hold_scales(FitRequest& request) {
  const LobeSum& model = request.model;
  for (std::size_t i = 0; i < model.parameters().size(); ++i) {
    if (!model.is_scale(i)) continue;
    const auto& own = model.lobes()[model.place(i).lobe].info().parameters;
    if (std::any_of(own.begin(), own.end(), [](auto& p) { return p.name == "a" && p.unit == "1/sr"; }))
      request.held[std::string(model.parameters()[i].name)] = 1;
  }
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

auto cost_of(const Candidate& c) {
  const auto& lobes = c.result.model.lobes();
  const bool retro = std::any_of(lobes.begin(), lobes.end(), [](const ModelSpec& lobe) { return lobe.retro; });
  return std::tuple(c.parameters, c.result.model.needs_wavelength(), retro);
}

double mean_over(const std::vector<int>& points, const std::vector<double>& of) {
  double sum = 0, all = 0;
  for (std::size_t s = 0; s < points.size(); ++s) sum += points[s] * of[s], all += points[s];
  return sum / all;
}

/// Of the mean of scans that count by their points.
double standard_error(const std::vector<int>& points, const std::vector<double>& of) {
  const double middle = mean_over(points, of), scans = static_cast<double>(of.size());
  double squares = 0, all = 0;
  for (std::size_t s = 0; s < of.size(); ++s) squares += square(points[s] * (of[s] - middle)), all += points[s];
  return std::sqrt(squares * scans / std::max(1.0, scans - 1)) / all;
}

/// Excess of each candidate over the best, scan by scan.
void compare(ModelChoice& choice) {
  const std::vector<int>& points = choice.scan_points;
  for (Candidate& c : choice.candidates) c.held_out_log10 = std::sqrt(mean_over(points, c.scan_error));
  const auto less = [](const Candidate& a, const Candidate& b) { return a.held_out_log10 < b.held_out_log10; };
  choice.best = static_cast<std::size_t>(std::min_element(choice.candidates.begin(), choice.candidates.end(), less) -
                                         choice.candidates.begin());
  const Candidate& best = choice.candidates[choice.best];
  choice.best_uncertain = standard_error(points, best.scan_error);
  const double no_matter = kNoMatter * mean_over(points, best.scan_error);
  for (Candidate& c : choice.candidates) {
    const Excess excess = excess_over(choice, c, best);
    c.worse = excess.mean, c.uncertain = excess.error;
    c.told_apart = c.worse > std::max(std::min(c.uncertain, choice.best_uncertain), no_matter);
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
        chosen.result.model.described(), chosen.held_out_log10, chosen.parameters);
  return fmt::format(
      "{} ({} parameters, held-out rms_log10 {:.3g}) is the simplest that these data cannot tell from the best, {} ({} "
      "parameters, {:.3g}): no more model than the data need",
      chosen.result.model.described(), chosen.parameters, chosen.held_out_log10, best.result.model.described(),
      best.parameters, best.held_out_log10);
}

}  // namespace

Excess excess_over(const ModelChoice& choice, const Candidate& worse, const Candidate& better) {
  std::vector<double> excess = worse.scan_error;
  for (std::size_t s = 0; s < excess.size(); ++s) excess[s] -= better.scan_error[s];
  return {mean_over(choice.scan_points, excess), standard_error(choice.scan_points, excess)};
}

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

namespace {

/// Judges one candidate after the other by leaving scans out.
class Judge {
 public:
  Judge(const Measurement& measurement, const FitRequest& request, std::size_t folds)
      : measurement_(measurement), request_(request), count_of_(measurement.incidences_deg.size() * kSectors, 0) {
    const Measurement some = thinned(measurement);
    const std::vector<std::size_t> fold = folds_of(some, folds);
    for (std::size_t f = 0; f < folds; ++f) splits_.push_back(split(some, fold, f));
    for (const ScanPoint& p : some.points) count_of_[scan_of(p)] += p.f_per_sr > 0;
  }

  std::vector<int> scan_points() const {
    std::vector<int> points;
    for (const int n : count_of_)
      if (n > 0) points.push_back(n);
    return points;
  }

  Candidate operator()(const LobeSum& model, const std::vector<double>& begin) const {
    FitRequest whole = request_;
    whole.model = model, whole.hold_out = HoldOut::none, whole.progress = {}, whole.begin = begin;
    hold_scales(whole);
    Candidate candidate;
    candidate.result = fit(measurement_, whole);
    candidate.parameters = free_parameters(candidate.result);
    std::vector<std::vector<double>> squares(splits_.size(), std::vector<double>(count_of_.size(), 0.0));
    tbb::parallel_for(std::size_t{0}, splits_.size(), [&](std::size_t f) {
      FitRequest without = whole;
      without.begin = candidate.result.values(), without.starts = 1;
      without.floor_per_sr = candidate.result.floor_per_sr, without.relative_sd = candidate.result.relative_sd;
      add_errors(fit(splits_[f].rest, without), splits_[f].left_out, squares[f]);
    });
    for (std::size_t s = 0; s < count_of_.size(); ++s) {
      if (count_of_[s] == 0) continue;
      double sum = 0;
      for (const auto& of_fold : squares) sum += of_fold[s];
      candidate.scan_error.push_back(sum / count_of_[s]);
    }
    information_criteria(candidate);
    return candidate;
  }

 private:
  const Measurement& measurement_;
  const FitRequest& request_;
  std::vector<Split> splits_;
  std::vector<int> count_of_;
};

/// The best candidates of a kind, best first.
std::vector<const Candidate*> best_of(const ModelChoice& choice, std::size_t most, auto&& wanted) {
  std::vector<const Candidate*> found;
  for (const Candidate& c : choice.candidates)
    if (wanted(c.result.model)) found.push_back(&c);
  std::stable_sort(found.begin(), found.end(), [&](const Candidate* a, const Candidate* b) {
    return mean_over(choice.scan_points, a->scan_error) < mean_over(choice.scan_points, b->scan_error);
  });
  if (found.size() > most) found.resize(most);
  return found;
}

/// A sum and where to begin: its parts' shapes as they were fitted alone, each with its share of their scale.
struct Start {
  LobeSum model;
  std::vector<double> begin;
};
Start sum_of(const Candidate& a, const Candidate& b) {
  std::vector<ModelSpec> lobes = a.result.model.lobes();
  lobes.insert(lobes.end(), b.result.model.lobes().begin(), b.result.model.lobes().end());
  Start start{LobeSum(lobes), {}};
  const std::size_t first = a.result.model.lobes().size();
  const std::vector<double> of_a = a.result.values(), of_b = b.result.values();
  for (std::size_t i = 0; i < start.model.parameters().size(); ++i) {
    const LobeSum::Place place = start.model.place(i);
    const bool in_a = place.lobe < first;
    const LobeSum& part = in_a ? a.result.model : b.result.model;
    double value = 0;
    for (std::size_t j = 0; j < part.parameters().size(); ++j)
      if (part.place(j).parameter == place.parameter && part.place(j).lobe == (in_a ? place.lobe : place.lobe - first))
        value = (in_a ? of_a : of_b)[j];
    start.begin.push_back(start.model.is_scale(i) || start.model.is_diffuse(i) ? 0.5 * value : value);
  }
  return start;
}

constexpr std::size_t kForward = 3, kTurnedBack = 2, kSumsContinued = 2;
constexpr std::size_t kMostShapes = 15;  ///< parameters of the parts of a sum that is tried

/// Pairs of the lobes that predict best alone, a lobe with another of its own kind too; of the best pairs then those with a third.
std::vector<Start> pairs(const ModelChoice& choice) {
  const auto plain = [](const LobeSum& m, bool retro) {
    return !m.is_sum() && m.first().id != ModelId::lambert && m.first().retro == retro;
  };
  std::vector<const Candidate*> parts = best_of(choice, kForward, [&](const LobeSum& m) { return plain(m, false); });
  for (const Candidate* c : best_of(choice, kTurnedBack, [&](const LobeSum& m) { return plain(m, true); }))
    parts.push_back(c);
  std::vector<Start> sums;
  for (std::size_t a = 0; a < parts.size(); ++a)
    for (std::size_t b = a; b < parts.size(); ++b)
      if (parts[a]->result.model.parameters().size() + parts[b]->result.model.parameters().size() <= kMostShapes)
        sums.push_back(sum_of(*parts[a], *parts[b]));
  return sums;
}
/// The lobes of a sum, in any order.
std::multiset<std::string> lobes_of(const LobeSum& model) {
  std::multiset<std::string> names;
  for (const ModelSpec& lobe : model.lobes()) names.insert(LobeSum(lobe).described());
  return names;
}

std::vector<Start> triples(const ModelChoice& choice) {
  const auto lobe = [](const LobeSum& m) { return !m.is_sum() && m.first().id != ModelId::lambert; };
  const auto two = best_of(choice, kSumsContinued, [](const LobeSum& m) { return m.lobes().size() == 2; });
  const auto one = best_of(choice, kForward, lobe);
  std::vector<Start> sums;
  std::set<std::multiset<std::string>> known;
  for (const Candidate* pair : two)
    for (const Candidate* third : one) {
      if (pair->result.model.parameters().size() + third->result.model.parameters().size() > kMostShapes) continue;
      const Start sum = sum_of(*pair, *third);
      if (known.insert(lobes_of(sum.model)).second) sums.push_back(sum);
    }
  return sums;
}

}  // namespace

ModelChoice choose_model(const Measurement& measurement, const FitRequest& request, std::vector<ModelSpec> specs,
                         const std::function<void(const std::string&, int, int)>& progress) {
  if (measurement.incidences_deg.size() < 3)
    throw input_error("{}: too few incidence angles ({}); expected 3 or more to choose a model by leaving scans out",
                      measurement.id, measurement.incidences_deg.size());
  ModelChoice choice;
  choice.folds = static_cast<int>(std::min(kMostFolds, measurement.incidences_deg.size()));
  const Judge judge(measurement, request, static_cast<std::size_t>(choice.folds));
  choice.scan_points = judge.scan_points();
  std::vector<Start> starts;
  for (const ModelSpec& spec : specs) starts.push_back({spec, {}});
  const auto try_all = [&] {
    const std::size_t count = choice.candidates.size() + starts.size();
    for (const Start& start : starts) {
      if (progress) progress(start.model.name(), static_cast<int>(choice.candidates.size()), static_cast<int>(count));
      choice.candidates.push_back(judge(start.model, start.begin));
    }
  };
  try_all();
  if (specs.size() > 1 && request.sums) {
    starts = pairs(choice);
    try_all();
    starts = triples(choice);
    try_all();
  }
  std::stable_sort(choice.candidates.begin(), choice.candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return cost_of(a) < cost_of(b); });
  compare(choice);
  choice.sentence = sentence_of(choice);
  return choice;
}

}  // namespace gonio
