#include "fit/scan_quality.h"

#include <cmath>
#include <random>

#include "catch.h"
#include "fit/scan.h"

using namespace gonio;

namespace {

/// f = 0.2 + cos_i·cos_o/4, reciprocal; rows of random directions, each followed by what `pair` makes of it.
template <class Pair>
Measurement pairs_of(int count, double noise, std::uint64_t seed, Pair pair) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> theta(1, 80), phi(0, 360);
  Measurement scan;
  scan.wavelength_nm = 550;
  const auto add = [&](ScanPoint p) {
    p.wavelength_nm = 550;
    const double c = std::cos(p.theta_i_deg * std::acos(-1) / 180) * std::cos(p.theta_o_deg * std::acos(-1) / 180);
    p.f_per_sr = (0.2 + c / 4) * (1 + noise * normal(random));
    scan.points.push_back(p);
  };
  for (int k = 0; k < count; ++k) {
    ScanPoint p;
    p.theta_i_deg = theta(random), p.theta_o_deg = theta(random), p.phi_o_deg = phi(random);
    add(p), add(pair(p));
  }
  return scan;
}
ScanPoint same(ScanPoint p) { return p; }
ScanPoint exchanged(ScanPoint p) {
  std::swap(p.theta_i_deg, p.theta_o_deg);
  p.phi_o_deg = 360 - p.phi_o_deg;  // the mirror image: the relative azimuth has no sign
  return p;
}

/// The rows of a grid of theta_o and phi.
template <class F>
Measurement grid(double theta_i_deg, double step_theta, double step_phi, double phi_end, F f) {
  Measurement scan;
  for (double theta = 0; theta < 89; theta += step_theta)
    for (double phi = 0; phi <= phi_end; phi += step_phi) {
      ScanPoint p;
      p.theta_i_deg = theta_i_deg, p.theta_o_deg = theta, p.phi_o_deg = phi;
      p.f_per_sr = f(theta, phi);
      scan.points.push_back(p);
    }
  return scan;
}

}  // namespace

TEST_CASE("The noise estimate is the injected one within its error, from repeats and from reciprocal pairs",
          "[fit][quality]") {
  constexpr int kPairs = 400;
  for (const double noise : {0.005, 0.03, 0.1}) {
    const double margin = 4 * 1.17 / std::sqrt(static_cast<double>(kPairs)) * noise;  // false alarm rate 6e-5 each
    const auto repeated = noise_estimate(pairs_of(kPairs, noise, 11, same));
    REQUIRE(repeated);
    CHECK(repeated->from == "repeats");
    CHECK(repeated->pairs == kPairs);
    CHECK(repeated->relative_sd == Approx(noise).margin(margin));
    const auto reciprocal = noise_estimate(pairs_of(kPairs, noise, 12, exchanged));
    REQUIRE(reciprocal);
    CHECK(reciprocal->from == "reciprocity");
    CHECK(reciprocal->relative_sd == Approx(noise).margin(margin));
  }
}

TEST_CASE("Outliers do not move the noise estimate; too few pairs or copies give none", "[fit][quality]") {
  Measurement scan = pairs_of(400, 0.02, 13, same);
  for (std::size_t k = 0; k < 40; ++k) scan.points[20 * k].f_per_sr *= 30;
  CHECK(noise_estimate(scan)->relative_sd == Approx(0.02).epsilon(0.5));
  CHECK(repeats_of(scan).rms_log10 > 0.1);
  CHECK_FALSE(noise_estimate(pairs_of(7, 0.02, 14, same)));
  CHECK(noise_estimate(pairs_of(8, 0.02, 14, same)));
  CHECK_FALSE(noise_estimate(pairs_of(100, 0, 15, same)));
}

TEST_CASE("Pairs are found whatever the azimuths' turn and rounding, and rows are not paired with themselves",
          "[fit][quality]") {
  const auto turned = [](ScanPoint p) {
    p.phi_o_deg += 720 - 1e-4, p.theta_i_deg += 1e-4;
    return p;
  };
  CHECK(repeats_of(pairs_of(300, 0.01, 16, turned)).pairs >= 290);
  CHECK(reciprocal_pairs_of(pairs_of(300, 0.01, 16, turned)).pairs == 0);
  const Measurement all = grid(30, 30, 30, 330, [](double, double) { return 1.0; });
  CHECK(repeats_of(all).pairs == 11);  // at the normal every azimuth is the same direction
  CHECK(reciprocal_pairs_of(all).pairs == 0);
}

TEST_CASE("Values that are not reciprocal are named, noisy ones are not", "[fit][quality]") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    CHECK(scan_quality(pairs_of(200, 0.1, seed, exchanged)).warnings.empty());
  Measurement tilted = pairs_of(200, 0.02, 17, exchanged);
  for (ScanPoint& p : tilted.points) p.f_per_sr *= std::sqrt(std::cos(p.theta_o_deg * std::acos(-1) / 180));
  const ScanQuality quality = scan_quality(tilted);
  REQUIRE(quality.warnings.size() == 1);
  CHECK(quality.warnings.front().find("not reciprocal") != std::string::npos);
  CHECK(quality.reciprocal.median_log10 < 0);  // lit from close to the normal, seen at grazing: the darker one
}

TEST_CASE("A scan of the hemisphere says what it reflects, a cut does not", "[fit][quality]") {
  const double pi = std::acos(-1);
  for (const double phi_end : {180.0, 350.0}) {
    const auto flat = scan_energies(grid(10, 10, 10, phi_end, [&](double, double) { return 0.7 / pi; }));
    REQUIRE(flat.size() == 1);
    CHECK(flat.front().reflectance == Approx(0.7).epsilon(1e-9));
  }
  const auto cosine = [&](double theta, double) { return std::cos(theta * pi / 180); };  // ∫ cos² dω = 2π/3
  CHECK(scan_energies(grid(10, 5, 5, 355, cosine)).front().reflectance == Approx(2 * pi / 3).epsilon(0.02));
  CHECK(scan_energies(grid(10, 1, 180, 180, cosine)).empty());
  Measurement relative = grid(10, 10, 10, 350, cosine);
  relative.quantity = "relative";
  CHECK(scan_energies(relative).empty());
  const ScanQuality bright = scan_quality(grid(10, 5, 5, 355, cosine));
  REQUIRE(bright.warnings.size() == 1);
  CHECK(bright.warnings.front().find("at most 1") != std::string::npos);
}
