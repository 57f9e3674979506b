// The loops behind `gonio assess speed fit`, as benchmarks: items per second are starts.
#include <benchmark/benchmark.h>

#include "assess/fit_speed.h"

using namespace gonio;

namespace {

void starts(benchmark::State& state, const FitCase& wanted, int count, Derivatives derivatives) {
  const FitSamples samples = fit_samples(wanted);
  in_threads(1, [&] {
    for (auto _ : state) benchmark::DoNotOptimize(solve_starts(samples.problem, count, derivatives));
  });
  state.SetItemsProcessed(state.iterations() * count);
}

void whole_fit(benchmark::State& state) {
  const FitSamples samples = fit_samples({"torrance-sparrow", Metric::log, std::size_t(state.range(0))});
  for (auto _ : state) benchmark::DoNotOptimize(fit(samples.scan, samples.request));
}
BENCHMARK(whole_fit)->Arg(500)->Arg(20000)->Arg(100000)->Unit(benchmark::kMillisecond);

const bool kRegistered = [] {
  const auto add = [](const std::string& name, const FitCase& wanted, int count, Derivatives derivatives) {
    benchmark::RegisterBenchmark(name.c_str(), starts, wanted, count, derivatives)->Unit(benchmark::kMillisecond);
  };
  for (const char* name : {"torrance-sparrow", "ggx", "beckmann-kirchhoff"})
    for (const Metric metric : {Metric::log, Metric::linear, Metric::cuberoot})
      for (const Derivatives derivatives : {Derivatives::lanes, Derivatives::jet, Derivatives::numeric})
        add("500x16/" + std::string(name) + "/" + std::string(name_of(metric)) + "/" +
                std::string(name_of(derivatives)),
            {name, metric, 500, 16}, 1, derivatives);
  for (const int count : {1, 2, 4, 8, 16, 32})
    add("2000x16/starts=" + std::to_string(count), {"torrance-sparrow", Metric::log, 2000, 16}, count,
        Derivatives::lanes);
  FitCase own{"torrance-sparrow", Metric::log, 500, 16};
  own.own_scales = true;
  add("500x16/kd_and_ks_of_each", own, 1, Derivatives::lanes);
  add("100000/starts=1", {"torrance-sparrow", Metric::log, 100000}, 1, Derivatives::lanes);
  add("100000/starts=16", {"torrance-sparrow", Metric::log, 100000}, 16, Derivatives::lanes);
  return true;
}();

}  // namespace
