#include "optics/fresnel.h"

#include <random>

#include "brdf/directions.h"
#include "catch.h"
#include "optics/interface.h"
#include "oracles/fifty_digits.h"

using namespace gonio;

namespace {

struct Index {
  double n, k;
};

/// The bar: 1e-13 relative; 1e-15 absolute where R < 0.01; next to the critical angle 8 roundings times R's condition there.
double allowed(double exact, double exact_beside, double theta_deg, double step_deg) {
  const double condition = exact > 0 ? std::abs(exact_beside - exact) / step_deg * theta_deg / exact : 0;
  const double relative = std::max(1e-13, 8 * std::numeric_limits<double>::epsilon() * condition);
  return exact < 0.01 ? std::max(1e-15, relative * exact) : relative * exact;
}

}  // namespace

TEST_CASE("Fresnel agrees with 50 digits from 0 to 89.99 degrees", "[optics]") {
  const Index index = GENERATE(Index{1.5, 0}, Index{1.0001, 0}, Index{2.6, 0}, Index{1.33, 1e-9}, Index{0.97, 6.7}, Index{0.2, 3.3},
                               Index{0.66, 0}, Index{0.66, 1e-6}, Index{0.99, 0}, Index{4, 0.05}, Index{1, 0.1}, Index{0.05, 20},
                               Index{100, 100});
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < 1500; ++i) {
    double theta = i <= 200 ? 89.99 * i / 200.0 : 89.99 * uniform(random);
    if (i % 3 == 0 && index.n < 1 && i > 200) {  // crowd around the critical angle
      const double critical = std::asin(index.n) * 180 / kPi<double>;
      theta = std::clamp(critical * (1 + (uniform(random) - 0.5) * std::pow(10, -1 - 9 * uniform(random))), 0.0, 89.99);
    }
    const Polarised<double> r = fresnel(cos_deg(theta), index.n, index.k);
    const double step = std::max(theta, 1e-3) * 1e-12, beside = theta + step;
    const auto exact = oracle::fresnel(theta, index.n, index.k), near = oracle::fresnel(beside, index.n, index.k);
    const double s = exact.s.convert_to<double>(), p = exact.p.convert_to<double>();
    INFO("n = " << index.n << ", k = " << index.k << ", theta = " << theta << " deg: " << r.s << " " << s << ", " << r.p << " " << p);
    REQUIRE(std::abs(r.s - s) <= allowed(s, near.s.convert_to<double>(), theta, beside - theta));
    REQUIRE(std::abs(r.p - p) <= allowed(p, near.p.convert_to<double>(), theta, beside - theta));
  }
}

TEST_CASE("Fresnel's known points", "[optics]") {
  CHECK(fresnel(1.0, 1.5, 0.0).unpolarised() == Approx(0.04).epsilon(1e-15));
  CHECK(normal_reflectance(0.27, 3.41) == Approx((0.73 * 0.73 + 3.41 * 3.41) / (1.27 * 1.27 + 3.41 * 3.41)).epsilon(1e-15));
  const double brewster = std::atan(1.5) * 180 / kPi<double>;
  CHECK(fresnel(cos_deg(brewster), 1.5, 0.0).p < 1e-30);
  CHECK(fresnel(0.0, 1.5, 0.0).unpolarised() == Approx(1).epsilon(1e-15));
  CHECK(fresnel(0.0, 0.9, 6.7).unpolarised() == Approx(1).epsilon(1e-15));
  CHECK(fresnel(cos_deg(60.0), 1 / 1.5, 0.0).unpolarised() == Approx(1).epsilon(1e-15));  // total reflection
  CHECK(fresnel(0.5, 1.0, 0.0).unpolarised() == 0);                                      // no boundary
  CHECK(perfect_interface<double>().reflectance(0.1) == 1);
}

TEST_CASE("Fresnel in float lanes agrees with double", "[optics]") {
  double worst = 0;
  for (const Index index : {Index{1.5, 0}, Index{0.97, 6.7}, Index{0.2, 3.3}, Index{4, 0.05}})
    for (int i = 0; i <= 1000; ++i) {
      const float c = float(i) / 1000;
      const double exact = fresnel<double>(c, double(float(index.n)), double(float(index.k))).unpolarised();
      const float fast = fresnel(FloatLanes(c), FloatLanes(float(index.n)), FloatLanes(float(index.k))).unpolarised().get(0);
      worst = std::max(worst, std::abs(fast - exact) / exact);
    }
  INFO("largest relative error " << worst);
  CHECK(worst < 3e-6);
}
