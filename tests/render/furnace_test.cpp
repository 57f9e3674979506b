// White furnaces: what a constant environment shows is known exactly.
#include <glm/geometric.hpp>

#include "brdf/lobe_sum.h"
#include "catch.h"
#include "energy/directional_reflectance.h"
#include "render/render.h"
#include "statistics.h"

using namespace gonio;
using gonio::test::Normality;

namespace {

constexpr double kDistance = 8, kFov_deg = 16;
constexpr int kPixels = 24;

Scene furnace(const LobeSum& model, std::vector<double> values) {
  Scene scene;
  scene.camera = {{0, -kDistance, 0}, {0, 0, 0}, kFov_deg, kPixels, kPixels};
  scene.materials = {{"tested", model, std::move(values), "perfect", {}}};
  scene.materials[0].may_gain = true;  // Kirchhoff's lobe grows without bound next to grazing
  scene.spheres = {{{0, 0, 0}, 1, 0}};
  scene.environment = {1, "constant"};
  scene.wavelengths_nm = {550};
  return scene;
}

/// Angle between the eye and the unit sphere's normal where a ray meets it; negative where it misses. Own geometry: the
/// ray leaves the eye under an angle a from the axis, sin θ = distance·sin a.
double view_angle_deg(double x, double y) {
  const double scale = 2 * std::tan(kFov_deg * kPi<double> / 360) / kPixels;
  const double tan_a = scale * std::hypot(x - 0.5 * kPixels, y - 0.5 * kPixels);
  const double sine = kDistance * tan_a / std::sqrt(1 + tan_a * tan_a);
  return sine >= 1 ? -1 : std::asin(sine) * 180 / kPi<double>;
}

/// A curve over 0 to 89.5 degrees in steps of half a degree, linear between.
template <class Curve>
std::vector<double> tabulated(Curve curve) {
  std::vector<double> table;
  for (int i = 0; i < 180; ++i) table.push_back(curve(0.5 * i));
  return table;
}
double at(const std::vector<double>& table, double theta_deg) {
  const double x = std::min(2 * theta_deg, 178.999);
  const auto i = static_cast<std::size_t>(x);
  return table[i] + (x - static_cast<double>(i)) * (table[i + 1] - table[i]);
}

/// Each pixel that the sphere fills against the mean of `table` over it.
Normality compare(const RenderResult& result, const std::vector<double>& table) {
  Normality normality;
  constexpr int kSub = 10;
  for (int y = 0; y < kPixels; ++y) {
    for (int x = 0; x < kPixels; ++x) {
      double mean = 0, widest = 0;
      bool filled = true;
      for (int s = 0; s < kSub * kSub; ++s) {
        const double theta = view_angle_deg(x + (s % kSub + 0.5) / kSub, y + (s / kSub + 0.5) / kSub);
        filled = filled && theta >= 0;
        widest = std::max(widest, theta);
        mean += theta >= 0 ? at(table, theta) / (kSub * kSub) : 0;
      }
      if (!filled || widest > 80) continue;  // the table's last degrees bend too much for a straight line
      const std::size_t p = result.image.index(x, y);
      // The float radiances of single paths are rounded to 6e-8 each.
      normality.add((result.image.radiance[p] - mean) / std::sqrt(result.variance[p] + 1e-14));
    }
  }
  return normality;
}

std::vector<double> reflectances(const ModelSpec& spec, const std::vector<double>& values, bool coherent = false) {
  const Brdf<double> brdf = make_brdf<double>(spec, values);
  const SpectralSurface surface{{perfect_interface<double>()}, {0.55}};
  return tabulated([&](double theta_deg) {
    const double energy = directional_reflectance(brdf.lobe, theta_deg, surface, 1e-6).front().value;
    const double cosine = std::cos(theta_deg * kPi<double> / 180);
    return energy + (coherent ? coherent_energy(brdf, cosine, perfect_interface<double>(), 0.55) : 0.0);
  });
}

RenderSettings settings(int spp, Strategy strategy = Strategy::mis) {
  RenderSettings chosen;
  chosen.spp = spp;
  chosen.max_depth = 1000;
  chosen.strategy = strategy;
  return chosen;
}

}  // namespace

TEST_CASE("white furnace: a Lambert sphere vanishes", "[render]") {
  Scene scene = furnace(ModelSpec{ModelId::lambert}, {1});
  for (const bool lit : {false, true}) {
    // A light of the environment's own radiance changes nothing, but exercises light sampling and its weights.
    if (lit) scene.lights = {{{-3, -3, 3}, 1.5, {1, "constant"}}};
    const RenderResult result = render(scene, settings(64));
    double mean = 0, variance = 0;
    for (std::size_t p = 0; p < result.image.pixels(); ++p) {
      mean += (result.image.radiance[p] - 1) / double(result.image.pixels());
      variance += result.variance[p] / std::pow(double(result.image.pixels()), 2);
    }
    INFO("mean of pixel - 1: " << mean << ", standard error " << std::sqrt(variance));
    CHECK(std::abs(mean) <= 3 * std::sqrt(variance) + 1e-6);  // 1e-6: float radiances
    if (!lit) CHECK(*std::max_element(result.variance.begin(), result.variance.end()) < 1e-12);
  }
}

TEST_CASE("white furnace: sphere, ground and light all vanish together", "[render]") {
  Scene scene = furnace(ModelSpec{ModelId::lambert}, {1});
  scene.camera = {{0, -6, 3}, {0, 0, 0}, 30, kPixels, kPixels};
  scene.materials.push_back({"white ground", ModelSpec{ModelId::lambert}, {1}, "perfect", {}});
  scene.ground = GroundObject{-1, 50, 1};
  scene.lights = {{{-3, -3, 3}, 1, {1, "constant"}}, {{3, -2, 3}, 0.5, {1, "constant"}}};
  for (const Strategy strategy : {Strategy::mis, Strategy::light, Strategy::brdf}) {
    const RenderResult result = render(scene, settings(256, strategy));
    double mean = 0, variance = 0;
    for (std::size_t p = 0; p < result.image.pixels(); ++p) {
      mean += (result.image.radiance[p] - 1) / double(result.image.pixels());
      variance += result.variance[p] / std::pow(double(result.image.pixels()), 2);
    }
    INFO("strategy " << int(strategy) << ": mean " << mean << ", standard error " << std::sqrt(variance));
    CHECK(std::abs(mean) <= 4 * std::sqrt(variance) + 1e-6);
  }
}

TEST_CASE("white furnace: a rough white lobe darkens by exactly its directional reflectance", "[render][slow]") {
  for (const Shadowing shadowing : {Shadowing::smith_correlated, Shadowing::v_cavity}) {
    for (const double m : {0.3, 0.6}) {
      const ModelSpec spec{ModelId::torrance_sparrow, shadowing};
      const RenderResult result = render(furnace(spec, {m, 0, 1}), settings(4096));
      const std::vector<double> table = reflectances(spec, {m, 0, 1});
      const Normality z = compare(result, table);
      INFO("m " << m << ", " << name_of(shadowing) << ": " << z.count << " pixels, " << z.beyond_4
                << " beyond 4, largest " << z.largest << ", mean z " << z.mean_z() << ", spread z " << z.spread_z());
      CHECK(z.count > 250);
      CHECK(z.holds());
      CHECK(std::abs(z.spread_z()) < 5);
      std::vector<double> wrong = table;
      for (double& value : wrong) value *= 1.005;
      CHECK_FALSE(compare(result, wrong).holds());  // an error of 0.5 % is seen
    }
  }
}

TEST_CASE("white furnace: pseudo-realistic lobe with its diffuse part", "[render][slow]") {
  const ModelSpec spec{ModelId::pseudo_realistic};
  const std::vector<double> values{0.3, 0.25, 0.8};
  std::vector<double> table = reflectances(spec, values);
  for (double& value : table) value = 0.25 + 0.8 * value;
  const Normality z = compare(render(furnace(spec, values), settings(4096)), table);
  INFO(z.beyond_4 << " beyond 4, largest " << z.largest << ", mean z " << z.mean_z());
  CHECK(z.holds());
}

TEST_CASE("white furnace: Beckmann-Kirchhoff, coherent delta and incoherent lobe together", "[render][slow]") {
  const ModelSpec spec{ModelId::beckmann_kirchhoff};
  for (const double sigma_um : {0.03, 0.08}) {
    const std::vector<double> values{sigma_um, 2, 0, 1};
    const Normality z = compare(render(furnace(spec, values), settings(4096)), reflectances(spec, values, true));
    INFO("sigma " << sigma_um << ": " << z.beyond_4 << " beyond 4, largest " << z.largest << ", mean z " << z.mean_z());
    CHECK(z.holds());
  }
}

TEST_CASE("white furnace: a sum of lobes, one of them with a delta, over a diffuse part", "[render][slow]") {
  const LobeSum model = lobe_sum("torrance-sparrow+beckmann-kirchhoff");
  const std::vector<double> values{0.3, 0.05, 2, 0.2, 0.3, 0.4};
  std::vector<double> table = reflectances(model.lobes()[0], {0.3, 0, 1});
  const std::vector<double> second = reflectances(model.lobes()[1], {0.05, 2, 0, 1}, true);
  for (std::size_t i = 0; i < table.size(); ++i) table[i] = 0.2 + 0.3 * table[i] + 0.4 * second[i];
  const Normality z = compare(render(furnace(model, values), settings(4096)), table);
  INFO(z.beyond_4 << " beyond 4, largest " << z.largest << ", mean z " << z.mean_z());
  CHECK(z.holds());
}
