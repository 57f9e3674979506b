// A spherical light: irradiance in closed form, and three ways of finding the light against each other.
#include <algorithm>
#include <glm/geometric.hpp>

#include "catch.h"
#include "render/frame.h"
#include "render/light_sampling.h"
#include "render/random.h"
#include "render/render.h"
#include "statistics.h"

using namespace gonio;
using gonio::test::Normality;

namespace {

constexpr Strategy kStrategies[] = {Strategy::mis, Strategy::light, Strategy::brdf};

RenderSettings settings(Strategy strategy, int spp) {
  RenderSettings chosen;
  chosen.spp = spp;
  chosen.strategy = strategy;
  return chosen;
}

/// One pixel of the ground (Lambert, kd = 1) at (x, 0, 0), seen under so narrow an angle that it is a point to 1e-5.
Scene ground_point(double x, std::vector<SphericalLight> lights) {
  Scene scene;
  scene.camera = {{x, -5, 5}, {x, 0, 0}, 0.1, 1, 1};
  scene.materials = {{"white", ModelSpec{ModelId::lambert}, {1}, "perfect", {}}};
  scene.ground = GroundObject{0, 100, 0};
  scene.lights = std::move(lights);
  scene.wavelengths_nm = {550};
  return scene;
}

/// Reflected radiance E/π of a sphere wholly above the horizon: E = π L sin²(half-angle) cos θ, exact at any distance.
double closed_form(double x, const SphericalLight& light) {
  const Vector away = light.center - Vector(x, 0, 0);
  const double d2 = glm::dot(away, away);
  return light.emission.radiance * light.radius * light.radius / d2 * away.z / std::sqrt(d2);
}

}  // namespace

TEST_CASE("irradiance of a spherical light, by light sampling, BRDF sampling and both", "[render]") {
  const SphericalLight light{{0, 0, 3}, 1, {5, "constant"}};
  for (const double x : {0.0, 2.0, 6.0}) {
    const double truth = closed_form(x, light);
    for (const Strategy strategy : kStrategies) {
      const RenderResult result = render(ground_point(x, {light}), settings(strategy, 200000));
      const double error = std::sqrt(result.variance[0]);
      INFO("x " << x << ", strategy " << int(strategy) << ": " << result.image.radiance[0] << " +- " << error
                << ", closed form " << truth);
      CHECK(std::abs(result.image.radiance[0] - truth) <= gonio::test::sidak_bound(9) * error + 1e-5 * truth);
      CHECK(error < (strategy == Strategy::brdf ? 0.03 : 0.002) * truth);
    }
  }
}

TEST_CASE("two lights add, also where one partly hides the other", "[render]") {
  const SphericalLight left{{-3, 0, 4}, 1, {5, "constant"}}, right{{2, 0, 3}, 0.5, {20, "constant"}};
  for (const Strategy strategy : kStrategies) {
    const RenderResult result = render(ground_point(0.5, {left, right}), settings(strategy, 200000));
    const double truth = closed_form(0.5, left) + closed_form(0.5, right);
    CHECK(std::abs(result.image.radiance[0] - truth) <= gonio::test::sidak_bound(3) * std::sqrt(result.variance[0]));
  }
  // The small light hangs inside the cone of the large one: seen from the origin it hides that part of it.
  const SphericalLight far{{0, 0, 6}, 2, {5, "constant"}}, near{{0, 0, 2}, 0.25, {7, "constant"}};
  const SphericalLight hidden{{0, 0, 2}, 0.25, {5, "constant"}};
  for (const Strategy strategy : kStrategies) {
    const RenderResult result = render(ground_point(0, {far, near}), settings(strategy, 200000));
    const double truth = closed_form(0, far) - closed_form(0, hidden) + closed_form(0, near);
    CHECK(std::abs(result.image.radiance[0] - truth) <= gonio::test::sidak_bound(3) * std::sqrt(result.variance[0]));
  }
}

TEST_CASE("light directions: uniform in the cone, and the density integrates to 1", "[render]") {
  const Vector point(0.3, -0.2, 0.1), center(1, 2, 5);
  for (const double radius : {0.01, 1.0, 5.0}) {
    const LightSampler lights({{center, radius, {1, "constant"}}});
    const double height = cone_height(point, center, radius);
    const Vector axis = glm::normalize(center - point);
    const Frame frame(axis);
    Random random(7, 0);
    constexpr int kCells = 8, kSamples = 40000;
    std::vector<double> seen(kCells * kCells);
    for (int s = 0; s < kSamples; ++s) {
      const double u0 = random.uniform(), u1 = random.uniform(), u2 = random.uniform();
      const LightDirection drawn = lights.sample(point, u0, u1, u2);
      const LocalDirection local = frame.to_local(drawn.direction);
      const double across2 = local.x * local.x + local.y * local.y;
      const double below = across2 / (1 + std::sqrt(1 - across2)) / height;  // 1 - cos, without cancellation
      const double turn = (std::atan2(local.y, local.x) + kPi<double>) / (2 * kPi<double>);
      const auto cell = [](double u) { return std::clamp(static_cast<int>(u * kCells), 0, kCells - 1); };
      seen[static_cast<std::size_t>(cell(below) * kCells + cell(turn))] += 1;
      if (drawn.pdf_per_sr > 0)  // the very rim may miss the sphere by a rounding
        CHECK(drawn.pdf_per_sr * 2 * kPi<double> * height == Approx(1).epsilon(1e-12));
    }
    CHECK(
        gonio::test::chi_square_agrees(seen, std::vector<double>(seen.size(), double(kSamples) / double(seen.size()))));
  }
}

TEST_CASE("light sampling, BRDF sampling and both agree pixel by pixel on rough metal", "[render]") {
  Scene scene =
      validation_scene({"rough", ModelSpec{ModelId::torrance_sparrow}, {0.2, 0.1, 0.9}, "perfect", {}}, {550});
  scene.camera.width = 24;
  scene.camera.height = 18;
  const RenderResult mis = render(scene, settings(Strategy::mis, 1500));
  for (const Strategy strategy : {Strategy::light, Strategy::brdf}) {
    RenderSettings other_settings = settings(strategy, strategy == Strategy::light ? 1500 : 6000);
    other_settings.seed = 2;
    const RenderResult other = render(scene, other_settings);
    // Rare bright paths make single pixels far from normal: the sums over blocks of 6 × 6 are compared.
    Normality z;
    for (int by = 0; by < 3; ++by) {
      for (int bx = 0; bx < 4; ++bx) {
        double difference = 0, variance = 0;
        for (int i = 0; i < 36; ++i) {
          const std::size_t p = mis.image.index(6 * bx + i % 6, 6 * by + i / 6);
          difference += mis.image.radiance[p] - other.image.radiance[p];
          variance += mis.variance[p] + other.variance[p];
        }
        z.add(difference / std::sqrt(variance));
      }
    }
    INFO("strategy " << int(strategy) << ": largest " << z.largest << ", mean z " << z.mean_z());
    CHECK(z.holds());
  }
}

TEST_CASE("both together are never much worse than the better one", "[render]") {
  Scene scene = validation_scene({"rough", ModelSpec{ModelId::torrance_sparrow}, {0.1, 0, 1}, "perfect", {}}, {550});
  scene.camera.width = scene.camera.height = 32;
  const auto noise = [&](Strategy strategy) {
    double sum = 0;
    for (const double variance : render(scene, settings(strategy, 64)).variance) sum += variance;
    return sum;
  };
  const double mis = noise(Strategy::mis), light = noise(Strategy::light), brdf = noise(Strategy::brdf);
  INFO("variance: both " << mis << ", light " << light << ", BRDF " << brdf);
  CHECK(mis < 1.2 * std::min(light, brdf));
}
