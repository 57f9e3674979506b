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

TEST_CASE("Formulas 7 to 9 by hand on their published definitions", "[materials]") {
  // w = 2 µm: w² = 4, L = 1/3.972. Each term is computed by itself.
  const double l = 1 / 3.972;
  CHECK(index(Dispersion::kHerzberger, {3.4, 0.15, 0.03, -2e-4, 1e-6, -3e-9}, 2) ==
        Approx(3.4 + 0.15 * l + 0.03 * l * l - 2e-4 * 4 + 1e-6 * 16 - 3e-9 * 64).epsilon(1e-14));
  CHECK(index(Dispersion::kHerzberger, {3.4, 0.15, 0.03}, 2) == Approx(3.4 + 0.15 * l + 0.03 * l * l).epsilon(1e-14));
  // (n² - 1)/(n² + 2) = 0.2 + 0.1·4/(4 - 0.04) + 0.005·4: the definition itself holds for the result.
  const double n8 = index(Dispersion::kRetro, {0.2, 0.1, 0.04, 0.005}, 2);
  CHECK((n8 * n8 - 1) / (n8 * n8 + 2) == Approx(0.2 + 0.4 / 3.96 + 0.02).epsilon(1e-14));
  CHECK(index(Dispersion::kExotic, {2.3, 0.05, 0.02, 0.01, 1.5, 0.3}, 2) ==
        Approx(std::sqrt(2.3 + 0.05 / 3.98 + 0.01 * 0.5 / (0.25 + 0.3))).epsilon(1e-14));
}

TEST_CASE("Silicon in Herzberger's form and silver bromide in the Lorentz-Lorenz form", "[materials]") {
  // Coefficients by Edwards & Ochoa 1980; indices by another laboratory (Salzberg & Villa 1957).
  const std::vector<double> si{3.41983, 0.159906, -0.123109, 1.26878e-6, -1.95104e-9};
  CHECK(index(Dispersion::kHerzberger, si, 5) == Approx(3.4223).margin(5e-3).epsilon(0));
  CHECK(index(Dispersion::kHerzberger, si, 10) == Approx(3.4179).margin(5e-3).epsilon(0));
  // Coefficients after Schröter 1931; n_D of the handbooks is 2.253.
  CHECK(index(Dispersion::kRetro, {0.452505, 0.09939, 0.070537, -0.00015}, 0.5893) ==
        Approx(2.253).margin(5e-3).epsilon(0));
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
  CHECK(dispersion_named("exotic") == Dispersion::kExotic);
  CHECK(takes_coefficients(Dispersion::kHerzberger, 6));
  CHECK_FALSE(takes_coefficients(Dispersion::kHerzberger, 7));
  CHECK(takes_coefficients(Dispersion::kRetro, 4));
  CHECK_FALSE(takes_coefficients(Dispersion::kExotic, 5));
  CHECK(takes_coefficients(Dispersion::kRefractiveIndexInfo, 9));
}

TEST_CASE("The formulas run in lanes of float", "[materials]") {
  const std::vector<double> bk7{0.0, 1.03961212, 0.00600069867, 0.231792344, 0.0200179144, 1.01046945, 103.560653};
  const FloatLanes n = refractive_index<FloatLanes>(Dispersion::kSellmeier2, bk7, FloatLanes(0.5875618f));
  CHECK(n.get(0) == Approx(1.51680).margin(2e-6));
}
