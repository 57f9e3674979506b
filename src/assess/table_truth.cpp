#include "assess/table_truth.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "brdf/lanes.h"
#include "materials/database.h"

namespace gonio {
namespace {

constexpr double kTolerance = 1e-7;

double summed(const LobeMeasure& measure, const Interface<double>& surface) {
  constexpr std::size_t kLanes = DoubleLanes::size;
  const Interface<DoubleLanes> spread_surface = spread<DoubleLanes>(surface);
  DoubleLanes sum(0.0);
  std::size_t p = 0;
  for (; p + kLanes <= measure.cos_d.size(); p += kLanes)
    sum += DoubleLanes::load_unaligned(&measure.weight[p]) *
           spread_surface.reflectance(DoubleLanes::load_unaligned(&measure.cos_d[p]));
  double rest = 0;
  for (; p < measure.cos_d.size(); ++p) rest += measure.weight[p] * surface.reflectance(measure.cos_d[p]);
  return xsimd::hadd(sum) + rest;
}

}  // namespace

const std::vector<JudgingSurface>& common_surfaces() {
  static const std::vector<JudgingSurface> all = [] {
    std::vector<JudgingSurface> list{{"white facets", perfect_interface<double>()}};
    for (const auto& [name, id] : {std::pair("water", "water"),
                                   {"glass BK7", "BK7"},
                                   {"glass SF11", "SF11"},
                                   {"diamond", "diamond"},
                                   {"silicon", "Si"},
                                   {"gold", "Au"},
                                   {"copper", "Cu"},
                                   {"silver", "Ag"},
                                   {"aluminium", "Al"},
                                   {"chromium", "Cr"},
                                   {"tungsten", "W"}})
      list.push_back({name, SurfaceMaterial(id).at(550)});
    list.push_back({"n 1.4, k 7.5", {1.4, 7.5, false}});
    return list;
  }();
  return all;
}

const std::vector<JudgingSurface>& extreme_surfaces() {
  static const std::vector<JudgingSurface> all{{"n 1.4, k 7.5", {1.4, 7.5, false}},
                                               {"n 20", {20, 0, false}},
                                               {"n 400", {400, 0, false}},
                                               {"n 1.01", {1.01, 0, false}},
                                               {"n 1.0001", {1.0001, 0, false}},
                                               {"plasma edge, n 0.29, k 0.09", {0.29, 0.09, false}},
                                               {"from glass to air, n 0.67", {0.67, 0, false}}};
  return all;
}

double TablePlace::theta_deg() const { return std::acos(cos_theta) * 180 / kPi<double>; }

std::vector<TablePlace> random_table_places(double widest, std::size_t count) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform;
  std::vector<TablePlace> places;
  for (std::size_t i = 0; i < count; ++i) {
    const double u = uniform(random), alpha = kNarrowestAlpha * std::pow(widest / kNarrowestAlpha, uniform(random));
    places.push_back({i % 3 == 0 ? std::cos(u * kPi<double> / 2) : i % 3 == 1 ? u : std::pow(10, -5 * u), alpha});
  }
  return places;
}

std::vector<double> summed(const LobeMeasure& measure, std::span<const JudgingSurface> surfaces) {
  std::vector<double> e;
  for (const JudgingSurface& one : surfaces) e.push_back(summed(measure, one.interface));
  return e;
}

std::vector<std::vector<double>> true_reflectances(const LobeFamily& family, std::span<const TablePlace> places,
                                                   std::span<const JudgingSurface> surfaces) {
  std::vector<std::vector<double>> e(places.size());
  tbb::parallel_for(std::size_t{0}, places.size(), [&](std::size_t p) {
    e[p] = summed(lobe_measure(family.lobe(places[p].alpha), places[p].theta_deg(), kTolerance), surfaces);
  });
  return e;
}

ErrorSpread spread_of(std::vector<double> errors) {
  if (errors.empty()) return {};
  const auto worst = static_cast<std::size_t>(std::max_element(errors.begin(), errors.end()) - errors.begin());
  std::sort(errors.begin(), errors.end());
  return {errors.back(), errors[errors.size() / 2], worst};
}

}  // namespace gonio
