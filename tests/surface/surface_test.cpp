#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/special_functions/erf.hpp>

#include "base/error.h"
#include "brdf/directions.h"
#include "catch.h"
#include "oracles/fifty_digits.h"
#include "surface/normals.h"
#include "surface/shadowing.h"
#include "surface/smith_table.h"

using namespace gonio;
using Rule = boost::math::quadrature::gauss_kronrod<double, 61>;

TEST_CASE("Beckmann's density of normals projects to 1", "[surface]") {
  for (const double alpha : {1e-4, 0.01, 0.3, 1.0, 3.0}) {
    const auto integrand = [&](double r) {  // tan θ = α·r; dω·cos = 2π·t·cos⁴ dt
      const double t = alpha * r, cos2 = 1 / (1 + t * t);
      return beckmann_d(t * t, alpha) * 2 * kPi<double> * t * cos2 * cos2 * alpha;
    };
    CHECK(Rule::integrate(integrand, 0.0, 9.0, 10, 1e-13) == Approx(1).epsilon(1e-12));
  }
}

TEST_CASE("The thesis's slope law is a density over the angle in a plane", "[surface]") {
  for (const double m : {0.02, 0.3, 1.0}) {
    const auto integrand = [&](double x) {  // tan ζ = m·x; dζ = m dx cos²
      const double t = m * x;
      return thesis_slope_density(t * t, m) * m / (1 + t * t);
    };
    CHECK(Rule::integrate(integrand, -9.0, 9.0, 10, 1e-13) == Approx(1).epsilon(1e-12));
  }
}

TEST_CASE("Smith's Lambda agrees with 50 digits", "[surface]") {
  for (const double alpha : {1e-4, 0.05, 0.5, 1.4, 10.0})
    for (const double theta : {0.0, 1.0, 30.0, 60.0, 85.0, 89.0, 89.9999}) {
      const double tangent = sin_deg(theta) / cos_deg(theta);
      oracle::Real exact = 0;
      if (theta > 0) {
        const oracle::Real a = 1 / (oracle::Real(alpha) * oracle::Real(tangent));
        exact = (exp(-a * a) / (a * sqrt(oracle::pi())) - boost::math::erfc(a)) / 2;
      }
      const double value = smith_lambda(tangent * tangent, alpha), truth = exact.convert_to<double>();
      INFO("alpha " << alpha << ", theta " << theta << ": " << value << " " << truth);
      CHECK(std::abs(value - truth) <= 2e-15 * (1 + truth));  // what counts is its error beside 1
    }
}

TEST_CASE("Two functions of Smith, two names: 85 degrees, slope rms 0.35", "[surface]") {
  // STYLE: 0.279 with the factor 1 - erfc/2, 0.466 without.
  const double tan2 = std::pow(std::tan(85 * kPi<double> / 180), 2), alpha = std::sqrt(2.0) * 0.35;
  CHECK(smith_1967(tan2, alpha) == Approx(0.279).margin(5e-4));
  CHECK(1 / (1 + smith_lambda(tan2, alpha)) == Approx(0.466).margin(5e-4));
}

TEST_CASE("V-cavity: 1 at the normal, the published minimum elsewhere, 0 at grazing", "[surface]") {
  CHECK(v_cavity(1.0, 1.0, 1.0).value() == 1);
  const double cos_h = 0.5, cos_d = 0.5, cos_i = 0.3, cos_o = 2 * cos_h * cos_d - cos_i;  // of one geometry
  CHECK(v_cavity(cos_i, cos_o, cos_d * cos_d).value() == Approx(2 * cos_h * cos_o / cos_d));
  CHECK(v_cavity(1e-9, 0.5, 0.49).value() < 3e-9);
}

TEST_CASE("Correlated shadowing lies between the separable one and the lesser of the two", "[surface]") {
  for (const double ti : {10.0, 50.0, 80.0, 89.0})
    for (const double to : {5.0, 60.0, 88.0}) {
      const Directions<double> w = directions_from_deg(ti, to, 120.0);
      const double one = 1 / (1 + smith_lambda(w.tan2_i, 0.5)), other = 1 / (1 + smith_lambda(w.tan2_o, 0.5));
      const double correlated = shadowing_masking(Shadowing::smith_correlated, w, 0.5).value();
      CHECK(correlated >= shadowing_masking(Shadowing::smith_separable, w, 0.5).value());
      CHECK(correlated <= std::min(one, other));
    }
}

TEST_CASE("Shadowings have names; an unknown one is refused", "[surface]") {
  for (const auto* name : {"none", "v-cavity", "smith-separable", "smith-correlated", "smith-1967"})
    CHECK(name_of(shadowing_from(name)) == name);
  CHECK_THROWS_AS(shadowing_from("smith"), InputError);
}

TEST_CASE("Smith's G1 from a table loses what it says, grazing and the normal included", "[surface]") {
  double worst = 0;
  for (double s = 1e-4; s < 1e8; s *= 1.013) {
    const double truth = 1 / (1 + smith_lambda_core(s)), table = smith_g1_tabulated(s * s, 1.0);
    worst = std::max(worst, std::abs(table / truth - 1));
    CHECK(std::abs(smith_g1_tabulated(DoubleLanes(s * s), DoubleLanes(1.0)).get(0) / truth - 1) < 5e-8);
  }
  INFO("largest relative error " << worst);
  CHECK(worst < 4e-8);
  CHECK(worst > 1e-9);  // it is a table
  CHECK(smith_g1_tabulated(0.0, 0.5) == Approx(1).epsilon(1e-14));
}
