#include "fit/start.h"

#include <algorithm>
#include <array>
#include <boost/random/sobol.hpp>
#include <cmath>
#include <limits>

namespace gonio {
namespace {

constexpr int kGridPoints = 15;  // along a line through the box
constexpr int kMostRounds = 4;
constexpr int kMostSteps = 20;  // of the two-parameter fit

/// Σ c_j·basis_j + offset against the data: the model with its roughness held.
struct LinearPart {
  std::vector<std::size_t> free;           ///< which of the free parameters are linear (none, one or two)
  std::vector<std::vector<double>> basis;  ///< one column each
  std::vector<double> measured;            ///< ψ of the measured values
  std::vector<double> offset;              ///< what kd or ks held constant contributes
};

LinearPart linear_part(const FitProblem& problem, std::span<const double> x) {
  LinearPart part;
  double kd = 0, ks = 0;
  const auto& parameters = problem.model.info().parameters;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (!parameters[i].linear) continue;
    const bool diffuse = parameters[i].name == "kd";
    const auto at = std::find_if(problem.free.begin(), problem.free.end(), [&](auto& f) { return f.place == i; });
    if (at == problem.free.end()) {
      (diffuse ? kd : ks) = problem.values[i];
    } else {
      part.free.push_back(static_cast<std::size_t>(at - problem.free.begin()));
      part.basis.push_back(problem.part(x, diffuse ? 1 : 0, diffuse ? 0 : 1));
    }
  }
  for (const FitPoint& point : problem.points) part.measured.push_back(problem.compared(point.f_per_sr, point));
  part.offset = kd != 0 || ks != 0 ? problem.part(x, kd, ks) : std::vector<double>(problem.points.size(), 0.0);
  return part;
}

/// Two numbers, of which an absent one is 0, and their symmetric matrix: small enough to be written out.
using Pair = std::array<double, 2>;
struct Normal {
  double aa = 0, ab = 0, bb = 0;
  Pair ya{0, 0};  ///< right-hand side

  void add(const Pair& row, double value) {
    aa += row[0] * row[0], ab += row[0] * row[1], bb += row[1] * row[1];
    ya[0] += row[0] * value, ya[1] += row[1] * value;
  }
  /// Solution with the diagonal grown by `damping`; a column of zeros gives 0.
  Pair solved(double damping) const {
    const double a = aa * (1 + damping), b = bb * (1 + damping), determinant = a * b - ab * ab;
    if (!(b > 0)) return {a > 0 ? ya[0] / a : 0, 0};
    if (!(a > 0)) return {0, ya[1] / b};
    if (!(determinant > 1e-14 * a * b)) return {ya[0] / a, 0};
    return {(b * ya[0] - ab * ya[1]) / determinant, (a * ya[1] - ab * ya[0]) / determinant};
  }
};

/// Non-negative least squares of the weighted columns: both, or the better one alone.
Pair linear_guess(const FitProblem& problem, const LinearPart& part) {
  Normal normal;
  for (std::size_t p = 0; p < problem.points.size(); ++p) {
    const FitPoint& point = problem.points[p];
    const double slope = problem.compared_slope(std::max(std::abs(point.f_per_sr), 1e-12), point);
    Pair row{0, 0};
    for (std::size_t j = 0; j < part.free.size(); ++j) row[j] = slope * part.basis[j][p];
    normal.add(row, slope * (point.f_per_sr - part.offset[p]));
  }
  const Pair both = normal.solved(0);
  if (both[0] >= 0 && both[1] >= 0) return both;
  const Pair alone{normal.aa > 0 ? std::max(0.0, normal.ya[0] / normal.aa) : 0,
                   normal.bb > 0 ? std::max(0.0, normal.ya[1] / normal.bb) : 0};
  return alone[0] * normal.ya[0] >= alone[1] * normal.ya[1] ? Pair{alone[0], 0} : Pair{0, alone[1]};
}

/// ½ Σ residual² over the logarithms c of the linear parameters and, unless null, what its Gauss-Newton step needs.
double cost_at(const FitProblem& problem, const LinearPart& part, const Pair& c, Normal* normal) {
  const Pair scale{std::exp(c[0]), std::exp(c[1])};
  double cost = 0;
  for (std::size_t p = 0; p < problem.points.size(); ++p) {
    const FitPoint& point = problem.points[p];
    double f = part.offset[p];
    Pair row{0, 0};
    for (std::size_t j = 0; j < part.free.size(); ++j) f += row[j] = scale[j] * part.basis[j][p];
    const double residual = problem.compared(f, point) - part.measured[p];
    cost += 0.5 * residual * residual;
    if (!normal) continue;
    const double slope = problem.compared_slope(f, point);
    normal->add({slope * row[0], slope * row[1]}, -residual);
  }
  return std::isfinite(cost) ? cost : std::numeric_limits<double>::infinity();
}

/// Levenberg-Marquardt over one or two logarithms, clamped to their boxes.
double refine(const FitProblem& problem, const LinearPart& part, Pair& c) {
  Normal normal;
  double cost = cost_at(problem, part, c, &normal), damping = 1e-3;
  for (int step = 0; step < kMostSteps && std::isfinite(cost) && damping < 1e6; ++step) {
    const Pair change = normal.solved(damping);
    Pair next = c;
    for (std::size_t j = 0; j < part.free.size(); ++j) {
      const FreeParameter& box = problem.free[part.free[j]];
      next[j] = std::clamp(c[j] + std::clamp(change[j], -3.0, 3.0), std::log(box.lo), std::log(box.hi));
    }
    Normal next_normal;
    const double tried = cost_at(problem, part, next, &next_normal);
    if (!(tried < cost)) {
      damping *= 10;
      continue;
    }
    const bool settled = cost - tried < 1e-5 * cost;
    c = next, cost = tried, normal = next_normal, damping *= 0.1;
    if (settled) break;
  }
  return cost;
}

}  // namespace

std::vector<double> start_point(const FitProblem& problem, int index, std::uint64_t seed) {
  std::vector<double> x;
  if (problem.free.empty()) return x;
  boost::random::sobol engine(problem.free.size());
  engine.discard((1 + static_cast<std::uint64_t>(index) + 4096 * (seed % 4096)) * problem.free.size());
  for (const FreeParameter& box : problem.free) {
    const double u = static_cast<double>(engine()) / static_cast<double>(engine.max());
    x.push_back(std::log(box.lo) + (0.1 + 0.8 * u) * (std::log(box.hi) - std::log(box.lo)));
  }
  return x;
}

double eliminate_linear(const FitProblem& problem, std::vector<double>& x) {
  const LinearPart part = linear_part(problem, x);
  const Pair guess = linear_guess(problem, part);
  Pair c{0, 0};
  for (std::size_t j = 0; j < part.free.size(); ++j) {
    const FreeParameter& box = problem.free[part.free[j]];
    c[j] = std::log(std::clamp(guess[j], box.lo, box.hi));
  }
  const double cost = part.free.empty() ? cost_at(problem, part, c, nullptr) : refine(problem, part, c);
  for (std::size_t j = 0; j < part.free.size(); ++j) x[part.free[j]] = c[j];
  return cost;
}

std::vector<double> improve_start(const FitProblem& problem, std::vector<double> x) {
  std::vector<std::size_t> searched;
  for (std::size_t i = 0; i < problem.free.size(); ++i)
    if (!problem.free[i].linear) searched.push_back(i);
  std::vector<std::vector<std::size_t>> directions;
  for (const std::size_t i : searched) directions.push_back({i});
  if (searched.size() > 1) directions.push_back(searched);

  double best = eliminate_linear(problem, x);
  for (int round = 0; round < kMostRounds; ++round) {
    const double before = best;
    for (const auto& direction : directions) {
      double down = std::numeric_limits<double>::infinity(), up = down;
      for (const std::size_t i : direction) {
        down = std::min(down, x[i] - std::log(problem.free[i].lo));
        up = std::min(up, std::log(problem.free[i].hi) - x[i]);
      }
      const std::vector<double> middle = x;
      for (int at = 0; at < kGridPoints; ++at) {
        std::vector<double> tried = middle;
        for (const std::size_t i : direction) tried[i] += -down + (down + up) * (at + 0.5) / kGridPoints;
        const double cost = eliminate_linear(problem, tried);
        if (cost < best) best = cost, x = tried;
      }
    }
    if (!(best < before)) break;
  }
  return x;
}

}  // namespace gonio
