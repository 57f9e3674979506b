#include "fit/lane_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>

#include "base/parallel.h"

namespace gonio {
namespace {

bool same_surface(const FitPoint& a, const FitPoint& b) {
  return a.wavelength_um == b.wavelength_um && a.surface.n == b.surface.n && a.surface.k == b.surface.k &&
         a.surface.perfect == b.surface.perfect && a.group == b.group;
}

}  // namespace

LanePoints::LanePoints(const FitProblem& problem, std::span<const std::size_t> chosen, const ApertureNode* node)
    : count(chosen.size()) {
  std::vector<std::size_t> order(chosen.begin(), chosen.end());
  const auto key = [&](std::size_t p) {
    const FitPoint& at = problem.points[p];
    return std::tuple(at.group, at.wavelength_um, at.surface.n, at.surface.k, at.surface.perfect);
  };
  const auto before = [&](std::size_t a, std::size_t b) { return key(a) < key(b); };
  if (!std::is_sorted(order.begin(), order.end(), before)) std::stable_sort(order.begin(), order.end(), before);

  for (std::size_t at = 0; at < order.size();) {
    std::size_t end = at;
    const FitPoint& first = problem.points[order[at]];
    while (end < order.size() && same_surface(problem.points[order[end]], first)) ++end;
    LaneGroup group{point.size() / kWidth, 0, first.group, first.wavelength_um, first.surface};
    for (; at < end; at += kWidth, ++group.batches)
      for (std::size_t lane = 0; lane < kWidth; ++lane) point.push_back(at + lane < end ? order[at + lane] : kNoPoint);
    at = end;
    groups.push_back(group);
  }

  // A lane without a point repeats the first of its batch, without confidence.
  const std::size_t all = point.size() / kWidth;
  for (auto* component : {&cos_i, &cos_o, &cos_d, &tan2_h, &tan2_i, &tan2_o, &ix, &iy, &ox, &oy, &hx, &hy, &measured,
                          &compared, &weight, &confidence})
    component->resize(all);
  if (node != nullptr) share.resize(all);
  for_each_index(all, [&](std::size_t batch) {
    std::array<const FitPoint*, kWidth> at;
    for (std::size_t lane = 0; lane < kWidth; ++lane) {
      const std::size_t p = point[batch * kWidth + lane];
      at[lane] = &problem.points[p == kNoPoint ? point[batch * kWidth] : p];
    }
    const auto fill = [&](std::vector<DoubleLanes>& to, auto member) {
      std::array<double, kWidth> values;
      for (std::size_t lane = 0; lane < kWidth; ++lane) values[lane] = member(*at[lane]);
      to[batch] = DoubleLanes::load_unaligned(values.data());
    };
    std::array<Directions<double>, kWidth> directions;
    std::array<double, kWidth> shares{};
    for (std::size_t lane = 0; lane < kWidth; ++lane)
      directions[lane] = node == nullptr ? at[lane]->directions : through(*node, at[lane]->directions, shares[lane]);
    if (node != nullptr) share[batch] = DoubleLanes::load_unaligned(shares.data());
    using D = Directions<double>;
    const auto direction = [&](std::vector<DoubleLanes>& to, double D::*component) {
      std::array<double, kWidth> values;
      for (std::size_t lane = 0; lane < kWidth; ++lane) values[lane] = directions[lane].*component;
      to[batch] = DoubleLanes::load_unaligned(values.data());
    };
    direction(cos_i, &D::cos_i), direction(cos_o, &D::cos_o), direction(cos_d, &D::cos_d);
    direction(tan2_h, &D::tan2_h), direction(tan2_i, &D::tan2_i), direction(tan2_o, &D::tan2_o);
    direction(ix, &D::ix), direction(iy, &D::iy), direction(ox, &D::ox), direction(oy, &D::oy);
    direction(hx, &D::hx), direction(hy, &D::hy);
    fill(measured, [](const FitPoint& p) { return p.f_per_sr; });
    fill(compared, [&](const FitPoint& p) { return problem.compared(p.f_per_sr, p); });
    fill(weight, [](const FitPoint& p) { return p.weight; });
    std::array<double, kWidth> sure;
    for (std::size_t lane = 0; lane < kWidth; ++lane)
      sure[lane] = point[batch * kWidth + lane] == kNoPoint ? 0.0 : at[lane]->confidence;
    confidence[batch] = DoubleLanes::load_unaligned(sure.data());
  });
}

std::vector<std::size_t> every_point(const FitProblem& problem) {
  std::vector<std::size_t> all(problem.points.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

std::vector<std::size_t> thinned_points(const FitProblem& problem, std::size_t most) {
  const std::size_t count = problem.points.size();
  if (count <= most) return every_point(problem);
  // One of each of most/2 stretches, at a place of its own in it (a scan's rows are periodic) …
  std::vector<std::size_t> some;
  const std::size_t stretches = most / 2;
  for (std::size_t i = 0; i < stretches; ++i) {
    const std::size_t lo = i * count / stretches, length = (i + 1) * count / stretches - lo;
    const double turn = 0.6180339887498949 * static_cast<double>(i);
    some.push_back(lo + static_cast<std::size_t>((turn - std::floor(turn)) * static_cast<double>(length)));
  }
  // … and as many from the brightest on, further and further apart: a narrow peak is not missed.
  // Of many points the brightest and a sample stand for all.
  std::vector<std::pair<double, std::size_t>> rank(count);
  for (std::size_t i = 0; i < count; ++i) rank[i] = {-problem.points[i].f_per_sr, i};
  std::nth_element(rank.begin(), rank.begin() + static_cast<std::ptrdiff_t>(most), rank.end());
  const std::size_t step = std::max<std::size_t>(1, count / (8 * most));
  std::size_t kept = most;
  for (std::size_t i = most; i < count; i += step) rank[kept++] = rank[i];
  rank.resize(kept);
  std::sort(rank.begin(), rank.end());
  const std::size_t places = most - stretches;
  for (std::size_t i = 0; i < places; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(places);
    some.push_back(rank[static_cast<std::size_t>(share * share * static_cast<double>(kept - 1))].second);
  }
  std::sort(some.begin(), some.end());
  some.erase(std::unique(some.begin(), some.end()), some.end());
  return some;
}

}  // namespace gonio
