// He et al. 1991 against a second computation, written as the paper writes it: vectors and cross products, Newton's method for
// the effective roughness, the series summed term by term.
#include <Eigen/Geometry>

#include "brdf/brdf.h"
#include "catch.h"

using namespace gonio;

namespace {

using V = Eigen::Vector3d;

V direction(double theta_deg, double phi_deg) {
  const double t = theta_deg * kPi<double> / 180, p = phi_deg * kPi<double> / 180;
  return {std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t)};
}

double hidden(double theta_deg, double sigma0, double correlation) {
  const double t = std::tan(theta_deg * kPi<double> / 180);
  return t * std::erfc(correlation / (2 * sigma0 * t));
}

double newton_sigma(double sigma0, double correlation, double ti, double to) {
  const double b = (hidden(ti, sigma0, correlation) + hidden(to, sigma0, correlation)) * sigma0 / 4;
  double z = 0;
  for (int step = 0; step < 200; ++step) {
    const double e = std::exp(-z * z / (2 * sigma0 * sigma0)), f = std::sqrt(kPi<double> / 2) * z - b * e;
    z -= f / (std::sqrt(kPi<double> / 2) + b * e * z / (sigma0 * sigma0));
  }
  return sigma0 / std::sqrt(1 + z * z / (sigma0 * sigma0));
}

double seen(double theta_deg, double sigma0, double correlation) {
  const double cot = 1 / std::tan(theta_deg * kPi<double> / 180), a = correlation * cot / (2 * sigma0);
  const double lambda = 0.5 * (2 / std::sqrt(kPi<double>) * sigma0 / (correlation * cot) * std::exp(-a * a) - std::erfc(a));
  return (1 - 0.5 * std::erfc(a)) / (1 + lambda);
}

/// The paper's G with s and p of both directions; k_i points down.
double geometry(const V& k_i, const V& k_r, const V& v) {
  const V s_i = k_i.cross(V::UnitZ()).normalized(), s_r = k_r.cross(V::UnitZ()).normalized();
  const V p_i = s_i.cross(k_i), p_r = s_r.cross(k_r);
  const double a = square(s_r.dot(k_i)) + square(p_r.dot(k_i)), b = square(s_i.dot(k_r)) + square(p_i.dot(k_r));
  return square(v.dot(v) / v.z()) * a * b / std::pow(k_r.cross(k_i).norm(), 4);
}

double paper(double sigma0, double correlation, double um, double ti, double to, double phi) {
  const V i = direction(ti, 0), o = direction(to, phi), h = i + o;
  const double sigma = newton_sigma(sigma0, correlation, ti, to), wave = 2 * kPi<double> / um;
  const double g = square(sigma * wave * h.z()), b = square(wave * correlation) * (h.x() * h.x() + h.y() * h.y()) / 4;
  double sum = 0;
  for (int m = 1; m < 4000; ++m) sum += std::exp(m * std::log(g) - g - std::lgamma(m + 1.0) - b / m) / m;
  const double d = kPi<double> * square(correlation / um) / 4 * sum;
  return geometry(-i, o, h) * seen(ti, sigma0, correlation) * seen(to, sigma0, correlation) * d / (i.z() * o.z());
}

double ours(HeReading reading, double sigma0, double correlation, double um, const Directions<double>& w) {
  return HeTorrance<double>{sigma0, correlation, reading}.shape(w, um);
}

}  // namespace

TEST_CASE("He 1991: closed forms equal the paper's vectors, Newton and series", "[he]") {
  for (const double sigma0 : {0.05, 0.28, 1.0})
    for (const double correlation : {1.5, 5.0})
      for (const double ti : {10.0, 45.0, 80.0})
        for (const double to : {12.0, 60.0, 86.0})
          for (const double phi : {20.0, 110.0, 179.0}) {
            INFO(sigma0 << " " << correlation << " " << ti << " " << to << " " << phi);
            const double truth = paper(sigma0, correlation, 0.5, ti, to, phi);
            CHECK(ours(HeReading::corrected, sigma0, correlation, 0.5, directions_from_deg(ti, to, phi)) ==
                  Approx(truth).epsilon(1e-9).margin(1e-250));
          }
}

TEST_CASE("He 1991: the normal, retro-reflection and grazing are numbers; rival readings apart", "[he]") {
  for (const auto& [ti, to, phi] : {std::array{0.0, 0.0, 0.0}, std::array{0.0, 30.0, 90.0}, std::array{50.0, 50.0, 0.0},
                                    std::array{89.9999, 89.9999, 180.0}, std::array{89.9999, 89.9999, 0.0}}) {
    const double f = ours(HeReading::corrected, 0.28, 1.5, 0.5, directions_from_deg(ti, to, phi));
    INFO(ti << " " << to << " " << phi << ": " << f);
    CHECK(std::isfinite(f));
    CHECK(f >= 0);
  }
  const auto w = directions_from_deg(60.0, 70.0, 180.0);
  const double f = ours(HeReading::corrected, 0.28, 1.5, 0.5, w);
  const double printed = ours(HeReading::lambda_without_exponential, 0.28, 1.5, 0.5, w);
  const double raw = ours(HeReading::sigma0_in_phase, 0.28, 1.5, 0.5, w);
  INFO("printed Lambda " << printed / f << ", raw sigma0 " << raw / f);
  CHECK(printed < 0.95 * f);  // a larger Λ shades more
  CHECK(std::abs(raw / f - 1) > 1e-3);
}

TEST_CASE("He 1991: smooth surfaces keep R in the mirror direction; near the normal it is Beckmann-Kirchhoff", "[he]") {
  const HeTorrance<double> smooth{1e-4, 10};
  CHECK(smooth.coherent_share(0.5, 0.5) == Approx(1).epsilon(1e-5));
  const HeTorrance<double> gentle{0.1, 10};
  const auto w = directions_from_deg(5.0, 8.0, 175.0);
  CHECK(gentle.shape(w, 0.5) == Approx((BeckmannKirchhoff<double>{0.1, 10}.shape(w, 0.5))).epsilon(1e-12));
  CHECK(gentle.coherent_share(0.9, 0.5) == Approx((BeckmannKirchhoff<double>{0.1, 10}.coherent_share(0.9, 0.5))).epsilon(1e-12));
}
