// What one sampled direction with its density costs, a family a row: scalar double, double lanes, float lanes. Items per second are
// samples; random numbers are drawn before the clock starts.
#include <benchmark/benchmark.h>

#include <random>

#include "brdf/lanes.h"
#include "brdf/sampling.h"

using namespace gonio;

namespace {

constexpr std::size_t kBatches = 64;

struct Family {
  const char* name;
  ModelSpec spec;
  std::vector<double> values;
};

const std::vector<Family>& families() {
  static const std::vector<Family> all{
      {"torrance-sparrow/smith", {ModelId::torrance_sparrow}, {0.2, 0, 1}},
      {"torrance-sparrow/v-cavity", {ModelId::torrance_sparrow, Shadowing::v_cavity}, {0.2, 0, 1}},
      {"ggx/smith", {ModelId::ggx}, {0.3, 0.3, 0, 1}},
      {"ggx/smith anisotropic", {ModelId::ggx}, {0.1, 0.5, 0, 1}},
      {"ggx/v-cavity", {ModelId::ggx, Shadowing::v_cavity}, {0.3, 0.3, 0, 1}},
      {"phong-1975", {ModelId::phong_1975}, {50, 0, 1}},
      {"ashikhmin-shirley-2000", {ModelId::ashikhmin_shirley_2000}, {10, 100, 0.3, 0, 0, 1}},
      {"low-smooth-2012", {ModelId::low_smooth_2012}, {1, 1000, 1.2, 0, 1}},
      {"beckmann-kirchhoff", {ModelId::beckmann_kirchhoff}, {0.2, 5, 0, 1}},
      {"lambert", {ModelId::lambert}, {1}},
  };
  return all;
}

template <class T>
T filled(std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(1e-6, 1 - 1e-6);
  if constexpr (is_lanes_v<T>) {
    std::array<scalar_t<T>, T::size> u;
    for (auto& one : u) one = scalar_t<T>(uniform(random));
    return T::load_unaligned(u.data());
  } else {
    return T(uniform(random));
  }
}

template <class T>
Brdf<T> brdf_of(const Family& family) {
  if constexpr (is_lanes_v<T>)
    return spread_brdf<T>(family.spec, family.values);
  else
    return make_brdf<T>(family.spec, std::vector<T>(family.values.begin(), family.values.end()));
}

template <class T>
void sample_with_pdf(benchmark::State& state, const Family& family) {
  using S = scalar_t<T>;
  const auto mixture = lobe_mixture(brdf_of<T>(family), T(S(0.9)), T(S(0.55)));
  std::mt19937_64 random(1);
  std::vector<std::array<T, 3>> numbers;
  std::vector<UnitVector<T>> eyes;
  for (std::size_t b = 0; b < kBatches; ++b) {
    numbers.push_back({filled<T>(random), filled<T>(random), filled<T>(random)});
    eyes.push_back(CosineSampler<T>{}
                       .sample({T(S(0)), T(S(0)), T(S(1))}, T(S(0.5)), filled<T>(random), filled<T>(random))
                       .direction);
  }
  std::visit(
      [&](const auto& sampler) {
        for (auto _ : state)
          for (std::size_t b = 0; b < kBatches; ++b) {
            auto drawn = sampler.sample(eyes[b], numbers[b][0], numbers[b][1], numbers[b][2]);
            benchmark::DoNotOptimize(drawn);
          }
      },
      mixture.lobe);
  std::size_t lanes = 1;
  if constexpr (is_lanes_v<T>) lanes = T::size;
  state.SetItemsProcessed(state.iterations() * std::int64_t(kBatches * lanes));
}

const bool kRegistered = [] {
  for (const Family& family : families()) {
    const std::string name(family.name);
    benchmark::RegisterBenchmark((name + "/double").c_str(), sample_with_pdf<double>, family);
    benchmark::RegisterBenchmark((name + "/double_lanes").c_str(), sample_with_pdf<DoubleLanes>, family);
    benchmark::RegisterBenchmark((name + "/float_lanes").c_str(), sample_with_pdf<FloatLanes>, family);
  }
  return true;
}();

}  // namespace
