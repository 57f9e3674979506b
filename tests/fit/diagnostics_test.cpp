#include "fit/diagnostics.h"

#include <chrono>

#include "catch.h"
#include "fit/diagnostics_json.h"
#include "fit/made_fit.h"
#include "fit/plausibility.h"

using namespace gonio;
using namespace gonio::test;

namespace {

/// In the plane of incidence, 0° to 75° by 15°, both sides.
Measurement cuts(double step_deg, double nm = 550) {
  Measurement scan;
  scan.wavelength_nm = nm;
  for (double theta_i = 0; theta_i < 80; theta_i += 15)
    for (double angle = -80; angle <= 80; angle += step_deg) {
      ScanPoint p;
      p.theta_i_deg = theta_i, p.theta_o_deg = std::abs(angle), p.phi_o_deg = angle < 0 ? 0 : 180;
      p.wavelength_nm = nm, p.f_per_sr = 1;
      scan.points.push_back(p);
    }
  group_by_incidence(scan);
  return scan;
}

bool says(const std::vector<std::string>& sentences, std::string_view words) {
  for (const std::string& sentence : sentences)
    if (sentence.find(words) != sentence.npos) return true;
  return false;
}

}  // namespace

TEST_CASE("Planted outliers are found, all of them and nothing else; clean noise has none", "[fit][diagnostics]") {
  const Measurement scan = cuts(0.1);  // 9606 points: 0.0055 false alarms expected
  for (const double noise : {0.01, 0.2}) {
    FitResult result = made_fit(scan, lobe_sum("ggx"), {0.3, 0.3, 0.1, 0.5});
    add_noise(result, noise, 21);
    CHECK(find_outliers(result).count == 0);
    CHECK(find_outliers(result).spread_log10 * std::log(10.0) == Approx(noise).epsilon(0.05));
    for (std::size_t k = 0; k < 30; ++k)
      result.points[17 + 200 * k].measured_per_sr *= std::exp(noise * (k % 2 ? 12.0 : -12.0));
    const Outliers found = find_outliers(result);
    CHECK(found.count == 30);
    REQUIRE(found.largest.size() == Outliers::kListed);
    for (const Outlier& one : found.largest) CHECK(one.point % 200 == 17);
    CHECK(found.largest.front().deviations >= found.largest.back().deviations);
    const FitDiagnostics diagnostics = diagnose(scan, result);
    CHECK(says(diagnostics.warnings, "30 of 9606 points lie further than 5"));
    CHECK(diagnostics_json(diagnostics, result)["outliers"]["largest"].size() == Outliers::kListed);
  }
}

TEST_CASE("Exact data have no outliers, and points left out of a fit count for nothing", "[fit][diagnostics]") {
  FitResult result = made_fit(cuts(1), lobe_sum("ggx"), {0.3, 0.3, 0.1, 0.5});
  add_noise(result, 1e-9, 22);
  CHECK(find_outliers(result).count == 0);
  result.points[5].measured_per_sr *= 2, result.points[9].measured_per_sr = -1, result.points[5].used = false;
  const Outliers found = find_outliers(result);
  CHECK(found.count == 0);
  CHECK(found.points == static_cast<int>(result.points.size()) - 2);
}

TEST_CASE("The energy of a fit: parts add up, too much is said, a relative scan is not judged", "[fit][diagnostics]") {
  Measurement scan = cuts(5);
  const auto energy = fit_energy(scan, made_fit(scan, lobe_sum("ggx+phong-1975"), {0.05, 0.05, 30, 0.2, 0.4, 0}));
  REQUIRE(energy);
  CHECK(energy->largest == Approx(0.6).margin(2e-3));
  CHECK(energy->error <= 1e-4);
  const FitResult bright = made_fit(scan, lobe_sum("ggx"), {0.05, 0.05, 0.4, 0.8});
  CHECK(fit_energy(scan, bright)->largest == Approx(1.2).margin(4e-3));
  CHECK(says(diagnose(scan, bright).warnings, "reflects more than the light"));
  const FitResult coherent = made_fit(scan, lobe_sum("beckmann-kirchhoff"), {0.001, 3, 0, 0.9});
  CHECK(fit_energy(scan, coherent)->largest == Approx(0.9).margin(2e-3));
  scan.quantity = "relative";
  CHECK_FALSE(fit_energy(scan, made_fit(scan, lobe_sum("ggx"), {0.05, 0.05, 0.4, 0.8})));
}

TEST_CASE("Values that are not reciprocal are named beside a model that claims to be", "[fit][diagnostics]") {
  Measurement scan = cuts(5);
  FitResult result = made_fit(scan, lobe_sum("ggx"), {0.3, 0.3, 0.1, 0.5});
  for (std::size_t k = 0; k < scan.points.size(); ++k) scan.points[k].f_per_sr = result.points[k].fitted_per_sr;
  CHECK(diagnose(scan, result).reciprocal.pairs == 25);
  CHECK_FALSE(says(diagnose(scan, result).warnings, "reciprocal"));
  for (ScanPoint& p : scan.points) p.f_per_sr *= cos_deg(p.theta_o_deg);
  CHECK(says(diagnose(scan, result).warnings, "ggx is reciprocal and can follow neither side"));
  result = made_fit(scan, lobe_sum("phong-1975"), {30, 0.1, 0.5});
  const FitDiagnostics found = diagnose(scan, result);
  CHECK_FALSE(found.model_reciprocal);
  CHECK(says(found.warnings, "not reciprocal"));
  CHECK_FALSE(says(found.warnings, "follow neither side"));
}

TEST_CASE("A tangent plane needs long, gentle waves of the surface", "[fit][diagnostics]") {
  const Measurement scan = cuts(10);
  const auto of = [&](const char* model, double sigma, double t) {
    return implausible_lobes(made_fit(scan, lobe_sum(model), {sigma, t, 0, 1}));
  };
  for (const char* model : {"beckmann-kirchhoff", "he-1991"}) {
    CHECK(of(model, 0.02, 5).empty());
    CHECK(says(of(model, 0.02, 0.5), "no longer than the wavelength"));
    CHECK(says(of(model, 0.5, 1.5), "radius of curvature of 1.3 um"));
  }
  // Ulaby, Moore & Fung: T² = 2.76·σ·λ is where 4π·r_c is ten wavelengths.
  const double t = 3, sigma = t * t / (2.76 * 0.55), radius = t * t / (2 * std::sqrt(3.0) * sigma);
  CHECK(4 * std::acos(-1.0) * radius / 0.55 == Approx(10).epsilon(2e-3));
}

TEST_CASE("Steep slopes: missing shadowing, missing second reflections", "[fit][diagnostics]") {
  const Measurement scan = cuts(10);
  CHECK(says(implausible_lobes(made_fit(scan, lobe_sum("beckmann-kirchhoff"), {1, 5, 0, 1})), "has no shadowing"));
  CHECK_FALSE(says(implausible_lobes(made_fit(scan, lobe_sum("he-1991"), {1, 5, 0, 1})), "has no shadowing"));
  CHECK(says(implausible_lobes(made_fit(scan, lobe_sum("stogryn-1967"), {0.5, 0, 1})), "has no shadowing"));
  CHECK(says(implausible_lobes(made_fit(scan, lobe_sum("torrance-sparrow"), {0.9, 0, 1})), "single scattering"));
  CHECK(implausible_lobes(made_fit(scan, lobe_sum("torrance-sparrow"), {0.5, 0, 1})).empty());
  CHECK(says(implausible_lobes(made_fit(scan, lobe_sum("ggx+ggx"), {0.1, 0.1, 1.2, 1.2, 0, 0.5, 0.5})), "alpha = 1.2"));
  CHECK(implausible_lobes(made_fit(scan, lobe_sum("lambert"), {0.5})).empty());
  CHECK(implausible_lobes(made_fit(scan, lobe_sum("ggx"), {1.2, 1.2, 0.5, 0})).empty());
}

TEST_CASE("A fitted n is compared with that of the material named", "[fit][diagnostics]") {
  const Measurement scan = cuts(10);
  const auto of = [&](double n, double half_width, std::optional<std::string> material) {
    FitResult result = made_fit(scan, lobe_sum("ggx"), {0.3, 0.3, 0.1, 0.5});
    add_index(result, n, half_width);
    return implausible_index(result, material);
  };
  CHECK(of(1.5, 0.1, std::nullopt).empty());
  CHECK(says(of(2.9, 0.1, std::nullopt), "no dielectric's"));
  CHECK(says(of(1.05, 0.1, std::nullopt), "no dielectric's"));
  CHECK(of(1.52, 0.01, "N-BK7").empty());  // 1.5185 at 550 nm
  CHECK(says(of(1.8, 0.1, "N-BK7"), "1.19 times that of"));
  CHECK(of(1.7, 0.3, "N-BK7").empty());  // within its interval
  CHECK(says(of(1.8, 0.1, "Al"), "fitted with k = 0"));
  CHECK(implausible_index(made_fit(scan, lobe_sum("ggx"), {0.3, 0.3, 0.1, 0.5}), "N-BK7").empty());
}

TEST_CASE("Diagnostics of a hundred thousand points take a fraction of a second", "[fit][diagnostics]") {
  const Measurement scan = cuts(0.0096);
  FitResult result = made_fit(scan, lobe_sum("ggx"), {0.3, 0.3, 0.1, 0.5});
  add_noise(result, 0.05, 23);
  const auto start = std::chrono::steady_clock::now();
  const FitDiagnostics found = diagnose(scan, result);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  INFO(scan.points.size() << " points, " << seconds << " s");
  CHECK(found.outliers.points == static_cast<int>(scan.points.size()));
  CHECK(seconds < 2);  // 0.1 s on an idle machine; a square-law search would take minutes
}
