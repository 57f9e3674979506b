// Nodes for a scene of 30 spectra: the 24 ColorChecker patches and six metals to two bounces, products and search
// together.
#include <benchmark/benchmark.h>

#include "materials/color_entries.h"
#include "spectrum/wavelengths.h"

using namespace gonio;

namespace {

SpectralScene thirty(const char* light) {
  const Database& database = Database::bundled();
  SpectralScene scene{{}, {light_of(database.find(light))}, observer_of(database.find("1931-2"))};
  for (const std::string& id : database.ids())
    if (id.starts_with("colorchecker-ohta-")) scene.reflectances.push_back(factor_of(id));
  for (const char* metal : {"Au", "Ag", "Cu", "Al", "Fe", "Ni"}) scene.reflectances.push_back(factor_of(metal));
  return scene;
}

void nodes_for_thirty(benchmark::State& state, const char* light) {
  const SpectralScene scene = thirty(light);
  double worst = 0;
  for (auto _ : state)
    worst = choose_wavelengths(SceneProducts(scene, 2), static_cast<int>(state.range(0))).worst_e2000;
  state.counters["worst_dE2000"] = worst;
}

void fewest_for_thirty(benchmark::State& state, const char* light) {
  const SpectralScene scene = thirty(light);
  double nodes = 0;
  for (auto _ : state)
    nodes = static_cast<double>(fewest_wavelengths(SceneProducts(scene, 2), 0.5, 24).nodes_nm.size());
  state.counters["nodes"] = nodes;
}

}  // namespace

BENCHMARK_CAPTURE(nodes_for_thirty, D65, "D65")->Arg(8)->Arg(12)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(nodes_for_thirty, FL11, "FL11")->Arg(8)->Arg(12)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(fewest_for_thirty, D65, "D65")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(fewest_for_thirty, FL11, "FL11")->Unit(benchmark::kMillisecond);
