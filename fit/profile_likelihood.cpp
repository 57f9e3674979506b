#include "fit/profile_likelihood.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <optional>

#include "fit/uncertainty.h"

namespace gonio {
namespace {

constexpr double kFirstStep = 0.1;  // of a logarithm, where no standard error is known
constexpr double kFound = 1e-6;     // of the bound
constexpr int kMostDoublings = 60, kMostSteps = 60;

/// The least cost with one free parameter held, as a function of its logarithm.
class Profile {
 public:
  Profile(const FitProblem& problem, std::size_t held) : problem_(problem), held_(held) {
    if (!problem.free[held].linear) return;
    taken_out_ = true, place_ = problem.free[held].place;
    problem_.free.erase(problem_.free.begin() + static_cast<std::ptrdiff_t>(held));
  }

  /// `others` holds the free parameters (the held one among them) to start from, and then those that were found.
  double cost(double log_value, std::vector<double>& others) {
    others[held_] = log_value;
    return taken_out_ ? cost_without(log_value, others) : cost_in_box(log_value, others);
  }

 private:
  double cost_in_box(double log_value, std::vector<double>& others) {
    problem_.free[held_].lo = problem_.free[held_].hi = std::exp(log_value);
    Solution found = solve(problem_, others);
    others = std::move(found.x), others[held_] = log_value;
    return found.cost;
  }

  double cost_without(double log_value, std::vector<double>& others) {
    problem_.values[place_] = std::exp(log_value);
    const auto at = static_cast<std::ptrdiff_t>(held_);
    std::vector<double> x = others;
    x.erase(x.begin() + at);
    Solution found = solve(problem_, std::move(x));
    others = std::move(found.x);
    others.insert(others.begin() + at, log_value);
    return found.cost;
  }

  FitProblem problem_;
  std::size_t held_, place_ = 0;
  bool taken_out_ = false;
};

/// One end of an interval, as a logarithm.
struct End {
  double at = 0;
  bool open = false, known = false;
};

/// How far a profile has risen, in standard deviations: sqrt(2 (cost - least)/variance), linear in a linear problem.
struct Rise {
  double least, variance;
  double operator()(double cost) const { return std::sqrt(2 * std::max(0.0, cost - least) / variance); }
};

/// The crossing of `bound` between two logarithms, by regula falsi (Illinois: an end that stays loses half its weight).
End crossing(Profile& profile, const Rise& rise, double bound, std::vector<double> others, double inside,
             double rise_inside, double outside, double rise_outside) {
  double below = rise_inside - bound, above = rise_outside - bound;
  int stayed = 0;
  for (int step = 0; step < kMostSteps; ++step) {
    const double at = inside + (outside - inside) * below / (below - above);
    const double cost = profile.cost(at, others);
    if (!std::isfinite(cost)) return {};
    const double excess = rise(cost) - bound;
    if (std::abs(excess) <= kFound * bound) return {at, false, true};
    if (excess < 0) {
      inside = at, below = excess, above *= stayed < 0 ? 0.5 : 1, stayed = -1;
    } else {
      outside = at, above = excess, below *= stayed > 0 ? 0.5 : 1, stayed = 1;
    }
  }
  return {0.5 * (inside + outside), false, true};
}

/// Steps outwards from the minimum, each twice the last, until the bound is passed or the box ends.
End find_end(Profile& profile, const Rise& rise, double bound, std::vector<double> x, std::size_t place, double step,
             double box_end) {
  double inside = x[place], rise_inside = 0;
  if (inside == box_end) return {box_end, true, true};
  const double direction = box_end < inside ? -1 : 1;
  std::vector<double> others = x;
  for (int doubling = 0; doubling < kMostDoublings; ++doubling, step *= 2) {
    const double room = std::abs(box_end - inside);
    const double outside = step >= room ? box_end : inside + direction * step;
    const double cost = profile.cost(outside, others);
    if (!std::isfinite(cost)) return {};
    const double rise_outside = rise(cost);
    if (rise_outside >= bound)
      return crossing(profile, rise, bound, others, inside, rise_inside, outside, rise_outside);
    if (outside == box_end) return {box_end, true, true};
    inside = outside, rise_inside = rise_outside;
  }
  return {};
}

ProfileInterval interval_of(const FitProblem& problem, const Solution& solution, const Uncertainty& errors,
                            const Rise& rise, std::size_t place) {
  const FreeParameter& box = problem.free[place];
  if (box.linear && box.group != FreeParameter::kShared) return {};
  const double error = errors.standard_error[place], bound = errors.t95;
  const double step = std::isfinite(error) && error > 0 ? bound * error : kFirstStep;
  Profile profile(problem, place);
  const End lo = find_end(profile, rise, bound, solution.x, place, step, std::log(box.lo));
  const End hi = find_end(profile, rise, bound, solution.x, place, step, std::log(box.hi));
  if (!lo.known || !hi.known) return {};
  return {std::exp(lo.at), std::exp(hi.at), lo.open, hi.open, true};
}

}  // namespace

std::vector<ProfileInterval> profile_intervals(const FitProblem& problem, const Solution& solution) {
  std::vector<ProfileInterval> intervals(problem.free.size());
  const Uncertainty errors = uncertainty(problem, solution);
  const auto inside = std::count(errors.at_bound.begin(), errors.at_bound.end(), false);
  const double freedom = static_cast<double>(problem.points.size()) - static_cast<double>(inside);
  if (!(freedom > 0) || !(errors.t95 > 0)) return intervals;
  const Rise rise{solution.cost, residual_variance(problem, solution, freedom)};
  tbb::parallel_for(std::size_t(0), intervals.size(),
                    [&](std::size_t place) { intervals[place] = interval_of(problem, solution, errors, rise, place); });
  return intervals;
}

void use_profile_intervals(const FitProblem& problem, const Solution& solution, FitResult& result) {
  const std::vector<ProfileInterval> intervals = profile_intervals(problem, solution);
  for (std::size_t i = 0; i < intervals.size(); ++i) {
    if (!intervals[i].known) continue;
    for (FittedParameter& p : result.parameters)
      if (p.name == problem.free[i].name) {
        p.lo95 = intervals[i].lo, p.hi95 = intervals[i].hi, p.interval95_kind = "profile";
        p.lo_open = intervals[i].lo_open, p.hi_open = intervals[i].hi_open;
      }
  }
}

}  // namespace gonio
