// The loops behind the ratios of `gonio assess speed brdf`, as benchmarks: items per second are evaluations (pairs of directions).
#include <benchmark/benchmark.h>

#include <random>

#include "assess/brdf_speed.h"
#include "base/dual.h"
#include "base/jet.h"
#include "brdf/batch.h"

using namespace gonio;

namespace {

constexpr std::size_t kPairs = 512;

template <class S>
struct Arrays {
  std::array<std::vector<S, xsimd::aligned_allocator<S, 64>>, 6> v;
  std::vector<S, xsimd::aligned_allocator<S, 64>> out = decltype(out)(kPairs);

  Arrays() {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (auto& component : v) component.resize(kPairs);
    for (std::size_t p = 0; p < kPairs; ++p)
      for (const std::size_t first : {0, 3}) {
        const double z = 0.05 + 0.95 * uniform(random), phi = 2 * kPi<double> * uniform(random), r = std::sqrt((1 - z) * (1 + z));
        v[first][p] = S(r * std::cos(phi)), v[first + 1][p] = S(r * std::sin(phi)), v[first + 2][p] = S(z);
      }
  }
};

void done(benchmark::State& state) { state.SetItemsProcessed(state.iterations() * std::int64_t(kPairs)); }

void plain_loop(benchmark::State& state) {
  Arrays<double> a;
  for (auto _ : state) {
    for (std::size_t p = 0; p < kPairs; ++p)
      a.out[p] = plain_beckmann({a.v[0][p], a.v[1][p], a.v[2][p]}, {a.v[3][p], a.v[4][p], a.v[5][p]}, 0.3, 0.21, 3.272);
    benchmark::ClobberMemory();
  }
  done(state);
}
BENCHMARK(plain_loop);

template <class Lanes>
void pairs(benchmark::State& state, ModelId id, std::vector<double> values) {
  using S = scalar_t<Lanes>;
  Arrays<S> a;
  const Brdf<Lanes> brdf = spread_brdf<Lanes>({id}, values);
  const Interface<Lanes> gold{Lanes(S(0.21)), Lanes(S(3.272))};
  for (auto _ : state) {
    evaluate_pairs<Lanes>(brdf, {a.v[0], a.v[1], a.v[2], a.v[3], a.v[4], a.v[5]}, gold, Lanes(S(0.55)), a.out);
    benchmark::ClobberMemory();
  }
  done(state);
}

void jets(benchmark::State& state) {
  using J = Jet<3>;
  Arrays<double> a;
  std::vector<J> out(kPairs);
  const TorranceSparrow<J> lobe{J(0.3, 0)};
  const Interface<J> gold{J(0.21, 1), J(3.272, 2)};
  for (auto _ : state) {
    for (std::size_t p = 0; p < kPairs; ++p)
      out[p] = lobe_value<J>(lobe, reduce(a.v[0][p], a.v[1][p], a.v[2][p], a.v[3][p], a.v[4][p], a.v[5][p]), gold, J(0.55));
    benchmark::ClobberMemory();
  }
  done(state);
}
BENCHMARK(jets);

using D = Dual<DoubleLanes, 3>;
[[gnu::flatten]] void dual_loop(const TorranceSparrow<D> lobe, const Interface<D> gold, const Arrays<double>& a, double* out) {
  for (std::size_t at = 0; at < kPairs; at += DoubleLanes::size) {
    const auto of = [&](std::size_t c) { return DoubleLanes::load_aligned(a.v[c].data() + at); };
    const D f = lobe_value<D>(lobe, reduce(of(0), of(1), of(2), of(3), of(4), of(5)), gold, D(0.55));
    f.a.store_aligned(out + 4 * at);
    for (std::size_t i = 0; i < 3; ++i) f.v[i].store_aligned(out + 4 * at + (i + 1) * DoubleLanes::size);
  }
}
void duals(benchmark::State& state) {
  Arrays<double> a;
  std::vector<double, xsimd::aligned_allocator<double, 64>> out(4 * kPairs);
  for (auto _ : state) {
    dual_loop({D(DoubleLanes(0.3), 0)}, {D(DoubleLanes(0.21), 1), D(DoubleLanes(3.272), 2)}, a, out.data());
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
    both("beckmann-kirchhoff/g=" + std::to_string(int(10 * g)) + "e-1", ModelId::beckmann_kirchhoff, {sigma_um, std::max(10 * sigma_um, 2.0), 0, 1});
  }
  both("he-1991", ModelId::he_1991, {0.2, 3, 0, 1});
  return true;
}();

}  // namespace
