// E of one lobe on one material: from its table for any width, for one width, and in a table of every material; beside the quadrature.
#include <benchmark/benchmark.h>

#include <cmath>
#include <random>
#include <vector>

#include "energy/directional_reflectance.h"
#include "energy/energy_table.h"

namespace {

using namespace gonio;

const LobeFamily& family() { return lobe_family("beckmann-smith-correlated"); }
const EnergyTable& table() {
  static const EnergyTable made(family());
  return made;
}
const Interface<double> kGlass{1.5, 0, false};
NodeValues glass() { return reflectance_at_nodes(family().lobe(0.5), kGlass); }

struct Places {
  std::vector<float> cos_theta, alpha, e;
  explicit Places(std::size_t count) : e(count) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<float> uniform;
    for (std::size_t i = 0; i < count; ++i)
      cos_theta.push_back(uniform(random)), alpha.push_back(0.01F * std::pow(280.0F, uniform(random)));
  }
};

void made(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(EnergyTable(family()).bytes());
}
BENCHMARK(made)->Unit(benchmark::kMillisecond);

void any_width(benchmark::State& state) {
  Places p(4096);
  const SurfaceEnergyTable surface(table(), glass());
  for (auto _ : state) surface.reflectances(p.cos_theta, p.alpha, p.e), benchmark::DoNotOptimize(p.e.data());
  state.SetItemsProcessed(state.iterations() * std::int64_t(p.e.size()));
}
BENCHMARK(any_width);

void one_width(benchmark::State& state) {
  Places p(4096);
  const ReflectanceCurve curve = table().curve(0.3, glass());
  for (auto _ : state) curve.at(p.cos_theta, p.e), benchmark::DoNotOptimize(p.e.data());
  state.SetItemsProcessed(state.iterations() * std::int64_t(p.e.size()));
}
BENCHMARK(one_width);

void any_material(benchmark::State& state) {
  const Places p(256);
  const NodeValues r = glass();
  for (auto _ : state)
    for (std::size_t i = 0; i < p.e.size(); ++i)
      benchmark::DoNotOptimize(sum_of_products(table().weights(double(p.cos_theta[i]), double(p.alpha[i])), r));
  state.SetItemsProcessed(state.iterations() * std::int64_t(p.e.size()));
}
BENCHMARK(any_material);

void curve_made(benchmark::State& state) {
  const NodeValues r = glass();
  for (auto _ : state) benchmark::DoNotOptimize(table().curve(0.3, r).values().data());
}
BENCHMARK(curve_made);

void quadrature(benchmark::State& state) {
  const Places p(64);
  const SpectralSurface glass{{kGlass}, {0.55}};
  for (auto _ : state)
    for (std::size_t i = 0; i < p.e.size(); ++i) {
      const double theta_deg = std::acos(double(p.cos_theta[i])) * 180 / kPi<double>;
      benchmark::DoNotOptimize(
          directional_reflectance(family().lobe(double(p.alpha[i])), theta_deg, glass, 1e-5).front().value);
    }
  state.SetItemsProcessed(state.iterations() * std::int64_t(p.e.size()));
}
BENCHMARK(quadrature)->Unit(benchmark::kMillisecond);

}  // namespace
