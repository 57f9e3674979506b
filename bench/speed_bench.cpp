// The loops behind the ratios of `gonio assess speed brdf`, as benchmarks: items per second are evaluations (pairs of directions).
#include <benchmark/benchmark.h>

#include "assess/brdf_speed.h"
#include "assess/derivative_loop.h"
#include "base/jet.h"

using namespace gonio;

namespace {

constexpr std::size_t kPairs = PairArrays<double>::kPairs;

void done(benchmark::State& state) { state.SetItemsProcessed(state.iterations() * std::int64_t(kPairs)); }

void plain_loop(benchmark::State& state) {
  PairArrays<double> a;
  for (auto _ : state) {
    for (std::size_t p = 0; p < kPairs; ++p) a.out[p] = plain_beckmann(a.i(p), a.o(p), 0.3, 0.21, 3.272);
    benchmark::ClobberMemory();
  }
  done(state);
}
BENCHMARK(plain_loop);

template <class Lanes>
void pairs(benchmark::State& state, ModelId id, std::vector<double> values) {
  using S = scalar_t<Lanes>;
  PairArrays<S> a;
  const Brdf<Lanes> brdf = spread_brdf<Lanes>({id}, values);
  const Interface<Lanes> gold{Lanes(S(0.21)), Lanes(S(3.272))};
  for (auto _ : state) {
    evaluate_pairs<Lanes>(brdf, a.pairs(), gold, Lanes(S(0.55)), a.out);
    benchmark::ClobberMemory();
  }
  done(state);
}

void jets(benchmark::State& state) {
  using J = Jet<3>;
  PairArrays<double> a;
  std::vector<J> out(kPairs);
  const TorranceSparrow<J> lobe{J(0.3, 0)};
  const Interface<J> gold{J(0.21, 1), J(3.272, 2)};
  for (auto _ : state) {
    for (std::size_t p = 0; p < kPairs; ++p) out[p] = lobe_value<J>(lobe, a.reduced(p), gold, J(0.55));
    benchmark::ClobberMemory();
  }
  done(state);
}
BENCHMARK(jets);

void duals(benchmark::State& state) {
  PairArrays<double> a;
  std::vector<double, xsimd::aligned_allocator<double, 64>> out(4 * kPairs);
  for (auto _ : state) {
    derivatives_in_lanes(0.3, 0.21, 3.272, a, out.data());
    benchmark::ClobberMemory();
  }
  done(state);
}
BENCHMARK(duals);

const bool kRegistered = [] {
  const auto both = [](const std::string& name, ModelId id, std::vector<double> values) {
    benchmark::RegisterBenchmark((name + "/double_lanes").c_str(), pairs<DoubleLanes>, id, values);
    benchmark::RegisterBenchmark((name + "/float_lanes").c_str(), pairs<FloatLanes>, id, values);
  };
  both("torrance-sparrow", ModelId::torrance_sparrow, {0.3 / std::sqrt(2.0), 0, 1});
  both("ggx", ModelId::ggx, {0.3, 0.3, 0, 1});
  for (const double g : {0.1, 1.0, 10.0, 30.0, 100.0, 1e4, 1e6}) {
    const double sigma_um = std::sqrt(g) * 0.55 / (4 * kPi<double>);
    both("beckmann-kirchhoff/g=" + std::to_string(int(10 * g)) + "e-1", ModelId::beckmann_kirchhoff,
         {sigma_um, std::max(10 * sigma_um, 2.0), 0, 1});
  }
  both("he-1991", ModelId::he_1991, {0.2, 3, 0, 1});
  return true;
}();

}  // namespace
