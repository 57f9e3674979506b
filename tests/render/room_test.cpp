// A closed room: no ray escapes it, and where walls shine and reflect alike its radiance is known exactly.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "catch.h"
#include "mean_radiance.h"
#include "render/random.h"
#include "render/rays.h"
#include "render/render.h"
#include "statistics.h"

using namespace gonio;
using gonio::test::Mean;
using gonio::test::mean_of;
using gonio::test::Normality;

namespace {

constexpr Strategy kStrategies[] = {Strategy::mis, Strategy::light, Strategy::brdf};

SceneMaterial lambert(double kd) { return {"lambert", ModelSpec{ModelId::lambert}, {kd}, "perfect", {}}; }

/// An empty room of 6 × 6 × 4 whose walls emit radiance 1 and reflect kd, seen into one of its corners.
Scene shining_room(double kd, int pixels) {
  Scene scene;
  scene.camera = {{0, -2.5, 2}, {3, 3, 0}, 60, pixels, pixels};
  scene.materials = {lambert(kd)};
  scene.room = Room{{-3, -3, 0}, {3, 3, 4}, 0, {1, "constant"}};
  scene.wavelengths_nm = {550};
  return scene;
}

RenderSettings settings(int spp, int max_depth = 1000, Strategy strategy = Strategy::mis) {
  RenderSettings chosen;
  chosen.spp = spp;
  chosen.max_depth = max_depth;
  chosen.strategy = strategy;
  return chosen;
}

/// Pixels against one truth.
Normality compare(const RenderResult& result, double truth) {
  Normality normality;
  for (std::size_t p = 0; p < result.image.pixels(); ++p)
    normality.add((result.image.radiance[p] - truth) / std::sqrt(result.variance[p]));
  return normality;
}

}  // namespace

TEST_CASE("no ray escapes a room: a million of them, into faces, edges and corners, and back from there", "[render]") {
  // Sides of 0.4 to 143; corners that no float and no double holds exactly.
  const Room room{{-0.1, 1.0 / 3, 2e-3}, {7.3, 0.7, 1000.0 / 7}};
  const RayScene rays({}, room);
  Random random(3, 0);
  const auto between = [&](double lo, double hi) { return lo + (hi - lo) * random.uniform(); };
  // On each axis the lower wall, the upper one, or neither: points inside, on faces, edges and corners.
  const auto any_point = [&] {
    Vector point;
    for (int a = 0; a < 3; ++a) {
      const double choice = between(0, 3);
      point[a] = choice < 1 ? room.lower[a] : choice < 2 ? room.upper[a] : between(room.lower[a], room.upper[a]);
    }
    return point;
  };
  Vector point = 0.5 * (room.lower + room.upper);
  std::size_t leaving = kNoShape;
  int escaped = 0, off_the_box = 0, off_the_ray = 0, short_of_target = 0, wrong_normal = 0;
  for (int r = 0; r < 1'000'000; ++r) {
    const Vector target = any_point();
    if (target == point) continue;
    const Vector direction = glm::normalize(target - point);
    const auto hit = rays.closest(point, direction, leaving);
    if (!hit || hit->shape != rays.room_shape()) {
      ++escaped;
      continue;
    }
    bool on_a_wall = false, within = true;
    for (int a = 0; a < 3; ++a) {
      within = within && hit->point[a] >= room.lower[a] && hit->point[a] <= room.upper[a];
      if (hit->normal[a] == 0) continue;
      on_a_wall = hit->point[a] == (hit->normal[a] > 0 ? room.lower : room.upper)[a];
    }
    off_the_box += !(within && on_a_wall);
    off_the_ray += glm::length(glm::cross(hit->point - point, direction)) > 1e-13 * 143;
    short_of_target += glm::dot(hit->point - target, direction) < -1e-13 * 143;
    wrong_normal += glm::length(hit->normal) != 1 || !(glm::dot(hit->normal, direction) < 0);
    point = hit->point;
    leaving = hit->shape;
  }
  CHECK(escaped == 0);
  CHECK(off_the_box == 0);
  CHECK(off_the_ray == 0);
  CHECK(short_of_target == 0);
  CHECK(wrong_normal == 0);
}

TEST_CASE("a start that rounding put behind a wall meets that wall at once", "[render]") {
  const Room room{{-3, -3, 0}, {3, 3, 4}};
  const RayScene rays({{Shape::Kind::sphere, {0, 0, 1}, 1}}, room);
  const auto hit = rays.closest({0, 0, -1e-16}, glm::normalize(Vector(1, 0, -1e-3)), 0);
  REQUIRE(hit);
  CHECK(hit->shape == rays.room_shape());
  CHECK(hit->point == Vector(0, 0, 0));
  CHECK(hit->normal == Vector(0, 0, 1));
  CHECK(rays.closest({0, 0, 3}, {0, 0, -1}, kNoShape)->shape == 0);  // what stands in the room comes first
}

TEST_CASE("white walls that shine: every path collects their radiance at each of its hits", "[render]") {
  // One path that escaped, or met the wall it left, would be seen: nothing here is random but the directions.
  const RenderResult result = render(shining_room(1, 32), settings(16, 100));
  const auto [least, most] = std::minmax_element(result.image.radiance.begin(), result.image.radiance.end());
  CHECK(*least == Approx(101).epsilon(1e-5));  // float throughputs of 100 reflections
  CHECK(*most == Approx(101).epsilon(1e-5));
  for (const double radiance : render(shining_room(0, 32), settings(4)).image.radiance) CHECK(radiance == 1);
}

TEST_CASE("walls that emit L and reflect kd shine with L/(1 - kd) wherever one looks", "[render]") {
  for (const double kd : {0.9, 0.5}) {
    const double truth = 1 / (1 - kd);
    const RenderResult result = render(shining_room(kd, 16), settings(kd == 0.9 ? 8192 : 1024));
    const Mean mean = mean_of(result);
    const Normality z = compare(result, truth);
    INFO("kd " << kd << ": mean " << mean.value << " +- " << mean.error << "; pixels: largest z " << z.largest
               << ", mean z " << z.mean_z());
    CHECK(std::abs(mean.value - truth) <= 3 * mean.error);
    CHECK(mean.value == Approx(truth).epsilon(0.002));
    CHECK(z.holds());
    CHECK_FALSE(compare(result, 1.01 * truth).holds());  // an error of 1 % is seen
  }
}

TEST_CASE("max_depth cuts the series of reflections where it says", "[render]") {
  for (const int max_depth : {0, 1, 8, 30}) {
    const Mean mean = mean_of(render(shining_room(0.9, 16), settings(512, max_depth)));
    const double truth = 10 * (1 - std::pow(0.9, max_depth + 1));
    INFO("depth " << max_depth << ": " << mean.value << " +- " << mean.error << ", truth " << truth);
    CHECK(std::abs(mean.value - truth) <= gonio::test::sidak_bound(4) * mean.error + 1e-6 * truth);
  }
}

TEST_CASE("walls shine in the colour of their illuminant", "[render]") {
  Scene scene = shining_room(0.5, 8);
  scene.room->emission = {3, "A"};
  scene.wavelengths_nm = {450, 560, 650};
  const RenderResult result = render(scene, settings(1024));
  for (std::size_t w = 0; w < 3; ++w) {
    double sum = 0, variance = 0;
    for (std::size_t v = w; v < result.variance.size(); v += 3) {
      sum += result.image.radiance[v];
      variance += result.variance[v];
    }
    const double truth = 64 * 2 * radiance_at(scene.room->emission, scene.wavelengths_nm[w]);
    CHECK(std::abs(sum - truth) <= gonio::test::sidak_bound(3) * std::sqrt(variance));
  }
}

TEST_CASE("a white sphere and a light of the room's own radiance vanish in it", "[render]") {
  Scene scene = shining_room(0.9, 16);
  scene.camera.look_at = {0, 0, 1.5};
  scene.materials.push_back(lambert(1));
  scene.spheres = {{{-0.5, 0.5, 1}, 1, 1}};
  scene.lights = {{{1.5, 0, 2.5}, 0.7, {10, "constant"}}};
  for (const Strategy strategy : kStrategies) {
    const Mean mean = mean_of(render(scene, settings(1024, 1000, strategy)));
    INFO("strategy " << int(strategy) << ": " << mean.value << " +- " << mean.error);
    CHECK(std::abs(mean.value - 10) <= gonio::test::sidak_bound(3) * mean.error);
  }
}

TEST_CASE("a grey sphere in the room shines with its reflectance of the room's radiance", "[render]") {
  // It emits nothing and takes from the room, whose mean falls to 10/(1 + A_sphere/A_walls): by 7e-6, it is so small.
  Scene scene = shining_room(0.9, 16);
  scene.camera = {{0, -1, 2}, {0, 0, 2}, 0.1, 16, 16};
  scene.spheres = {{{0, 0, 2}, 0.01, 0}};
  const RenderResult result = render(scene, settings(2048));
  const Mean mean = mean_of(result);
  INFO(mean.value << " +- " << mean.error);
  CHECK(std::abs(mean.value - 9) <= 3 * mean.error);
  CHECK(mean.value == Approx(9).epsilon(0.005));
  CHECK(compare(result, 9).holds());
}

TEST_CASE("a light in a dark room: light sampling, BRDF sampling and both agree", "[render]") {
  Scene scene = shining_room(0.8, 16);
  scene.room->emission.radiance = 0;
  scene.camera.look_at = {0, 0, 1.5};
  scene.materials.push_back({"rough", ModelSpec{ModelId::torrance_sparrow}, {0.3, 0.1, 0.8}, "perfect", {}});
  scene.spheres = {{{-0.5, 0.5, 1}, 1, 1}};
  scene.lights = {{{1.5, 0, 2.5}, 0.7, {10, "constant"}}};
  const Mean mis = mean_of(render(scene, settings(512)));
  CHECK(mis.value > 1);
  for (const Strategy strategy : {Strategy::light, Strategy::brdf}) {
    RenderSettings other_settings = settings(512, 1000, strategy);
    other_settings.seed = 2;
    const Mean other = mean_of(render(scene, other_settings));
    INFO("strategy " << int(strategy) << ": " << other.value << " +- " << other.error << ", both: " << mis.value
                     << " +- " << mis.error);
    CHECK(std::abs(other.value - mis.value) <= gonio::test::sidak_bound(2) * std::hypot(other.error, mis.error));
    CHECK(other.error < 0.02 * other.value);
  }
}
