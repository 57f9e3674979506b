// The thesis's classical models against closed forms, and the limits that join them.
#include <boost/math/quadrature/gauss_kronrod.hpp>

#include "brdf/brdf.h"
#include "catch.h"

using namespace gonio;

namespace {

/// ∫ D(tan²ζ)·cos ζ dω over the hemisphere.
template <class D>
double projected(D density) {
  const auto ring = [&](double theta) {
    const double t = std::tan(theta);
    return density(t * t) * std::cos(theta) * std::sin(theta) * 2 * kPi<double>;
  };
  return boost::math::quadrature::gauss_kronrod<double, 61>::integrate(ring, 0.0, kPi<double> / 2, 15, 1e-13);
}

double value(const char* name, std::vector<double> values, const Directions<double>& w, const char* variant = nullptr,
             const char* shadowing = nullptr) {
  ModelSpec spec;
  spec.id = model(name).id;
  if (variant) set_variant(spec, variant);
  if (shadowing) set_shadowing(spec, shadowing);
  return evaluate(make_brdf<double>(spec, values), w, perfect_interface<double>(), 0.55);
}

}  // namespace

TEST_CASE("Blinn's laws: (n+2)/(2 pi) and 1/(pi e^2) make them densities", "[classical]") {
  for (const double n : {1.0, 20.0, 3000.0})
    CHECK(projected([&](double t) { return blinn_density(BlinnDensity::cosine_power, t, n); }) ==
          Approx(2 * kPi<double> / (n + 2)).epsilon(1e-10));
  for (const double e : {0.05, 0.4, 1.0})
    CHECK(projected([&](double t) { return blinn_density(BlinnDensity::spheroid, t, e); }) ==
          Approx(kPi<double> * e * e).epsilon(1e-10));
}

TEST_CASE("Thesis Trowbridge-Reitz is e^2 GGX; normalised Blinn spheroid is GGX with V-cavities", "[classical]") {
  for (const double e : {0.01, 0.3, 1.0})
    for (const double to : {0.0, 41.0, 85.0}) {
      const auto w = directions_from_deg(40.0, to, 170.0);
      CHECK(value("trowbridge-reitz", {e, 0, 1}, w) ==
            Approx(e * e * value("ggx", {e, e, 0, 1}, w, nullptr, "none")).epsilon(1e-13));
      CHECK(value("blinn-1977-spheroid", {e, 0, 1}, w, "normalised") ==
            Approx(value("ggx", {e, e, 0, 1}, w, nullptr, "v-cavity")).epsilon(1e-12));
      // By hand: D as the thesis prints it, with the cosine.
      const double c2 = 1 / (1 + w.tan2_h), d = std::pow(e * e / (1 + (e * e - 1) * c2), 2);
      CHECK(value("blinn-1977-spheroid", {e, 0, 1}, w) ==
            Approx(d * v_cavity(w.cos_i, w.cos_o, w.cos2_d()).value() / (w.cos_i * w.cos_o)).epsilon(1e-9));
    }
}

TEST_CASE("Blinn's cosine power tends to Beckmann, n = 2/alpha^2 - 2, difference as alpha^2", "[classical]") {
  double before = 1;
  for (const double alpha : {0.1, 0.05, 0.025}) {
    double worst = 0;
    for (const double s : {0.3, 1.0, 1.5}) {  // tan ζ in units of alpha
      const double t = square(s * alpha), n = 2 / (alpha * alpha) - 2;
      worst = std::max(worst, std::abs(blinn_density(BlinnDensity::cosine_power, t, n) * (n + 2) / (2 * kPi<double>) /
                                           beckmann_d(t, alpha) -
                                       1));
    }
    CHECK(worst < 0.3 * before);
    CHECK(worst < 4 * alpha * alpha);
    before = worst;
  }
}

TEST_CASE("Cook-Torrance as published is four times the normalised Torrance-Sparrow", "[classical]") {
  for (const double alpha : {0.02, 0.3, 0.9})
    for (const double to : {5.0, 50.0, 88.0}) {
      const auto w = directions_from_deg(40.0, to, 175.0);
      CHECK(
          value("cook-torrance-1981", {alpha, 0, 1}, w) ==
          Approx(4 * value("torrance-sparrow", {alpha / std::sqrt(2.0), 0, 1}, w, nullptr, "v-cavity")).epsilon(1e-12));
    }
  // D1 = exp(-(ζ/m)²), ζ = 10° half-way between 30° and 50° on the mirror side: by hand.
  const auto w = directions_from_deg(30.0, 50.0, 180.0);
  const double zeta = 10 * kPi<double> / 180, d = std::exp(-square(zeta / 0.3));
  const double g = std::min(1.0, 2 * std::cos(zeta) * w.cos_o / std::cos(40 * kPi<double> / 180));
  CHECK(value("cook-torrance-1981", {0.3, 0, 1}, w, "gaussian-angle") ==
        Approx(d * g / (kPi<double> * w.cos_i * w.cos_o)).epsilon(1e-13));
  CHECK(value("blinn-1977-gaussian", {1 / 0.3, 0, 1}, w) == Approx(d * g / (w.cos_i * w.cos_o)).epsilon(1e-13));
  CHECK(value("torrance-sparrow-1967", {1 / 0.3, 0, 1}, w) == Approx(d * g / (4 * w.cos_i * w.cos_o)).epsilon(1e-13));
}

TEST_CASE("Phong and Whitted: intensities over cos_i", "[classical]") {
  const auto w = directions_from_deg(30.0, 50.0, 180.0);  // 20° from the mirror direction, 10° of the half vector
  CHECK(value("phong-1975", {50, 0, 1}, w) ==
        Approx(std::pow(std::cos(20 * kPi<double> / 180), 50) / w.cos_i).epsilon(1e-13));
  CHECK(value("whitted-1980", {50, 0, 1}, w) ==
        Approx(std::pow(std::cos(10 * kPi<double> / 180), 50) / w.cos_i).epsilon(1e-13));
  CHECK(value("phong-1975", {50, 0, 1}, directions_from_deg(60.0, 40.0, 0.0)) == 0);                 // 100° from it
  CHECK(value("phong-1975", {50, 0, 1}, w) != Approx(value("phong-1975", {50, 0, 1}, swapped(w))));  // not reciprocal
}

TEST_CASE("A mirror reflects R as a delta and nothing beside it", "[classical]") {
  const Interface<double> gold{0.18, 3.4};
  const Brdf<double> mirror{Mirror{}, 0.0, 0.7, false};
  CHECK(evaluate(mirror, directions_from_deg(30.0, 30.0, 180.0), gold, 0.55) == 0);
  CHECK(coherent_energy(mirror, 0.5, gold, 0.55) == Approx(0.7 * gold.reflectance(0.5)).epsilon(1e-15));
}

TEST_CASE("Rational functions: Schlick's F, D, G and Walter's G stay within what is measured", "[classical]") {
  double d_mean = 0, d_max = 0, walter = 0, schlick = 0;
  int count = 0;
  for (double alpha = 0.05; alpha <= 0.7; alpha += 0.05)
    for (double theta = 0.25; theta < 90; theta += 0.5) {
      const double t = square(std::tan(theta * kPi<double> / 180)), c = std::cos(theta * kPi<double> / 180);
      const double error = std::abs(schlick_d(t, alpha) - beckmann_d(t, alpha)) * kPi<double> * alpha * alpha;
      d_mean += error, d_max = std::max(d_max, error), ++count;
      walter = std::max(walter, std::abs(walter_g1(t, alpha) * (1 + smith_lambda(t, alpha)) - 1));
      schlick = std::max(schlick, std::abs(schlick_g1(c, alpha) - smith_1967(t, alpha)));
    }
  d_mean /= count;
  INFO("D mean " << d_mean << " max " << d_max << ", Walter G relative " << walter << ", Schlick G absolute "
                 << schlick);
  CHECK(schlick_d(0.0, 0.3) == Approx(beckmann_d(0.0, 0.3)).epsilon(1e-15));  // the peak is kept
  CHECK(d_mean < 0.02);
  CHECK(d_max < 0.25);
  CHECK(walter < 4e-3);   // 0.35 % is what the paper states
  CHECK(schlick < 0.26);  // largest near 87° on smooth surfaces: far beyond the mean that the paper quotes
  // As Schlick wrote it, with the cosine.
  const double t = 0.9, a = 0.4;
  CHECK(schlick_d(1 / (t * t) - 1, a) ==
        Approx(std::pow(t - 1 + 2 * a * a, 3) / (8 * kPi<double> * t * std::pow(a, 8))).epsilon(1e-12));
  ModelSpec spec{ModelId::torrance_sparrow};
  set_variant(spec, "schlick-d");
  const std::vector<double> wide{0.6, 0, 1}, narrow{0.5, 0, 1};
  CHECK_THROWS(check_values(spec, wide));
  CHECK_NOTHROW(check_values(spec, narrow));
}
