#include "fit/start.h"

#include <algorithm>
#include <boost/random/sobol.hpp>
#include <cmath>
#include <limits>

namespace gonio {
namespace {

constexpr int kGridPoints = 15;  // along a line through the box
constexpr int kMostRounds = 4;

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

std::vector<double> improve_start(const LaneFit& fit, std::vector<double> x) {
  const FitProblem& problem = fit.problem();
  std::vector<std::size_t> searched;
  for (std::size_t i = 0; i < problem.free.size(); ++i)
    if (!problem.free[i].linear) searched.push_back(i);
  std::vector<std::vector<std::size_t>> directions;
  for (const std::size_t i : searched) directions.push_back({i});
  if (searched.size() > 1) directions.push_back(searched);

  double best = fit.eliminate(x);
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
        const double cost = fit.eliminate(tried);
        if (cost < best) best = cost, x = tried;
      }
    }
    if (!(best < before)) break;
  }
  return x;
}

}  // namespace gonio
