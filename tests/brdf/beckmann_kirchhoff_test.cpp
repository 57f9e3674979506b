#include "brdf/beckmann_kirchhoff.h"

#include <random>

#include "brdf/brdf.h"
#include "brdf/lanes.h"
#include "catch.h"
#include "oracles/fifty_digits.h"

using namespace gonio;

namespace {

/// A geometry and a surface with a given g and v_xy·T.
struct Case {
  double theta_i, theta_o, phi, sigma_um, correlation_um;
};

Case make_case(double g, double v_t, double theta_i, double theta_o, double phi, double wavelength_um) {
  const Directions<double> w = directions_from_deg(theta_i, theta_o, phi);
  const double sum = w.cos_i + w.cos_o, wave = wavelength_um / (2 * kPi<double>);
  return {theta_i, theta_o, phi, std::sqrt(g) * wave / sum, v_t * wave / (std::sqrt(w.tan2_h) * sum)};
}

}  // namespace

TEST_CASE("The diffraction series agrees with a 50-digit sum, g 1e-4 to 1e4, v_xy T 0 to 100", "[brdf]") {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform(0, 1);
  double worst_double = 0, worst_float = 0;
  for (int i = 0; i < 300; ++i) {
    const double g = std::pow(10, -4 + 8 * uniform(random)),
                 v_t = i % 5 == 0 ? 0.0 : 100 * std::pow(uniform(random), 2);
    const float gf = float(g), bf = float(v_t * v_t / 4);
    const double exact = oracle::kirchhoff_sum(g, oracle::Real(v_t) * oracle::Real(v_t) / 4).convert_to<double>();
    const double value = poisson_lobe_sum(g, v_t * v_t / 4);
    INFO("g " << g << ", vT " << v_t << ": " << value << " " << exact);
    REQUIRE(value >= 0);
    if (exact > 1e-290) worst_double = std::max(worst_double, std::abs(value - exact) / exact);
    const double peak = poisson_lobe_sum(double(gf), 0.0), exact_f = poisson_lobe_sum(double(gf), double(bf));
    const float fast = poisson_lobe_sum(FloatLanes(gf), FloatLanes(bf)).get(0);
    REQUIRE(fast >= 0);
    if (exact_f > 1e-6 * peak) worst_float = std::max(worst_float, std::abs(fast - exact_f) / exact_f);
  }
  INFO("double " << worst_double << ", float " << worst_float);
  CHECK(worst_double < 1e-12);
  CHECK(worst_float < 1e-5);
}

TEST_CASE("Beckmann-Kirchhoff from angles agrees with (18a) in 50 digits", "[brdf]") {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  double worst_double = 0, worst_float = 0;
  const double wavelength_um = 0.55;
  for (int i = 0; i < 200; ++i) {
    const double theta_i = i % 7 == 0 ? 89.99 : 89 * uniform(random), theta_o = 89.9 * uniform(random),
                 phi = 720 * (uniform(random) - 0.5);
    const Case c = make_case(std::pow(10, -4 + 8 * uniform(random)), 100 * std::pow(uniform(random), 2), theta_i,
                             theta_o, phi, wavelength_um);
    const double exact =
        oracle::kirchhoff(theta_i, theta_o, phi, c.sigma_um, c.correlation_um, wavelength_um).convert_to<double>();
    const Directions<double> w = directions_from_deg(theta_i, theta_o, phi);
    const BeckmannKirchhoff<double> model{c.sigma_um, c.correlation_um};
    const double value = model.shape(w, wavelength_um);
    INFO("theta_i " << theta_i << " theta_o " << theta_o << " phi " << phi << " sigma " << c.sigma_um << " T "
                    << c.correlation_um);
    REQUIRE(std::isfinite(value));
    if (exact > 1e-290) worst_double = std::max(worst_double, std::abs(value - exact) / exact);
    const BeckmannKirchhoff<FloatLanes> fast{FloatLanes(float(c.sigma_um)), FloatLanes(float(c.correlation_um))};
    const float f = fast.shape(spread<FloatLanes>(w), FloatLanes(float(wavelength_um))).get(0);
    REQUIRE(std::isfinite(f));
    REQUIRE(f >= 0);
    const Directions<double> mirror = directions_from_deg(theta_i, theta_i, 180.0);
    if (exact > 1e-6 * model.shape(mirror, wavelength_um))
      worst_float = std::max(worst_float, std::abs(f - exact) / exact);
  }
  INFO("double " << worst_double << ", float " << worst_float);
  CHECK(worst_double < 1e-10);
  CHECK(worst_float < 2e-5);
}

TEST_CASE("Nodes further apart than the constants allow lose what they say", "[brdf]") {
  // Poisson's formula: with steps of h standard deviations the trapezoidal rule loses about 2 exp(-2π²/h²).
  const double g = 400;
  const auto coarse = [&](double step) {
    double sum = 0;
    for (double x = g; x < g + 12 * std::sqrt(g); x += step * std::sqrt(g)) sum += poisson_lobe_term(x, x - g, g, 0.0);
    for (double x = g - step * std::sqrt(g); x > 1; x -= step * std::sqrt(g))
      sum += poisson_lobe_term(x, x - g, g, 0.0);
    return sum * 0x1p-60 * step * std::sqrt(g);  // a term is 2⁶⁰ times as large
  };
  const double exact = oracle::kirchhoff_sum(g, 0).convert_to<double>();
  CHECK(std::abs(coarse(SeriesPrecision<double>::step) / exact - 1) < 1e-13);
  CHECK(std::abs(coarse(1.0) / exact - 1) > 1e-10);
  CHECK(std::abs(coarse(SeriesPrecision<float>::step) / exact - 1) < 1e-7);
  CHECK(std::abs(coarse(1.6) / exact - 1) > 1e-5);
}

TEST_CASE("Very rough surfaces, g to 1e10: the limit with its first correction, in double and float", "[brdf]") {
  // Σ → exp(-t)/g·(1 + (2 - 4t + t²)/(2g)), t = b/g (PHYSICS, Reflection models 4); what it leaves is O(t⁴/g²).
  for (const double g : {1e7, 1e8, 1e10})
    for (const double t : {0.0, 0.5, 3.0, 10.0}) {
      const double expected = std::exp(-t) / g * (1 + (2 - 4 * t + t * t) / (2 * g));
      INFO("g " << g << " t " << t);
      CHECK(poisson_lobe_sum(g, t * g) == Approx(expected).epsilon(2e-10));
      CHECK(poisson_lobe_sum(FloatLanes(float(g)), FloatLanes(float(t * g))).get(0) == Approx(expected).epsilon(2e-5));
    }
}

TEST_CASE("Stirling's error against ln Gamma", "[brdf]") {
  for (const double x : {1.0, 1.5, 2.0, 3.7, 7.999, 8.0, 15.0, 100.0, 1e6}) {
    const oracle::Real y(x);
    const oracle::Real exact =
        lgamma(oracle::Real(y + 1)) - (y + oracle::Real(0.5)) * log(y) + y - log(2 * oracle::pi()) / 2;
    CHECK(std::abs(stirling_error(x) - exact.convert_to<double>()) < 1e-14);
  }
}

TEST_CASE("Rough limit: relative difference (2 - 4t + t²)/(2g)", "[brdf]") {
  // PHYSICS, Reflection models 4: t = tan²β/α², once g ≫ t².
  const double wavelength_um = 0.5;
  for (const double t : {0.0, 0.5, 2.0, 5.0}) {
    const double sigma = 20, correlation = 200, alpha = 2 * sigma / correlation;
    const double theta_o = 20.0, beta = std::atan(alpha * std::sqrt(t));
    const double theta_i = theta_o + 2 * beta * 180 / kPi<double>;
    const Directions<double> w = directions_from_deg(theta_i, theta_o, 180.0);
    const BeckmannKirchhoff<double> series{sigma, correlation}, limit{sigma, correlation, KirchhoffForm::rough_limit};
    const double g = series.phase_variance(w, wavelength_um);
    const double difference = series.shape(w, wavelength_um) / limit.shape(w, wavelength_um) - 1;
    CHECK(difference * 2 * g == Approx(2 - 4 * t + t * t).margin(0.01));
  }
}

TEST_CASE("Smooth limit: the incoherent energy is 1 - exp(-g) at the normal, T ≫ λ; the coherent part keeps the rest",
          "[brdf]") {
  const double wavelength_um = 0.5, sigma = 0.002, correlation = 20;
  const BeckmannKirchhoff<double> series{sigma, correlation}, first{sigma, correlation, KirchhoffForm::smooth_limit};
  const double g = std::pow(4 * kPi<double> * sigma / wavelength_um, 2);
  double energy = 0;  // ∫ f cos dω in direction cosines around the mirror direction
  const int steps = 4000;
  for (int i = 0; i < steps; ++i) {
    const double rho = (i + 0.5) / steps * 0.1, theta = std::asin(rho) * 180 / kPi<double>;
    energy += series.shape(directions_from_deg(0.0, theta, 0.0), wavelength_um) * 2 * kPi<double> * rho * 0.1 / steps;
  }
  CHECK(energy == Approx(1 - std::exp(-g)).epsilon(1e-4));
  CHECK(series.coherent_share(1.0, wavelength_um) == Approx(std::exp(-g)).epsilon(1e-14));
  const Directions<double> w = directions_from_deg(10.0, 10.1, 180.0);  // near the mirror, where the first term leads
  CHECK(series.shape(w, wavelength_um) == Approx(first.shape(w, wavelength_um)).epsilon(g));
}

TEST_CASE("The coherent patch carries R exp(-g) in all", "[brdf]") {
  const BeckmannKirchhoff<double> model{0.02, 5};
  const double wavelength_um = 0.5, x = 30, y = 20, wave = 2 * kPi<double> / wavelength_um;
  const double extent_x = 300 * kPi<double> / (wave * x),
               extent_y = 300 * kPi<double> / (wave * y);  // 300 fringes each side
  double energy = 0;
  const int n = 3000;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double hx = ((i + 0.5) / n * 2 - 1) * extent_x, hy = ((j + 0.5) / n * 2 - 1) * extent_y,
                   s2 = hx * hx + hy * hy;
      if (s2 >= 1) continue;
      const double co = std::sqrt(1 - s2), sum = 1 + co;
      const Directions<double> w{1, co, 0.5 * std::sqrt(s2 + sum * sum), s2 / (sum * sum), 0, s2 / (co * co)};
      energy += model.coherent_patch(w, hx, hy, x, y, wavelength_um) * 4 * extent_x * extent_y / (double(n) * n);
    }
  CHECK(energy == Approx(model.coherent_share(1.0, wavelength_um)).epsilon(0.02));  // the fringes' tails are cut
}
