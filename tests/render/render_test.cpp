// Same seed, same bits; variances that are what they say; rays in double.
#include "render/render.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/error.h"
#include "catch.h"
#include "render/random.h"
#include "render/rays.h"
#include "statistics.h"

using namespace gonio;

namespace {

SceneMaterial gold() { return {"gold", ModelSpec{ModelId::torrance_sparrow}, {0.2, 0, 1}, "Au_Johnson", {}}; }

Scene small(SceneMaterial material, std::vector<double> wavelengths = visible_wavelengths()) {
  Scene scene = validation_scene(std::move(material), std::move(wavelengths));
  scene.camera.width = 20;
  scene.camera.height = 15;
  return scene;
}

}  // namespace

TEST_CASE("1, 2 and 3 threads make the same bits; another seed other ones", "[render]") {
  const Scene scene = small(gold());
  RenderSettings settings;
  settings.spp = 8;
  std::vector<RenderResult> results;
  for (const int threads : {1, 2, 3}) {
    settings.threads = threads;
    results.push_back(render(scene, settings));
  }
  CHECK(results[0].image.radiance == results[1].image.radiance);
  CHECK(results[0].image.radiance == results[2].image.radiance);
  CHECK(results[0].variance == results[1].variance);
  settings.seed = 2;
  CHECK(results[0].image.radiance != render(scene, settings).image.radiance);
}

TEST_CASE("one wavelength alone is what it is among many, within the noise", "[render]") {
  RenderSettings settings;
  settings.spp = 400;
  Scene many = small(gold()), one = small(gold(), {550});
  one.lights.front().emission.illuminant = one.environment.illuminant = "D65";
  const RenderResult all = render(many, settings), alone = render(one, settings);
  const auto w550 = static_cast<std::size_t>(std::find(many.wavelengths_nm.begin(), many.wavelengths_nm.end(), 550) -
                                             many.wavelengths_nm.begin());
  double difference = 0, variance = 0;
  for (std::size_t p = 0; p < alone.image.pixels(); ++p) {
    difference += all.image.pixel(p)[w550] - alone.image.radiance[p];
    variance += all.variance[p * many.wavelengths_nm.size() + w550] + alone.variance[p];
  }
  CHECK(std::abs(difference) <= 4 * std::sqrt(variance));
}

TEST_CASE("the stated variance is that of repeated renders", "[render]") {
  Scene scene = small({"white", ModelSpec{ModelId::lambert}, {0.8}, "perfect", {}}, {550});
  scene.camera.width = scene.camera.height = 8;
  RenderSettings settings;
  settings.spp = 64;
  constexpr int kRepeats = 64;
  const std::size_t pixels = 64;
  std::vector<double> sum(pixels), squares(pixels), stated(pixels);
  for (int seed = 1; seed <= kRepeats; ++seed) {
    settings.seed = static_cast<std::uint64_t>(seed);
    const RenderResult result = render(scene, settings);
    for (std::size_t p = 0; p < pixels; ++p) {
      sum[p] += result.image.radiance[p];
      squares[p] += result.image.radiance[p] * result.image.radiance[p];
      stated[p] += result.variance[p] / kRepeats;
    }
  }
  double ratio = 0;
  for (std::size_t p = 0; p < pixels; ++p)
    ratio += (squares[p] - sum[p] * sum[p] / kRepeats) / (kRepeats - 1) / stated[p] / double(pixels);
  // Each ratio is χ²/(n-1) with variance 2/(n-1); their mean over 64 pixels deviates by √(2/63/64) = 0.022.
  INFO("variance of repeats over stated variance: " << ratio);
  CHECK(std::abs(ratio - 1) < 4 * 0.022 + 0.01);
}

TEST_CASE("closest hits against every shape tried in turn; points on the shape to double precision", "[render]") {
  Random random(9, 0);
  const auto between = [&](double lo, double hi) { return lo + (hi - lo) * random.uniform(); };
  std::vector<Shape> shapes{{Shape::Kind::disc, {0, 0, -2}, 8}};
  for (int s = 0; s < 30; ++s)
    shapes.push_back({Shape::Kind::sphere, {between(-5, 5), between(-5, 5), between(-1, 5)}, between(0.01, 0.6)});
  const RayScene rays(shapes);
  int hits = 0;
  for (int r = 0; r < 20000; ++r) {
    const Vector origin(between(-20, 20), between(-20, 20), between(6, 20));
    const Vector target(between(-5, 5), between(-5, 5), between(-2, 5));
    const Vector direction = glm::normalize(target - origin);
    std::size_t truth = kNoShape;
    double nearest = 1e300;
    for (std::size_t s = 0; s < shapes.size(); ++s) {
      double t = -1;
      if (shapes[s].kind == Shape::Kind::disc) {
        t = (shapes[s].center.z - origin.z) / direction.z;
        if (glm::distance(origin + t * direction, shapes[s].center) > shapes[s].radius) t = -1;
      } else {  // the textbook quadratic, smaller root
        const Vector away = origin - shapes[s].center;
        const double b = glm::dot(away, direction), c = glm::dot(away, away) - shapes[s].radius * shapes[s].radius;
        if (b * b >= c) t = -b - std::sqrt(b * b - c);
      }
      if (t > 0 && t < nearest) nearest = t, truth = s;
    }
    const auto hit = rays.closest(origin, direction, kNoShape);
    REQUIRE((hit ? hit->shape : kNoShape) == truth);
    if (!hit) continue;
    ++hits;
    const Shape& shape = shapes[hit->shape];
    if (shape.kind == Shape::Kind::sphere)
      CHECK(std::abs(glm::distance(hit->point, shape.center) - shape.radius) < 1e-14);
    else
      CHECK(hit->point.z == shape.center.z);
    CHECK(std::abs(glm::length(hit->normal) - 1) < 1e-14);
    CHECK(glm::length(glm::cross(hit->point - origin, direction)) < 1e-12 * glm::length(hit->point - origin));
  }
  CHECK(hits > 10000);
}

TEST_CASE("a ray does not meet the shape it leaves, and meets another one that touches it", "[render]") {
  const RayScene rays({{Shape::Kind::sphere, {0, 0, 1}, 1}, {Shape::Kind::disc, {0, 0, 0}, 10}});
  const double angle = 1e-7;  // just off the point of contact, towards the gap
  const Vector on_sphere(std::sin(angle), 0, 1 - std::cos(angle));
  const auto hit = rays.closest(on_sphere, glm::normalize(Vector(1, 0, -0.5)), 0);
  REQUIRE(hit);
  CHECK(hit->shape == 1);
  CHECK_FALSE(rays.closest(on_sphere, {0, 0, 1}, 0));
}

TEST_CASE("PCG32 is uniform and its streams differ", "[render]") {
  std::vector<double> seen(64);
  constexpr int kDraws = 64000;
  double correlation = 0;
  Random one(1, 0), next(1, 1);
  for (int d = 0; d < kDraws; ++d) {
    const double u = one.uniform(), v = next.uniform();
    CHECK((u > 0 && u < 1));
    seen[static_cast<std::size_t>(u * 64)] += 1;
    correlation += 12 * (u - 0.5) * (v - 0.5);
  }
  CHECK(gonio::test::chi_square_agrees(seen, std::vector<double>(64, kDraws / 64.0)));
  CHECK(std::abs(correlation) / std::sqrt(double(kDraws)) < gonio::test::sidak_bound(1));
}

TEST_CASE("every corner of every model's parameter box renders finite, non-negative radiances", "[render]") {
  RenderSettings settings;
  settings.spp = 4;
  settings.energy = EnergyRule::unchecked;
  for (const ModelInfo& info : models()) {
    const std::size_t corners = std::size_t{1} << info.parameters.size();
    for (std::size_t corner = 0; corner < corners; ++corner) {
      std::vector<double> values;
      for (std::size_t p = 0; p < info.parameters.size(); ++p)
        values.push_back((corner >> p & 1U) != 0 ? info.parameters[p].hi : info.parameters[p].lo);
      for (const char* material : {"Au_Johnson", "perfect"}) {
        const Scene scene = small({"corner", ModelSpec{info.id}, values, material, {}}, {400, 550, 700});
        const RenderResult result = render(scene, settings);
        std::size_t bad = 0;
        for (const double radiance : result.image.radiance) bad += !(std::isfinite(radiance) && radiance >= 0);
        INFO(info.name << ", corner " << corner << ", " << material << ": " << bad << " values");
        CHECK(bad == 0);
        CHECK(result.dropped_paths == 0);
      }
    }
  }
}

TEST_CASE("what cannot be rendered is refused", "[render]") {
  RenderSettings settings;
  settings.spp = 0;
  CHECK_THROWS_AS(render(small(gold()), settings), InputError);
  settings.spp = 1;
  Scene inside = small(gold());
  inside.camera.position = {0, 0, 1};
  CHECK_THROWS_AS(render(inside, settings), InputError);
  CHECK_THROWS_AS(render(small(gold(), {10000}), settings), InputError);  // outside the table's range
  Scene huge = small(gold());
  huge.camera.width = huge.camera.height = 16384;
  CHECK_THROWS_AS(render(huge, settings), InputError);
  CHECK_THROWS_AS(strategy_from("best"), InputError);
}

TEST_CASE("a sphere with a sum of lobes shows the sum of two images", "[render]") {
  // No other object and a dark sky: one reflection, linear in f. The light itself is out of sight.
  const auto image = [](const LobeSum& model, std::vector<double> values) {
    Scene scene;
    scene.camera = {{0, -8, 0}, {0, 0, 0}, 16, 24, 24};
    scene.materials = {{"tested", model, std::move(values), "Au_Johnson", {}}};
    scene.spheres = {{{0, 0, 0}, 1, 0}};
    scene.lights = {{{-4, -6, 5}, 2, {9, "constant"}}};
    scene.wavelengths_nm = {450, 550, 650};
    RenderSettings settings;
    settings.spp = 512;
    return render(scene, settings);
  };
  const RenderResult sum = image(lobe_sum("ggx+torrance-sparrow"), {0.2, 0.3, 0.5, 0.15, 0.4, 0.3});
  const RenderResult first = image(ModelSpec{ModelId::ggx}, {0.2, 0.3, 0.15, 0.4});
  const RenderResult second = image(ModelSpec{ModelId::torrance_sparrow}, {0.5, 0, 0.3});
  gonio::test::Normality z;
  constexpr std::size_t kBlock = 36 * 3;  // pixels in a row times wavelengths: near to normal
  for (std::size_t from = 0; from + kBlock <= sum.image.radiance.size(); from += kBlock) {
    for (std::size_t w = 0; w < 3; ++w) {
      double difference = 0, variance = 0;
      for (std::size_t k = from + w; k < from + kBlock; k += 3) {
        difference += sum.image.radiance[k] - first.image.radiance[k] - second.image.radiance[k];
        variance += sum.variance[k] + first.variance[k] + second.variance[k];
      }
      if (variance > 0) z.add(difference / std::sqrt(variance));
    }
  }
  INFO(z.count << " blocks, largest " << z.largest << ", mean z " << z.mean_z());
  CHECK(z.count > 20);
  CHECK(z.largest <= gonio::test::sidak_bound(z.count));
}

TEST_CASE("values of each wavelength that are all alike make the bits of shared ones", "[render]") {
  RenderSettings settings;
  settings.spp = 8;
  SceneMaterial shared = gold();
  shared.values = {0.2, 0.125, 0.5};
  SceneMaterial listed = shared;
  listed.by_wavelength.assign(visible_wavelengths().size(), shared.values);
  CHECK(render(small(shared), settings).image.radiance == render(small(listed), settings).image.radiance);
}
