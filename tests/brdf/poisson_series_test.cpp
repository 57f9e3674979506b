// The series' constants, from both sides, for the judge too; and where its terms leave the range of their number type.
#include "brdf/poisson_series.h"

#include "catch.h"
#include "oracles/fifty_digits.h"
#include "reference/digits50.h"

using namespace gonio;

namespace {

double relative(const Digits50& a, const oracle::Real& b) {
  return abs(Digits50((a - Digits50(b)) / a)).convert_to<double>();
}

}  // namespace

TEST_CASE("The judge's series: every term below its switch, steps above, both to 45 digits", "[brdf]") {
  for (const double g :
       {0.5, 40.0, 0.9 * SeriesPrecision<Digits50>::coarse_from, 1.1 * SeriesPrecision<Digits50>::coarse_from, 3000.0})
    for (const double b : {0.0, 700.0, 4e4}) {
      INFO(g << " " << b);
      CHECK(relative(poisson_lobe_sum(Digits50(g), Digits50(b)), oracle::kirchhoff_sum(g, b)) < 1e-45);
    }
}

TEST_CASE("The judge's ln Γ: Stirling's series from 30 on, MPFR's own below", "[brdf]") {
  for (const double x : {29.0, 29.999, 30.0, 31.5, 1e3, 1e9}) {
    const Digits50 y(x);
    const Digits50 direct = lgamma(Digits50(y + 1)) - (y + Digits50(0.5)) * log(y) + y - log(kSqrt2Pi<Digits50>);
    INFO(x);
    CHECK(abs(Digits50(stirling_error(y) - direct)).convert_to<double>() <
          1e-46 * x);  // what `direct` loses grows with x ln x
  }
  // With one coefficient fewer than needed the series would not reach it at 30: the last one counts below 1e-55.
  CHECK(abs(Digits50(stirling_coefficients().back() * pow(Digits50(30), -71))).convert_to<double>() < 1e-55);
}

TEST_CASE("A smooth surface far from the mirror direction: the sum is there where 2b/g² leaves every range", "[brdf]") {
  for (const double g : {1e-15, 1e-12, 1e-6, 1e-4})
    for (const double b : {10.0, 1e3, 3e3}) {
      const double exact = oracle::kirchhoff_sum(g, b).convert_to<double>();
      INFO(g << " " << b << ": " << exact);
      REQUIRE(exact > 0);
      if (exact > 1e-290) CHECK(poisson_lobe_sum(g, b) == Approx(exact).epsilon(1e-11));
    }
  // Scaled from inside: the sum alone is below float's range, what it is multiplied by brings it back.
  const float g = 2e-3f, b = 330;
  const double exact = 1e20 * oracle::kirchhoff_sum(double(g), oracle::Real(double(b))).convert_to<double>();
  INFO(exact);
  REQUIRE(exact < 1e-18);  // the sum below 1e-38
  CHECK(double(poisson_lobe_sum(FloatLanes(g), FloatLanes(b), FloatLanes(1e20f)).get(0)) ==
        Approx(exact).epsilon(5e-5));
  CHECK(1e20f * poisson_lobe_sum(FloatLanes(g), FloatLanes(b)).get(0) != Approx(exact).epsilon(5e-5));
}
