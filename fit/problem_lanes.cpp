#include <algorithm>
#include <array>

#include "brdf/lanes.h"
#include "fit/problem.h"

namespace gonio {
namespace {

constexpr std::size_t kWidth = DoubleLanes::size;

/// kWidth points (the last one repeated where fewer are left), one a lane.
struct PointLanes {
  Directions<DoubleLanes> directions;
  Interface<DoubleLanes> surface;
  DoubleLanes wavelength_um;
};

/// One number of each point.
template <class Member>
DoubleLanes lanes_of(std::span<const FitPoint> points, Member member) {
  std::array<double, kWidth> values;
  for (std::size_t lane = 0; lane < kWidth; ++lane) values[lane] = member(points[std::min(lane, points.size() - 1)]);
  return DoubleLanes::load_unaligned(values.data());
}

PointLanes lanes_of(std::span<const FitPoint> points) {
  const auto of = [&](auto member) { return lanes_of(points, member); };
  return {{of([](const FitPoint& p) { return p.directions.cos_i; }),
           of([](const FitPoint& p) { return p.directions.cos_o; }),
           of([](const FitPoint& p) { return p.directions.cos_d; }),
           of([](const FitPoint& p) { return p.directions.tan2_h; }),
           of([](const FitPoint& p) { return p.directions.tan2_i; }),
           of([](const FitPoint& p) { return p.directions.tan2_o; }),
           of([](const FitPoint& p) { return p.directions.ix; }),
           of([](const FitPoint& p) { return p.directions.iy; }),
           of([](const FitPoint& p) { return p.directions.ox; }),
           of([](const FitPoint& p) { return p.directions.oy; }),
           of([](const FitPoint& p) { return p.directions.hx; }),
           of([](const FitPoint& p) { return p.directions.hy; })},
          {of([](const FitPoint& p) { return p.surface.n; }), of([](const FitPoint& p) { return p.surface.k; }),
           points.front().surface.perfect},
          of([](const FitPoint& p) { return p.wavelength_um; })};
}

/// How many points from the first on have surfaces of one kind (a perfect one is no number, and fills no lane).
std::size_t alike(std::span<const FitPoint> points) {
  std::size_t count = 1;
  while (count < std::min(kWidth, points.size()) && points[count].surface.perfect == points[0].surface.perfect) ++count;
  return count;
}

}  // namespace

std::vector<double> FitProblem::part(std::span<const double> x, double kd, double ks) const {
  Brdf<DoubleLanes> brdf = spread_brdf<DoubleLanes>(model, values_at(x));
  brdf.kd = DoubleLanes(kd);
  brdf.ks = DoubleLanes(ks);
  if (ks == 0 && !brdf.diffuse_times_r0()) brdf.lobe = Lambert{};  // the lobe would count nothing
  const std::optional<double> n = index_at(x);
  std::vector<double> f(points.size());
  for (std::size_t at = 0; at < points.size();) {
    const std::span<const FitPoint> rest(points.data() + at, points.size() - at);
    const std::size_t count = alike(rest);
    const PointLanes lanes = lanes_of(rest.first(count));
    const Interface<DoubleLanes> surface =
        n ? Interface<DoubleLanes>{DoubleLanes(*n), DoubleLanes(0.0), false} : lanes.surface;
    std::array<double, kWidth> values;
    evaluate(brdf, lanes.directions, surface, lanes.wavelength_um).store_unaligned(values.data());
    std::copy_n(values.begin(), count, f.begin() + static_cast<std::ptrdiff_t>(at));
    at += count;
  }
  return f;
}

}  // namespace gonio
