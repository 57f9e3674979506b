#include "fit/fit.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <set>

#include "base/error.h"
#include "fit/fitted_material.h"
#include "fit/prepare.h"
#include "fit/profile_likelihood.h"
#include "fit/scan_traps.h"
#include "fit/solver.h"
#include "fit/start.h"
#include "fit/uncertainty.h"
#include "fit/verdict.h"

namespace gonio {
namespace {

/// Points of a scan that show a start its way, and points on which the starts are solved first where a scan has many more.
constexpr std::size_t kFewPoints = 192, kSomePoints = 3000;
constexpr double kWorthSolving =
    3;  ///< costs of starts on some of the points, over the least, from which on they are dropped
constexpr double kTooLarge = 2;         ///< reduced chi² from which on the fit says so
constexpr std::size_t kMostSolved = 3;  ///< different minima among them that are solved on all points

/// The logarithms of given values, inside their boxes (n, which is none of the model's, in the middle of its own).
std::vector<double> given_start(const FitProblem& problem, const std::vector<double>& values) {
  std::vector<double> x;
  for (const FreeParameter& p : problem.free) {
    const double value = p.place < values.size() ? values[p.place] : std::sqrt(p.lo * p.hi);
    x.push_back(std::log(std::clamp(value, p.lo, p.hi)));
  }
  return x;
}

/// Every start solved; starts share nothing, so that neither their number nor the threads change any of them.
std::vector<Solution> solve_starts(const LaneFit& few, const LaneFit& points, const FitRequest& request) {
  const int count = request.starts + (request.begin.empty() ? 0 : 1);
  std::vector<Solution> solutions(static_cast<std::size_t>(count));
  std::mutex mutex;
  int done = 0;
  tbb::parallel_for(0, count, [&](int start) {
    const std::vector<double> x = start < request.starts
                                      ? improve_start(few, start_point(few.problem(), start, request.seed))
                                      : given_start(few.problem(), request.begin);
    solutions[static_cast<std::size_t>(start)] = points.solve(x, kSearch);
    const std::lock_guard lock(mutex);
    ++done;
    if (request.progress) request.progress(done, count);
  });
  return solutions;
}

/// Solutions of all points: where there are many, some of them decide which starts are worth it.
std::vector<Solution> solve_all(const LaneFit& all, const FitRequest& request) {
  const FitProblem& problem = all.problem();
  const LaneFit few(problem, thinned_points(problem, kFewPoints));
  if (problem.points.size() <= 2 * kSomePoints) return solve_starts(few, all, request);
  const LaneFit some(problem, thinned_points(problem, kSomePoints));
  std::vector<Solution> solutions = solve_starts(few, some, request);
  std::stable_sort(solutions.begin(), solutions.end(), [](auto& a, auto& b) { return a.cost < b.cost; });
  std::vector<Solution> different;
  for (Solution& s : solutions) {
    const bool known = std::any_of(different.begin(), different.end(), [&](const Solution& d) {
      return std::abs(s.cost - d.cost) <= 1e-6 * s.cost + 1e-18 * static_cast<double>(kSomePoints);
    });
    if (known || different.size() == kMostSolved || !(s.cost <= kWorthSolving * solutions[0].cost)) continue;
    different.push_back(s);
  }
  for (Solution& d : different) d = all.solve(d.x, kSearch);
  // A start that ended where another did shares its solution.
  for (Solution& s : solutions) {
    const auto same = std::min_element(different.begin(), different.end(), [&](auto& a, auto& b) {
      return std::abs(a.cost - s.cost) < std::abs(b.cost - s.cost);
    });
    if (same != different.end() && s.converged) {
      const int rejected = s.rejected;
      s = *same, s.rejected += rejected;
    }
  }
  return solutions;
}

const Solution& best_of(const std::vector<Solution>& solutions) {
  const auto better = [](const Solution& a, const Solution& b) {
    if (a.converged != b.converged) return a.converged;
    return std::isfinite(a.cost) && (a.cost < b.cost || !std::isfinite(b.cost));
  };
  return *std::min_element(solutions.begin(), solutions.end(), better);
}

Solution polished(const LaneFit& all, const Solution& found) {
  Solution better = all.solve(found.x, kPolish);
  return better.converged && better.cost <= found.cost ? better : found;
}

/// Minima are told apart by their cost: along an undetermined direction one minimum has many parameters.
int count_minima(const std::vector<Solution>& solutions, std::size_t points) {
  std::vector<double> costs;
  for (const Solution& s : solutions)
    if (s.converged) costs.push_back(s.cost);
  std::sort(costs.begin(), costs.end());
  int minima = 0;
  double last = -1;
  for (const double cost : costs) {
    if (last < 0 || cost - last > 1e-6 * cost + 1e-18 * static_cast<double>(points)) ++minima;
    last = cost;
  }
  return minima;
}

/// Parameters that a solution has without them: kd or ks of 0, at a place and of a wavelength.
using AtZero = std::vector<FreeParameter>;

/// kd or ks that ran to the lower end of the logarithmic box: 0 itself is tried, and kept where it is no worse.
AtZero try_zero(FitProblem& problem, Solution& solution) {
  AtZero zero;
  for (std::size_t i = 0; i < problem.free.size() && problem.free.size() > 1;) {
    const FreeParameter parameter = problem.free[i];
    if (!parameter.linear || solution.x[i] > std::log(parameter.lo) + 1e-9) {
      ++i;
      continue;
    }
    FitProblem without = problem;
    without.values[parameter.place] = 0;
    without.free.erase(without.free.begin() + static_cast<std::ptrdiff_t>(i));
    std::vector<double> x = solution.x;
    x.erase(x.begin() + static_cast<std::ptrdiff_t>(i));
    Solution next = solve(without, std::move(x));
    const double rounding = 1e-12 * solution.cost + 1e-24 * static_cast<double>(problem.points.size());
    if (!next.converged || !(next.cost <= solution.cost + rounding)) {
      ++i;
      continue;
    }
    problem = std::move(without);
    solution = std::move(next);
    zero.push_back(parameter);
  }
  return zero;
}

/// Lobes of the same kind are interchangeable: the narrower first (the one with the smaller first parameter).
void order_lobes(const FitProblem& problem, std::vector<double>& x) {
  const LobeSum& model = problem.model;
  const auto same = [](const ModelSpec& a, const ModelSpec& b) {
    return a.id == b.id && a.shadowing == b.shadowing && a.form == b.form && a.retro == b.retro;
  };
  const auto of_lobe = [&](std::size_t lobe) {  // places in x by own parameter and wavelength
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> places;
    for (std::size_t i = 0; i < problem.free.size(); ++i) {
      const std::size_t place = problem.free[i].place;
      if (problem.free[i].of_surface() || model.is_diffuse(place) || model.place(place).lobe != lobe) continue;
      places.emplace(std::pair(model.place(place).parameter, problem.free[i].group), i);
    }
    return places;
  };
  for (std::size_t pass = 1; pass < model.lobes().size(); ++pass)
    for (std::size_t a = 0; a + 1 < model.lobes().size(); ++a) {
      if (!same(model.lobes()[a], model.lobes()[a + 1])) continue;
      const auto here = of_lobe(a), next = of_lobe(a + 1);
      const auto keys = [](const auto& one, const auto& other) { return one.first == other.first; };
      const bool alike = std::equal(here.begin(), here.end(), next.begin(), next.end(), keys);
      if (!alike || here.empty() || here.begin()->first.first != 0) continue;  // one of them is held
      if (x[here.begin()->second] <= x[next.begin()->second]) continue;
      for (auto i = here.begin(), j = next.begin(); i != here.end(); ++i, ++j) std::swap(x[i->second], x[j->second]);
    }
}

/// Widths at which the losses lose 5 % of the efficiency of least squares where errors are normal.
constexpr double kHuber = 1.345, kCauchy = 2.385;

/// The loss and its width: as asked for, or from the residuals' spread (1.4826 times their median size) in a fit of Huber's kind that
/// begins with the spread of a plain one.
void set_loss(FitProblem& problem, const FitRequest& request, FitResult& result) {
  const double wide = request.loss == Loss::huber ? kHuber : kCauchy;
  double width = request.loss_width;
  if (!(width > 0)) {
    FitRequest plain = request;
    plain.starts = std::min(request.starts, 4), plain.progress = {};
    for (int round = 0; round < 3; ++round) {
      const LaneFit all(problem, every_point(problem));
      const Solution best = best_of(solve_all(all, plain));
      Eigen::VectorXd size = all.linearise(best.x).residual.cwiseAbs();
      std::nth_element(size.begin(), size.begin() + size.size() / 2, size.end());
      problem.loss = request.loss;
      problem.loss_width = std::max(wide * 1.4826 * size[size.size() / 2], 1e-12);
    }
    width = problem.loss_width;
  }
  problem.loss = result.loss = request.loss;
  problem.loss_width = result.loss_width = width;
}

FittedParameter from_box(const ParameterInfo& info, double value) {
  FittedParameter p;
  p.name = info.name, p.unit = info.unit, p.value = p.lo95 = p.hi95 = value;
  return p;
}

FittedParameter free_parameter(const FitProblem& problem, const Solution& solution, const Uncertainty& errors,
                               std::size_t i) {
  const FreeParameter& box = problem.free[i];
  FittedParameter p;
  p.name = box.of_surface() ? box.name : std::string(problem.model.parameters()[box.place].name);
  p.unit = box.unit, p.group = box.group, p.value = std::exp(solution.x[i]);
  p.at_bound = errors.at_bound[i], p.identifiable = errors.identifiable[i];
  p.lo95 = box.lo, p.hi95 = box.hi;
  const double log_error = errors.standard_error[i];
  if (std::isfinite(log_error)) {
    p.standard_error = p.value * log_error;
    p.lo95 = p.value * std::exp(-errors.t95 * log_error), p.hi95 = p.value * std::exp(errors.t95 * log_error);
  }
  return p;
}

FittedParameter zero_parameter(const FitProblem& problem, const FreeParameter& box) {
  const ParameterInfo& info = problem.model.parameters()[box.place];
  FittedParameter p = from_box(info, 0);
  p.at_bound = true, p.group = box.group, p.hi95 = info.fit_lo;
  return p;
}

void store_parameters(const FitProblem& problem, const Solution& solution, const Uncertainty& errors,
                      const AtZero& at_zero, FitResult& result) {
  const auto& infos = problem.model.parameters();
  std::vector<std::vector<FittedParameter>> fitted(infos.size());
  std::vector<FittedParameter> of_surface;
  for (std::size_t i = 0; i < problem.free.size(); ++i) {
    const FreeParameter& box = problem.free[i];
    const FittedParameter p = free_parameter(problem, solution, errors, i);
    if (p.at_bound) result.warnings.push_back(fmt::format("{} is at the bound of its box ({:.6g})", box.name, p.value));
    if (box.of_surface())
      of_surface.push_back(p);
    else
      fitted[box.place].push_back(p);
  }
  for (const FreeParameter& box : at_zero) {
    fitted[box.place].push_back(zero_parameter(problem, box));
    result.warnings.push_back(fmt::format("{} is at its bound, 0", box.name));
  }
  for (std::size_t i = 0; i < infos.size(); ++i) {
    if (fitted[i].empty()) fitted[i].push_back(from_box(infos[i], problem.values[i])), fitted[i].back().held = true;
    std::stable_sort(fitted[i].begin(), fitted[i].end(), [](auto& a, auto& b) { return a.group < b.group; });
    result.parameters.insert(result.parameters.end(), fitted[i].begin(), fitted[i].end());
  }
  result.parameters.insert(result.parameters.end(), of_surface.begin(), of_surface.end());
}

void store_correlation(const FitProblem& problem, const Uncertainty& errors, FitResult& result) {
  const auto count = static_cast<Eigen::Index>(problem.free.size());
  for (const FreeParameter& box : problem.free) result.correlation_names.push_back(box.name);
  for (Eigen::Index i = 0; i < count; ++i) {
    result.correlation.emplace_back();
    for (Eigen::Index j = 0; j < count; ++j) result.correlation.back().push_back(errors.correlation(i, j));
  }
  result.condition = errors.condition;
  result.warnings.insert(result.warnings.end(), errors.warnings.begin(), errors.warnings.end());
}

void store_points(const Measurement& scan, const Prepared& ready, const FitProblem& problem,
                  const std::vector<double>& x, FitResult& result) {
  const std::vector<double> fitted = problem.predict(x, ready.points);
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const ScanPoint& p = scan.points[i];
    result.points.push_back({p.theta_i_deg, p.theta_o_deg, p.phi_deg(), p.wavelength_nm, p.f_per_sr, fitted[i],
                             p.incidence, ready.used[i], ready.held_out[i]});
  }
  result.incidences_binned = scan.incidences_binned;
  for (const double theta_i_deg : scan.incidences_deg) {
    result.by_incidence.emplace_back();
    result.by_incidence.back().theta_i_deg = theta_i_deg;
  }
}

}  // namespace

const FittedParameter* FitResult::find(std::string_view parameter) const {
  const auto at = std::find_if(parameters.begin(), parameters.end(), [&](auto& p) { return p.name == parameter; });
  return at == parameters.end() ? nullptr : &*at;
}

double FitResult::value(std::string_view parameter) const {
  if (const FittedParameter* p = find(parameter)) return p->value;
  throw input_error("{}: no parameter of this fit of {}", parameter, model.name());
}

std::vector<double> FitResult::by_wavelength(std::string_view parameter) const {
  std::vector<double> all;
  for (const FittedParameter& p : parameters)
    if (p.name == parameter) all.push_back(p.value);
  return all;
}

std::vector<double> FitResult::values() const {
  std::vector<double> all;
  for (const ParameterInfo& p : model.parameters()) all.push_back(value(p.name));
  return all;
}

std::optional<double> FitResult::of_surface(std::string_view name) const {
  // A model's own parameter may have the name, too (Phong's exponent n): it is not freed then.
  const auto& own = model.parameters();
  if (std::any_of(own.begin(), own.end(), [&](const ParameterInfo& p) { return p.name == name; })) return std::nullopt;
  const FittedParameter* found = find(name);
  return found ? std::optional(found->value) : std::nullopt;
}

double FitResult::evaluated_at_nm(double stated_nm) const {
  return std::isnan(stated_nm) ? assumed_wavelength_nm.value_or(1000) : stated_nm;
}

FitResult fit(const Measurement& measurement, const FitRequest& request) {
  if (request.starts < (request.begin.empty() ? 1 : 0))
    throw input_error("starts {}: too few; expected 1 or more", request.starts);
  FitResult result;
  Prepared ready = prepare(measurement, request, result);
  if (request.loss != Loss::none) set_loss(ready.problem, request, result);
  const LaneFit all(ready.problem, every_point(ready.problem));
  const std::vector<Solution> solutions = solve_all(all, request);
  Solution best = polished(all, best_of(solutions));
  result.starts = static_cast<int>(solutions.size());
  result.starts_converged =
      static_cast<int>(std::count_if(solutions.begin(), solutions.end(), [](auto& s) { return s.converged; }));
  result.distinct_minima = count_minima(solutions, ready.problem.points.size());
  for (const Solution& s : solutions) result.refused_evaluations += s.rejected;
  result.converged = best.converged;

  const AtZero at_zero = try_zero(ready.problem, best);
  order_lobes(ready.problem, best.x);
  const Uncertainty errors = uncertainty(ready.problem, best);
  store_parameters(ready.problem, best, errors, at_zero, result);
  if (request.profile_intervals) use_profile_intervals(ready.problem, best, result);
  result.next_measurement = advice(ready.problem, best, errors);
  store_correlation(ready.problem, errors, result);
  if (result.metric == Metric::likelihood && errors.freedom > 0) {
    result.chi2_reduced = 2 * best.cost / errors.freedom;
    if (*result.chi2_reduced > kTooLarge)
      result.warnings.push_back(
          fmt::format("residuals are {:.2g} times their standard deviations (reduced chi² {:.3g}; 1 where model and "
                      "deviations are right): intervals are widened by as much",
                      std::sqrt(*result.chi2_reduced), *result.chi2_reduced));
  }
  store_points(measurement, ready, ready.problem, best.x, result);
  judge(ready, result);
  warn_of_traps(measurement, result);
  if (!result.converged) result.warnings.push_back("no start converged: the values are those of the best one");
  if (result.refused_evaluations > 0)
    result.warnings.push_back(fmt::format("{} evaluations were not finite and refused", result.refused_evaluations));
  return result;
}

std::vector<double> predict(const FitResult& result, double theta_i_deg, std::span<const double> theta_o_deg,
                            double phi_deg) {
  const FittedMaterial material = fitted_material(result);
  const std::optional<double> nm =
      result.wavelength_nm.empty() ? material.wavelength({}) : result.wavelength_nm.front();
  const LobesOnSurface at = material.at(nm);
  const std::vector<ApertureNode> aperture = aperture_nodes(result.aperture);
  std::vector<double> f;
  for (const double theta : theta_o_deg)
    f.push_back(
        seen(at.lobes, directions_from_deg(theta_i_deg, theta, phi_deg), at.surface, at.wavelength_um, aperture));
  return f;
}

std::vector<double> predict(const FitResult& result, std::span<const ScanPoint> points) {
  const FittedMaterial material = fitted_material(result);
  const std::vector<ApertureNode> aperture = aperture_nodes(result.aperture);
  std::map<double, LobesOnSurface> known;
  std::vector<double> f;
  for (const ScanPoint& p : points) {
    const double nm = result.evaluated_at_nm(p.wavelength_nm);
    if (!known.contains(nm)) known.emplace(nm, material.at(nm));
    const LobesOnSurface& at = known.at(nm);
    const Directions<double> w = directions_from_deg(p.theta_i_deg, p.theta_o_deg, p.phi_deg(), p.phi_i_deg);
    f.push_back(seen(at.lobes, w, at.surface, at.wavelength_um, aperture));
  }
  return f;
}

}  // namespace gonio
