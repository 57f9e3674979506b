// What one evaluation costs, by number type. Items per second count directions × lanes: compare the types side by side.
#include <benchmark/benchmark.h>

#include "base/jet.h"
#include "brdf/lanes.h"

using namespace gonio;

namespace {

std::vector<double> middle_values(const ModelInfo& info) {
  std::vector<double> values;
  for (const ParameterInfo& p : info.parameters) values.push_back(p.fallback.value_or(std::sqrt(p.fit_lo * p.fit_hi)));
  return values;
}

std::vector<Directions<double>> directions() {
  std::vector<Directions<double>> all;
  for (int i = 0; i < 64; ++i) all.push_back(directions_from_deg(1.3 * i, 80 - 1.2 * i, 180.0 - i));
  return all;
}

const Interface<double> kGold{0.43, 2.46};

void in_double(benchmark::State& state, ModelId id) {
  const Brdf<double> brdf = make_brdf<double>({id}, middle_values(model(id)));
  const auto pairs = directions();
  for (auto _ : state)
    for (const auto& w : pairs) benchmark::DoNotOptimize(evaluate(brdf, w, kGold, 0.55));
  state.SetItemsProcessed(state.iterations() * std::int64_t(pairs.size()));
}

template <class Lanes>
void in_lanes(benchmark::State& state, ModelId id) {
  const auto brdf = spread_brdf<Lanes>({id}, middle_values(model(id)));
  const auto surface = spread<Lanes>(kGold);
  std::vector<Directions<Lanes>> pairs;
  for (const auto& w : directions()) pairs.push_back(spread<Lanes>(w));
  const Lanes wavelength_um(scalar_t<Lanes>(0.55));
  for (auto _ : state)
    for (const auto& w : pairs) benchmark::DoNotOptimize(evaluate(brdf, w, surface, wavelength_um));
  state.SetItemsProcessed(state.iterations() * std::int64_t(pairs.size() * Lanes::size));
}

void in_jets(benchmark::State& state, ModelId id) {
  using J = Jet<4>;
  std::vector<J> values;
  for (const double value : middle_values(model(id))) values.emplace_back(value, int(values.size()));
  const Brdf<J> brdf = make_brdf<J>({id}, values);
  const auto pairs = directions();
  const Interface<J> surface{J(kGold.n), J(kGold.k)};
  for (auto _ : state)
    for (const auto& w : pairs) benchmark::DoNotOptimize(evaluate(brdf, w, surface, J(0.55)));
  state.SetItemsProcessed(state.iterations() * std::int64_t(pairs.size()));
}

const bool kRegistered = [] {
  for (const ModelInfo& info : models()) {
    const std::string name(info.name);
    benchmark::RegisterBenchmark((name + "/double").c_str(), in_double, info.id);
    benchmark::RegisterBenchmark((name + "/double_lanes").c_str(), in_lanes<DoubleLanes>, info.id);
    benchmark::RegisterBenchmark((name + "/float_lanes").c_str(), in_lanes<FloatLanes>, info.id);
    benchmark::RegisterBenchmark((name + "/jet4").c_str(), in_jets, info.id);
  }
  return true;
}();

}  // namespace
