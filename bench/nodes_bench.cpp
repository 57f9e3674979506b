// E of one lobe on one material: from a table of nodes one by one and in lanes, beside the quadrature it stands for.
#include <benchmark/benchmark.h>

#include <cmath>
#include <random>
#include <vector>

#include "energy/directional_reflectance.h"
#include "energy/node_table.h"

namespace {

using namespace gonio;

struct Case {
  NodeTable table{ModelSpec{ModelId::torrance_sparrow}};
  Interface<double> glass{1.5, 0, false};
  std::vector<double> cos_i, m, e;

  explicit Case(std::size_t count) : e(count) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform;
    for (std::size_t i = 0; i < count; ++i)
      cos_i.push_back(uniform(random)), m.push_back(0.01 * std::pow(200, uniform(random)));
  }
};

void made(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(NodeTable(ModelSpec{ModelId::torrance_sparrow}).bytes());
}
BENCHMARK(made)->Unit(benchmark::kMillisecond);

void in_lanes(benchmark::State& state) {
  Case c(4096);
  for (auto _ : state) c.table.reflectances(c.cos_i, c.m, c.glass, c.e), benchmark::DoNotOptimize(c.e.data());
  state.SetItemsProcessed(state.iterations() * std::int64_t(c.e.size()));
}
BENCHMARK(in_lanes);

void one_by_one(benchmark::State& state) {
  Case c(4096);
  for (auto _ : state)
    for (std::size_t i = 0; i < c.e.size(); ++i)
      benchmark::DoNotOptimize(c.e[i] = c.table.reflectance(c.cos_i[i], c.m[i], c.glass));
  state.SetItemsProcessed(state.iterations() * std::int64_t(c.e.size()));
}
BENCHMARK(one_by_one);

void quadrature(benchmark::State& state) {
  const Case c(64);
  const SpectralSurface glass{{c.glass}, {0.55}};
  for (auto _ : state)
    for (std::size_t i = 0; i < c.m.size(); ++i) {
      const double theta_deg = std::acos(c.cos_i[i]) * 180 / kPi<double>;
      const Lobe<double> lobe = lobe_of_width(ModelSpec{ModelId::torrance_sparrow}, c.m[i]);
      benchmark::DoNotOptimize(directional_reflectance(lobe, theta_deg, glass, 1e-5).front().value);
    }
  state.SetItemsProcessed(state.iterations() * std::int64_t(c.m.size()));
}
BENCHMARK(quadrature)->Unit(benchmark::kMillisecond);

}  // namespace
