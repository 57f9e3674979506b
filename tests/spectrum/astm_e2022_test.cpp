// Weights by the method of ASTM E2022 against the printed tables of ASTM E308 and direct summation.
#include "spectrum/astm_e2022.h"

#include "base/error.h"
#include "catch.h"
#include "materials/color_entries.h"

using namespace gonio;

namespace {

Spectrum light(std::string_view id) { return light_of(Database::bundled().find(id)); }
Observer eye(std::string_view id) { return observer_of(Database::bundled().find(id)); }

}  // namespace

TEST_CASE("E308's printed weights: illuminant A, 10 degree observer, 20 nm", "[spectrum]") {
  const double table[24][3] = {
      // ASTM E308, table 5, 360 to 820 nm
      {-0.000, -0.000, -0.001}, {-0.009, -0.001, -0.041}, {0.060, 0.005, 0.257},   {0.773, 0.078, 3.697},
      {1.900, 0.304, 9.755},    {1.971, 0.855, 11.487},   {0.718, 2.146, 6.785},   {0.043, 4.899, 2.321},
      {1.522, 9.647, 0.743},    {5.677, 14.461, 0.196},   {12.445, 17.474, 0.005}, {20.554, 17.584, -0.003},
      {25.332, 14.896, 0.000},  {21.571, 10.080, 0.000},  {12.179, 5.068, 0.000},  {4.668, 1.830, 0.000},
      {1.324, 0.513, 0.000},    {0.318, 0.123, 0.000},    {0.075, 0.029, 0.000},   {0.018, 0.007, 0.000},
      {0.005, 0.002, 0.000},    {0.001, 0.001, 0.000},    {0.000, 0.000, 0.000},   {0.000, 0.000, 0.000}};
  const ColorWeights weights = astm_e2022_weights(light("A"), eye("1964-10"), 360, 820, 20);
  REQUIRE(weights.x.size() == 24);
  for (std::size_t i = 0; i < 24; ++i) {
    INFO(weights.wavelength_nm[i] << " nm");
    CHECK(weights.x[i] == Approx(table[i][0]).margin(6e-4).epsilon(0));  // the table has three decimals
    CHECK(weights.y[i] == Approx(table[i][1]).margin(6e-4).epsilon(0));
    CHECK(weights.z[i] == Approx(table[i][2]).margin(6e-4).epsilon(0));
  }
  const ColorWeights ten = astm_e2022_weights(light("A"), eye("1964-10"), 360, 830, 10);
  CHECK(ten.y[20] == Approx(8.758).margin(6e-4).epsilon(0));  // 560 nm
  CHECK(ten.x[24] == Approx(12.746).margin(6e-4).epsilon(0));
  CHECK(ten.z[10] == Approx(5.812).margin(6e-4).epsilon(0));
}

TEST_CASE("Polynomials are weighed exactly: cubic inside, quadratic at the ends", "[spectrum]") {
  for (const double step : {5.0, 10.0, 20.0})
    for (const double degree : {0.0, 1.0, 2.0}) {
      const Factor power{0, 1e9, [&](double nm) { return std::pow((nm - 300) / 500, degree); }};
      const ColorSum direct = color_of(power, light("A"), eye("1931-2"));
      const ColorSum weighed = color_by_weights(power, astm_e2022_weights(light("A"), eye("1931-2"), 360, 840, step));
      CHECK(weighed.xyz.x == Approx(direct.xyz.x).epsilon(1e-12));
      CHECK(weighed.xyz.y == Approx(direct.xyz.y).epsilon(1e-12));
      CHECK(weighed.xyz.z == Approx(direct.xyz.z).epsilon(1e-12));
      CHECK(weighed.white.y == Approx(100).epsilon(1e-13));
    }
}

TEST_CASE("At 1 nm the weights are color_of's sum", "[spectrum]") {
  const Factor wavy{300, 900, [](double nm) { return 0.5 + 0.4 * std::sin(nm / 17); }};
  const ColorSum direct = color_of(wavy, light("A"), eye("1964-10"));
  const ColorSum weighed = color_by_weights(wavy, astm_e2022_weights(light("A"), eye("1964-10"), 360, 830, 1));
  CHECK(weighed.xyz.x == Approx(direct.xyz.x).epsilon(1e-13));
  CHECK(weighed.xyz.z == Approx(direct.xyz.z).epsilon(1e-13));
  const ColorSum ten = color_by_weights(wavy, astm_e2022_weights(light("A"), eye("1964-10"), 360, 830, 10));
  CHECK(ten.xyz.y == Approx(direct.xyz.y).epsilon(2e-3));  // a wave of 107 nm, by cubics of 10 nm
}

TEST_CASE("On real reflectances the weights are within 0.1 of the sum", "[spectrum]") {
  double worst_10 = 0, worst_20 = 0;
  for (const Entry* entry : Database::bundled().all()) {
    if (!entry->id.starts_with("colorchecker-ohta")) continue;
    const Factor patch = factor_of(entry->id);
    const ColorSum direct = color_of(patch, light("D65"), eye("1931-2"));
    const auto with = [&](double step) {
      return color_by_weights(patch, astm_e2022_weights(light("D65"), eye("1931-2"), 380, 780, step));
    };
    const auto off = [&](const ColorSum& sum) {
      return color_difference(color_values(direct), color_values(sum)).e2000;
    };
    CHECK(off(with(1)) < 0.02);  // the light's tails below 380 nm, where the patches are not known
    worst_10 = std::max(worst_10, off(with(10))), worst_20 = std::max(worst_20, off(with(20)));
  }
  INFO("worst Delta E_2000 at 10 nm " << worst_10 << ", at 20 nm " << worst_20);
  CHECK(worst_10 < 0.12);  // 0.08: the direct sum is linear between the chart's 5 nm points, the weights are cubic
  CHECK(worst_20 < 0.15);  // 0.10
  CHECK(worst_20 > worst_10);
}

TEST_CASE("Weights ask for a grid of whole nanometres", "[spectrum]") {
  CHECK_THROWS_AS(astm_e2022_weights(light("A"), eye("1931-2"), 380, 785, 10), InputError);
  CHECK_THROWS_AS(astm_e2022_weights(light("A"), eye("1931-2"), 380.5, 780.5, 10), InputError);
  CHECK_THROWS_AS(astm_e2022_weights(light("A"), eye("1931-2"), 380, 390, 10), InputError);
  const Factor short_data{400, 700, [](double) { return 0.5; }, "patch"};
  CHECK_THROWS_WITH(color_by_weights(short_data, astm_e2022_weights(light("A"), eye("1931-2"), 380, 780, 10)),
                    Catch::Contains("patch: known from 400 to 700 nm"));
}
