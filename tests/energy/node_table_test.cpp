// Tables of nodes against what they stand for, at random places and at the corners.
#include "energy/node_table.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "base/error.h"
#include "catch.h"

using namespace gonio;

namespace {

/// Water, glass, diamond; silver, silicon in the ultraviolet, aluminium; a metal next to its plasma edge; germanium.
const std::vector<Interface<double>> kSurfaces{{1.33, 0, false},   {1.5, 0, false},   {2.4, 0, false},
                                               {0.05, 3.5, false}, {3.5, 3.3, false}, {1.4, 7.5, false},
                                               {0.3, 0.6, false},  {4.3, 0.5, false}};

struct Place {
  double cos_i, m;
};

/// Evenly in angle, in cosine and in the cosine's logarithm; corners first.
std::vector<Place> places(std::size_t count, double widest) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform;
  std::vector<Place> all{{1, 0.01}, {0, 0.01}, {1, widest}, {0, widest}, {1e-9, 1}, {0.5, widest}};
  while (all.size() < count) {
    const double u = uniform(random), m = 0.01 * std::pow(widest / 0.01, uniform(random));
    const std::size_t kind = all.size() % 3;
    all.push_back({kind == 0 ? std::cos(u * kPi<double> / 2) : kind == 1 ? u : std::pow(10, -4 * u), m});
  }
  return all;
}

double worst_error(const ModelSpec& spec, std::size_t count) {
  const NodeTable table(spec);
  const std::vector<Place> all = places(count, table.widest());
  std::vector<double> worst(all.size(), 0);
  tbb::parallel_for(std::size_t{0}, all.size(), [&](std::size_t p) {
    const double theta_deg = std::acos(std::max(all[p].cos_i, 1e-6)) * 180 / kPi<double>;
    const LobeMeasure exact = lobe_measure(lobe_of_width(spec, all[p].m), theta_deg);
    for (const Interface<double>& surface : kSurfaces) {
      double e = 0;
      for (std::size_t i = 0; i < exact.weight.size(); ++i) e += exact.weight[i] * surface.reflectance(exact.cos_d[i]);
      worst[p] = std::max(worst[p], std::abs(table.reflectance(all[p].cos_i, all[p].m, surface) - e));
    }
  });
  return *std::max_element(worst.begin(), worst.end());
}

}  // namespace

TEST_CASE("a table of nodes gives E of any material within 1e-4", "[energy][nodes][slow]") {
  for (const char* shadowing : {"smith-correlated", "smith-separable", "smith-1967", "v-cavity"}) {
    ModelSpec spec;
    spec.id = ModelId::torrance_sparrow;
    set_shadowing(spec, shadowing);
    const double worst = worst_error(spec, 4000);
    INFO(shadowing << ": " << worst);
    CHECK(worst <= 1e-4);
  }
  ModelSpec spec;
  spec.id = ModelId::pseudo_realistic;
  const double worst = worst_error(spec, 4000);
  INFO("pseudo-realistic: " << worst);
  CHECK(worst <= 1e-4);
}

TEST_CASE("lookups in lanes are those one by one, and other lobes are refused", "[energy][nodes]") {
  ModelSpec spec;
  spec.id = ModelId::torrance_sparrow;
  const NodeTable table(spec, {16, 16});
  std::vector<double> cos_i, m;
  for (const Place& p : places(101, table.widest())) cos_i.push_back(p.cos_i), m.push_back(p.m);
  std::vector<double> e(cos_i.size());
  table.reflectances(cos_i, m, kSurfaces[1], e);
  for (std::size_t i = 0; i < e.size(); ++i)
    CHECK(e[i] == Approx(table.reflectance(cos_i[i], m[i], kSurfaces[1])).margin(1e-6));
  CHECK(std::isnan(
      table.reflectance(NAN, 0.2, kSurfaces[1])));  // no number in, none out, and nothing read beyond the table
  spec.id = ModelId::ggx;
  CHECK_THROWS_AS(NodeTable(spec), InputError);
  spec.id = ModelId::torrance_sparrow;
  CHECK_THROWS_AS(NodeTable(spec, {3, 16}), InputError);
}
