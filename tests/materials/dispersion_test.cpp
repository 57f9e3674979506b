// Dispersion formulas against values worked out by hand and each other.
#include "optics/dispersion.h"

#include <vector>

#include "catch.h"

using namespace gonio;

namespace {

double index(Dispersion formula, const std::vector<double>& c, double um) {
  return refractive_index<double>(formula, c, um);
}

}  // namespace

TEST_CASE("Each dispersion formula at numbers that can be checked by hand", "[materials]") {
  // w = 2 µm: w² = 4, w^-2 = 0.25.
  CHECK(index(Dispersion::kSellmeier, {0.25, 1.5, 1.0}, 2) == Approx(std::sqrt(1 + 0.25 + 1.5 * 4 / 3.0)));
  CHECK(index(Dispersion::kSellmeier2, {0.25, 1.5, 2.0}, 2) == Approx(std::sqrt(1 + 0.25 + 1.5 * 4 / 2.0)));
  CHECK(index(Dispersion::kPolynomial, {2.0, 0.5, 2.0, 1.0, -2.0}, 2) == Approx(std::sqrt(2 + 0.5 * 4 + 0.25)));
  CHECK(index(Dispersion::kRefractiveIndexInfo, {2.0, 3.0, 1.0, 1.5, 2.0}, 2) ==
        Approx(std::sqrt(2 + 3 * 2 / (4 - 2.25))));
  CHECK(index(Dispersion::kRefractiveIndexInfo, {2.0, 3.0, 1.0, 1.5, 2.0, 1.0, 0.0, 1.0, 1.0, 0.5, 2.0}, 2) ==
        Approx(std::sqrt(2 + 3 * 2 / (4 - 2.25) + 1 / 3.0 + 0.5 * 4)));
  CHECK(index(Dispersion::kCauchy, {1.5, 0.02, -2.0, 0.016, -4.0}, 2) == Approx(1.5 + 0.02 / 4 + 0.016 / 16));
  CHECK(index(Dispersion::kGases, {0.0, 0.05, 238.0185, 0.0016, 57.362}, 2) ==
        Approx(1 + 0.05 / (238.0185 - 0.25) + 0.0016 / (57.362 - 0.25)));
}

TEST_CASE("Air by Ciddor 1996 in the gas formula", "[materials]") {
  // Dry air, 15 °C, 101 325 Pa, 450 ppm CO2: n - 1 = 2.7773e-4 at 589.3 nm in vacuum.
  CHECK(index(Dispersion::kGases, {0.0, 0.05792105, 238.0185, 0.00167917, 57.362}, 0.5893) - 1 ==
        Approx(2.7717e-4).epsilon(1e-3));
}

TEST_CASE("Names and numbers of coefficients", "[materials]") {
  CHECK(dispersion_named("sellmeier-2") == Dispersion::kSellmeier2);
  CHECK(dispersion_named("gases") == Dispersion::kGases);
  CHECK_FALSE(dispersion_named("Sellmeier"));
  CHECK(takes_coefficients(Dispersion::kSellmeier, 7));
  CHECK_FALSE(takes_coefficients(Dispersion::kSellmeier, 0));
  CHECK_FALSE(takes_coefficients(Dispersion::kCauchy, 4));
  CHECK_FALSE(takes_coefficients(Dispersion::kRefractiveIndexInfo, 7));
  CHECK(takes_coefficients(Dispersion::kRefractiveIndexInfo, 9));
}

TEST_CASE("The formulas run in lanes of float", "[materials]") {
  const std::vector<double> bk7{0.0, 1.03961212, 0.00600069867, 0.231792344, 0.0200179144, 1.01046945, 103.560653};
  const FloatLanes n = refractive_index<FloatLanes>(Dispersion::kSellmeier2, bk7, FloatLanes(0.5875618f));
  CHECK(n.get(0) == Approx(1.51680).margin(2e-6));
}
