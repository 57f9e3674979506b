// Metamers: same colour under one light, smooth, physical, different under another; sensors of any curves.
#include "spectrum/metamer.h"

#include <random>

#include "base/error.h"
#include "catch.h"
#include "materials/color_entries.h"
#include "spectrum/sensor.h"

using namespace gonio;

namespace {

const Spectrum& d65() {
  static const Spectrum light = light_of(Database::bundled().find("D65"));
  return light;
}
const Spectrum& incandescent() {
  static const Spectrum light = light_of(Database::bundled().find("A"));
  return light;
}
const Observer& eye() {
  static const Observer observer = observer_of(Database::bundled().find("1931-2"));
  return observer;
}

std::vector<double> second_differences(const std::vector<double>& v) {
  std::vector<double> d;
  for (std::size_t i = 1; i + 1 < v.size(); ++i) d.push_back(v[i - 1] - 2 * v[i] + v[i + 1]);
  return d;
}

/// Removes from v what the rows see (Gram-Schmidt).
void make_black(std::vector<double>& v, std::vector<std::vector<double>> rows) {
  const auto dot = [](const auto& a, const auto& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
  };
  for (int pass = 0; pass < 2; ++pass)
    for (std::size_t r = 0; r < rows.size(); ++r) {
      if (pass == 0) {
        for (std::size_t s = 0; s < r; ++s) {
          const double c = dot(rows[r], rows[s]);
          for (std::size_t i = 0; i < v.size(); ++i) rows[r][i] -= c * rows[s][i];
        }
        const double length = std::sqrt(dot(rows[r], rows[r]));
        for (double& x : rows[r]) x /= length;
      }
      const double c = dot(v, rows[r]);
      for (std::size_t i = 0; i < v.size(); ++i) v[i] -= c * rows[r][i];
    }
}

}  // namespace

TEST_CASE("A metamer has its colour under the first light and another under the second", "[spectrum]") {
  for (const char* id : {"neutral-5", "red", "foliage", "blue-sky", "white-9.5"}) {
    INFO(id);
    const Factor patch = factor_of(fmt::format("colorchecker-ohta-{}", id));
    const Metamer metamer = metamer_of(patch, d65(), incandescent(), eye());
    CHECK(metamer.delta_e_first < 1e-6);
    CHECK(metamer.delta_e_second > 0.3);
    for (const double r : metamer.reflectance.value) CHECK((r >= 0 && r <= 1));
    // The same, summed here from the returned curve.
    double y = 0, y_original = 0, white = 0;
    for (std::size_t i = 0; i < metamer.reflectance.value.size(); ++i) {
      const double nm = metamer.reflectance.wavelength_nm[i], weight = d65().at(nm) * eye().at(nm).y;
      y += weight * metamer.reflectance.value[i], y_original += weight * patch.at(nm), white += weight;
    }
    CHECK(y / white == Approx(y_original / white).epsilon(1e-9));
  }
}

TEST_CASE("The black added is the smoothest of its shift", "[spectrum]") {
  // At the least of Σ(second differences)² under linear constraints, the gradient has no part along any change that
  // keeps the constraints: any vector that neither light sees.
  const Factor grey{360, 830, [](double) { return 0.5; }};
  const Metamer metamer = metamer_of(grey, d65(), incandescent(), eye());
  std::vector<double> black;
  std::vector<std::vector<double>> rows(6);
  for (std::size_t i = 0; i < metamer.reflectance.value.size(); ++i) {
    black.push_back(metamer.reflectance.value[i] - metamer.original.value[i]);
    const double nm = metamer.reflectance.wavelength_nm[i];
    const Xyz<double> c = eye().at(nm);
    int row = 0;
    for (const Spectrum* light : {&d65(), &incandescent()})
      for (const double weight : {c.x, c.y, c.z}) rows[row++].push_back(light->at(nm) * weight);
  }
  const std::vector<double> curvature = second_differences(black);
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 5; ++trial) {
    std::vector<double> change;
    for (std::size_t i = 0; i < black.size(); ++i) change.push_back(normal(random));
    make_black(change, rows);
    const std::vector<double> change_curvature = second_differences(change);
    double product = 0, a = 0, b = 0;
    for (std::size_t i = 0; i < curvature.size(); ++i)
      product += curvature[i] * change_curvature[i], a += square(curvature[i]), b += square(change_curvature[i]);
    CHECK(std::abs(product) / std::sqrt(a * b) < 1e-8);
  }
}

TEST_CASE("Where no metamer can be", "[spectrum]") {
  const Factor white{360, 830, [](double) { return 1.0; }};
  CHECK(metamer_of(white, d65(), incandescent(), eye()).delta_e_second == 0);
  const Factor grey{360, 830, [](double) { return 0.5; }}, bright{360, 830, [](double) { return 1.5; }};
  CHECK_THROWS_WITH(metamer_of(grey, d65(), d65(), eye()), Catch::Contains("expects two different lights"));
  CHECK_THROWS_AS(metamer_of(bright, d65(), incandescent(), eye()), InputError);
}

TEST_CASE("A sensor of the eye's curves answers as the eye", "[spectrum]") {
  const Factor patch = factor_of("colorchecker-ohta-orange");
  const Sensor as_eye{{"xbar", "ybar", "zbar"}, eye().wavelength_nm, {eye().xbar, eye().ybar, eye().zbar}};
  REQUIRE(is_colorimetric(as_eye));
  const ColorSum sum = color_of(patch, d65(), colorimetric(as_eye));
  const auto response = responses_of(patch, d65(), as_eye);
  CHECK(response[0].value == Approx(100 * sum.xyz.x / sum.white.x).epsilon(1e-13));
  CHECK(response[1].value == Approx(sum.xyz.y).epsilon(1e-13));
  CHECK(response[2].value == Approx(100 * sum.xyz.z / sum.white.z).epsilon(1e-13));
}

TEST_CASE("A film that sees beyond the data is partial, a blind channel refused", "[spectrum]") {
  const Factor step{400, 700, [](double nm) { return nm < 600 ? 0.2 : 0.8; }, "step"};
  const Sensor film{{"red", "infrared"}, {600, 700, 900}, {{1, 1, 0}, {0, 0, 1}}, "film"};
  CHECK_THROWS_WITH(responses_of(step, d65(), film), Catch::Contains("channel red"));
  const Sensor narrow{{"red"}, {610, 650, 690}, {{0, 1, 0}}};
  CHECK_FALSE(is_colorimetric(narrow));
  CHECK(responses_of(step, d65(), narrow)[0].value == Approx(80).epsilon(1e-12));
  const Sensor blind{{"ultraviolet"}, {200, 250}, {{1, 1}}};
  CHECK_THROWS_AS(responses_of(step, d65(), blind), InputError);
}
