#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "assess/fit_speed.h"
#include "assess/fit_stability.h"
#include "fit/gnuplot.h"
#include "fit/prepare.h"
#include "fit/start.h"

namespace gonio {
namespace {

/// Ends of one minimum: costs and, near the least cost, places equal to this.
constexpr double kSameCost = 1e-3, kSamePlace = 0.03, kNearLeast = 1.01;

struct Setting {
  FitProblem problem;
  std::size_t first, second;  ///< the free parameters of the axes
};

Setting setting_of(const std::string& name) {
  FitRequest request;
  request.model = lobe_sum(name), request.material = "Au", request.hold_out = HoldOut::none;
  const std::vector<double> truth = typical_values(request.model.first().info());
  FitResult result;
  const Measurement scan = filled(planned_scan({}), request.model.first(), truth, "Au", 0.02, 1);
  return {prepare(scan, request, result).problem, 0, 1};
}

MapAxis axis_of(const FreeParameter& p) {
  return {"log₁₀ " + gnuplot_text(p.name), std::log10(p.lo), std::log10(p.hi)};
}

struct End {
  Solution solution;
  int minimum = -1;
};

bool same(const Setting& setting, const Solution& a, const Solution& b, double least) {
  if (std::abs(a.cost - b.cost) > kSameCost * std::min(a.cost, b.cost)) return false;
  if (a.cost > kNearLeast * least) return true;
  for (const std::size_t i : {setting.first, setting.second})
    if (std::abs(a.x[i] - b.x[i]) > kSamePlace) return false;
  return true;
}

/// Numbers the minima by their cost; returns one end of each.
std::vector<Solution> numbered(const Setting& setting, std::vector<End>& ends) {
  std::vector<std::size_t> order;
  for (std::size_t e = 0; e < ends.size(); ++e)
    if (ends[e].solution.converged) order.push_back(e);
  std::stable_sort(order.begin(), order.end(),
                   [&](auto a, auto b) { return ends[a].solution.cost < ends[b].solution.cost; });
  std::vector<Solution> minima;
  for (const std::size_t e : order) {
    const auto known = std::find_if(minima.begin(), minima.end(), [&](const Solution& m) {
      return same(setting, m, ends[e].solution, minima[0].cost);
    });
    ends[e].minimum = int(known - minima.begin());
    if (known == minima.end()) minima.push_back(ends[e].solution);
  }
  return minima;
}

}  // namespace

BasinMap basin_map(const std::string& name, std::size_t columns, std::size_t rows) {
  const Setting setting = setting_of(name);
  const FitProblem& problem = setting.problem;
  BasinMap map{name,
               problem.free[setting.first].name,
               problem.free[setting.second].name,
               axis_of(problem.free[setting.first]),
               axis_of(problem.free[setting.second]),
               columns,
               rows,
               {},
               {},
               {}};
  const LaneFit all(problem, every_point(problem));
  const std::size_t cells = columns * rows;
  std::vector<End> ends(2 * cells);  // the solver alone, then after the search
  tbb::parallel_for(std::size_t(0), cells, [&](std::size_t c) {
    std::vector<double> x;
    for (const FreeParameter& p : problem.free) x.push_back(0.5 * std::log(p.lo * p.hi));
    x[setting.first] = std::log(10.0) * map.x.at(double(c % columns) / double(columns - 1));
    x[setting.second] = std::log(10.0) * map.y.at(double(c / columns) / double(rows - 1));
    std::vector<double> scaled = x;
    all.eliminate(scaled);
    ends[c].solution = all.solve(scaled, kSearch);
    ends[cells + c].solution = all.solve(improve_start(all, x), kSearch);
  });
  for (const Solution& m : numbered(setting, ends))
    map.minima.push_back(
        {rms_of(problem, m), m.x[setting.first] / std::log(10.0), m.x[setting.second] / std::log(10.0), 0, 0});
  for (std::size_t e = 0; e < ends.size(); ++e) {
    const bool plain = e < cells;
    (plain ? map.plain : map.improved).push_back(ends[e].minimum);
    if (ends[e].minimum >= 0)
      ++(plain ? map.minima[std::size_t(ends[e].minimum)].plain : map.minima[std::size_t(ends[e].minimum)].improved);
  }
  return map;
}

}  // namespace gonio
