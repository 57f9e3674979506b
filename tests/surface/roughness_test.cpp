// Roughness of synthetic profiles whose truth is known: a Gaussian autocorrelation made by filtering white noise.
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <random>

#include "base/error.h"
#include "base/files.h"
#include "base/number.h"
#include "catch.h"
#include "cli/command.h"
#include "fit/profile.h"
#include "surface/instrument.h"

using namespace gonio;
using namespace gonio::test;

namespace {

/// White noise under exp(-2x²/T²) has autocorrelation exp(-τ²/T²).
HeightProfile gaussian_profile(double sigma, double correlation, double step, std::size_t size, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const int reach = int(2.5 * correlation / step);
  std::vector<double> noise(size + 2 * std::size_t(reach)), window;
  for (double& x : noise) x = normal(random);
  double power = 0;
  for (int j = -reach; j <= reach; ++j) window.push_back(std::exp(-2 * square(j * step / correlation))), power += square(window.back());
  HeightProfile profile{"made", step, std::vector<double>(size)};
  for (std::size_t i = 0; i < size; ++i)
    for (std::size_t j = 0; j < window.size(); ++j) profile.z_um[i] += sigma / std::sqrt(power) * window[j] * noise[i + j];
  return profile;
}

bool holds(const Estimate& e, double truth) {
  return e.interval95 && e.interval95->first <= truth && truth <= e.interval95->second;
}

}  // namespace

TEST_CASE("Roughness: the truth of synthetic profiles, and the share of intervals that hold it", "[surface]") {
  const double sigma = 0.4, correlation = 5, m = std::sqrt(2.0) * sigma / correlation;
  const double curvature = 2 * std::sqrt(3.0) * sigma / square(correlation);
  int held_sigma = 0, held_t = 0, held_m = 0, held_curvature = 0;
  const int repeats = 40;
  for (int seed = 1; seed <= repeats; ++seed) {
    const Roughness r = roughness_of({detrended(gaussian_profile(sigma, correlation, 0.625, 4000, unsigned(seed)), Detrend::line)});
    held_sigma += holds(r.sigma_um, sigma), held_t += holds(r.correlation_um, correlation);
    held_m += holds(r.slope_rms, m), held_curvature += holds(r.curvature_per_um, curvature);
    CHECK(r.sigma_um.value == Approx(sigma).epsilon(0.15));
    CHECK(r.correlation_um.value == Approx(correlation).epsilon(0.15));
    CHECK(r.slope_rms.value == Approx(m).epsilon(0.15));
    CHECK(r.curvature_per_um.value == Approx(curvature).epsilon(0.15));
  }
  INFO(held_sigma << " " << held_t << " " << held_m << " " << held_curvature << " of " << repeats);
  for (const int held : {held_sigma, held_t, held_m, held_curvature}) CHECK(held >= 32);  // at 92 %: fewer once in 1,000
}

TEST_CASE("Roughness: optical averaging follows its closed form, a tip never draws below the surface", "[surface]") {
  const HeightProfile profile = gaussian_profile(0.4, 5, 0.625, 20000, 7);
  const GaussianSurface expected = averaged(GaussianSurface{0.4, 5}, 3, 1);
  const Roughness r = roughness_of({detrended(averaged(profile, 3), Detrend::mean)});
  CHECK(r.sigma_um.value == Approx(expected.sigma_um).epsilon(0.05));
  CHECK(r.correlation_um.value == Approx(expected.correlation_um).epsilon(0.05));
  const auto back = before_averaging(expected, 3, 1);
  REQUIRE(back);
  CHECK(back->sigma_um == Approx(0.4).epsilon(1e-12));
  CHECK(back->correlation_um == Approx(5).epsilon(1e-12));
  const HeightProfile trace = stylus_trace(profile, 20);
  for (std::size_t i = 0; i < trace.z_um.size(); ++i) REQUIRE(trace.z_um[i] >= profile.z_um[i] - 1e-12);
}

TEST_CASE("Rayleigh: path difference below a quarter wavelength", "[surface]") {
  CHECK(rayleigh_height_um(0.55, 0) == Approx(0.55 / 8).epsilon(1e-14));
  CHECK(rayleigh_height_um(0.55, 60) == Approx(0.55 / 4).epsilon(1e-14));
  CHECK(rayleigh_angle_deg(0.55, 0.55 / 4) == Approx(60).epsilon(1e-12));
  CHECK(rayleigh_angle_deg(0.55, 0.01) == 0);
}

TEST_CASE("gonio surface answers in JSON, and refuses what is no profile with file and line", "[cli]") {
  const HeightProfile profile = gaussian_profile(0.4, 5, 0.625, 4000, 3);
  std::string text = "x_um,z_nm\n";
  for (std::size_t i = 0; i < profile.z_um.size(); ++i) text += fmt::format("{},{}\n", 0.625 * double(i), 1000 * profile.z_um[i]);
  const auto folder = std::filesystem::temp_directory_path() / "gonio_surface_test";
  make_folder(folder);
  write_file(folder / "good.csv", text);
  write_file(folder / "bad.csv", "x_um,z_um\n0,1\n1,2\n1,3\n");
  const Outcome good = run_gonio({"surface", (folder / "good.csv").string(), "--json", "--out", (folder / "out").string()});
  REQUIRE(good.status == 0);
  const auto answer = nlohmann::json::parse(good.out);
  CHECK(answer["sigma_um"]["value"].get<double>() == Approx(0.4).epsilon(0.15));
  CHECK(answer["m"]["interval95"].size() == 2);
  CHECK(read_file(folder / "out" / "histogram.csv").starts_with("z_um,count,gaussian_count\n"));
  const Outcome bad = run_gonio({"surface", (folder / "bad.csv").string()});
  CHECK(bad.status == 2);
  CHECK(bad.err.find("bad.csv:") != std::string::npos);
  std::string flat = "x_um,z_um\n";
  for (int i = 0; i < 40; ++i) flat += fmt::format("{},1\n", i);
  write_file(folder / "flat.csv", flat);
  const Outcome none = run_gonio({"surface", (folder / "flat.csv").string()});
  CHECK(none.status == 2);
  CHECK(none.err.find("flat.csv:") != std::string::npos);
  std::filesystem::remove_all(folder);
}
