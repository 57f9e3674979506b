// Energy in pictures: materials that gain are refused, and what single scattering loses can be given back.
#include <cmath>

#include "base/error.h"
#include "catch.h"
#include "mean_radiance.h"
#include "render/render.h"

using namespace gonio;
using gonio::test::Mean;
using gonio::test::mean_of;

namespace {

SceneMaterial facets(const char* model_name, double width, double ks,
                     CompensationKind compensation = CompensationKind::none) {
  ModelSpec spec;
  spec.id = model(model_name).id;
  std::vector<double> values;
  for (const ParameterInfo& p : spec.info().parameters)
    values.push_back(p.name == "ks" ? ks : p.fallback.value_or(width));
  SceneMaterial material{"tested", spec, values, "perfect", {}};
  material.compensation = compensation;
  return material;
}

Scene shining_room(SceneMaterial walls, int pixels) {
  Scene scene;
  scene.camera = {{0, -2.5, 2}, {3, 3, 0}, 60, pixels, pixels};
  scene.materials = {std::move(walls)};
  scene.room = Room{{-3, -3, 0}, {3, 3, 4}, 0, {1, "constant"}};
  scene.wavelengths_nm = {550};
  return scene;
}

Scene furnace(SceneMaterial material) {
  Scene scene;
  scene.camera = {{0, -8, 0}, {0, 0, 0}, 13, 16, 16};
  scene.materials = {std::move(material)};
  scene.spheres = {{{0, 0, 0}, 1, 0}};
  scene.environment = {1, "constant"};
  scene.wavelengths_nm = {550};
  return scene;
}

std::string refusal(const Scene& scene) {
  try {
    RenderSettings settings;
    settings.spp = 1;
    render(scene, settings);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("a compensated rough sphere vanishes in a white furnace", "[render][compensation]") {
  for (const auto& [name, width] : {std::pair("torrance-sparrow", 0.6), {"torrance-sparrow", 0.05}, {"ggx", 0.9}}) {
    RenderSettings settings;
    settings.spp = 1500;
    const Mean with = mean_of(render(furnace(facets(name, width, 1, CompensationKind::kulla_conty_2017)), settings));
    INFO(name << " " << width << ": " << with.value << " ± " << with.error);
    CHECK(std::abs(with.value - 1) <= 3 * with.error + 1e-4);
    CHECK(with.error < 2e-3);
  }
}

TEST_CASE("a closed room whose walls shine and reflect 0.9 of the compensated white lobe holds ten times their light",
          "[render][compensation][slow]") {
  RenderSettings settings;
  settings.spp = 128;
  settings.max_depth = 1000;
  const Mean mean = mean_of(
      render(shining_room(facets("torrance-sparrow", 0.5, 0.9, CompensationKind::kulla_conty_2017), 128), settings));
  INFO(mean.value << " ± " << mean.error);
  CHECK(std::abs(mean.value - 10) <= 3 * mean.error);
  CHECK(std::abs(mean.value - 10) <= 0.02);
}

TEST_CASE("materials that reflect more than they receive are refused with the number, unless told otherwise",
          "[render][energy]") {
  const Scene gains = furnace(facets("pseudo-realistic", 1, 1));
  const std::string text = refusal(gains);
  INFO(text);
  CHECK(text.find("material tested: kd rho_d + ks E is 1.") != std::string::npos);
  CHECK(text.find("(43) is broken by 0.") != std::string::npos);
  CHECK(text.find("allow-gain") != std::string::npos);

  RenderSettings settings;
  settings.spp = 1;
  settings.energy = EnergyRule::allow_gain;
  CHECK(render(gains, settings).gains.size() == 1);
  Scene told = gains;
  told.materials[0].may_gain = true;
  settings.energy = EnergyRule::conserve;
  CHECK(render(told, settings).gains.size() == 1);

  // Every model in the middle of its box renders, and its E is finite.
  settings.energy = EnergyRule::allow_gain;
  for (const ModelInfo& info : models()) {
    SceneMaterial material{"tested", ModelSpec{info.id}, {}, "perfect", {}};
    for (const ParameterInfo& p : info.parameters)
      material.values.push_back(p.fallback.value_or(std::sqrt(p.fit_lo * p.fit_hi)));
    for (double& value : material.values) value = std::isfinite(value) ? value : 0.3;
    INFO(info.name);
    const Mean mean = mean_of(render(furnace(material), settings));
    CHECK((std::isfinite(mean.value) && mean.value >= 0));
  }

  // Inside the limit nothing is said; a lobe without bound always breaks it.
  CHECK(refusal(furnace(facets("pseudo-realistic", 1, 0.5))) == "accepted");
  CHECK(refusal(furnace(facets("ward-1992", 0.2, 0.1))).find("without bound") != std::string::npos);
  CHECK(refusal(furnace(facets("torrance-sparrow", 0.05, 1))) == "accepted");
  SceneMaterial both = facets("torrance-sparrow", 0.3, 0.7);
  both.values[both.model.index_of("kd")] = 0.4;
  const std::string of_both = refusal(furnace(both));
  INFO(of_both);
  CHECK(of_both.find("(43) is broken by 0.1") != std::string::npos);
  CHECK(
      refusal(furnace(facets("pseudo-realistic", 1, 0.5, CompensationKind::kulla_conty_2017))).find("to compensate") !=
      std::string::npos);
}
