// gonio table scatter, and what measurements info and fit say of a scan's and a fit's own consistency.
#include <nlohmann/json.hpp>

#include "catch.h"
#include "cli/json_of.h"

using namespace gonio::test;
using Json = nlohmann::ordered_json;

namespace {

std::string measurement(const std::string& name) { return std::string(GONIO_SOURCE_DIR) + "/measurements/" + name; }

}  // namespace

TEST_CASE("table scatter: a white surface into a cone, a mirror's beam into its stop", "[cli][cone]") {
  const Json white = json_of(
      {"table", "scatter", "lambert", "--set", "kd=0.8", "--theta-i", "8", "--axis", "normal", "--half-angle", "30"});
  CHECK(white["reflectance"].get<double>() == Approx(0.8 * 0.25).epsilon(1e-6));
  CHECK(white["hemisphere"]["reflectance"].get<double>() == Approx(0.8).epsilon(1e-6));
  CHECK(white["share"].get<double>() == Approx(0.25).epsilon(1e-6));
  CHECK(white["error"].get<double>() <= 1e-6);
  const std::vector<std::string> polished{"table", "scatter",          "he-1991",    "--set", "sigma0_um=0.005",
                                          "--set", "correlation_um=2", "--material", "Al",    "--at",
                                          "633",   "--theta-i",        "8"};
  const auto with = [&](std::vector<std::string> more) {
    std::vector<std::string> all = polished;
    all.insert(all.end(), more.begin(), more.end());
    return json_of(all);
  };
  // Bennett & Porteus 1961: TIS = 1 - exp(-(4π·σ·cos θ/λ)²), which for small σ is what leaves the specular beam.
  const double phase = 4 * std::acos(-1.0) * 0.005 * std::cos(8 * std::acos(-1.0) / 180) / 0.633;
  const Json tis = with({"--axis", "normal", "--stop", "0.01"});
  CHECK(tis["share"].get<double>() == Approx(1 - std::exp(-phase * phase)).epsilon(0.01));
  CHECK(tis["coherent"] == 0.0);
  const Json beam = with({"--half-angle", "0.01"});
  CHECK(beam["share"].get<double>() + tis["share"].get<double>() == Approx(1).epsilon(1e-6));
}

TEST_CASE("table scatter refuses what is no cone, and needs a wavelength where the model does", "[cli][cone]") {
  const Scratch scratch;
  const std::vector<std::string> ggx{"table", "scatter", "ggx", "--set", "alpha=0.1"};
  const auto with = [&](std::vector<std::string> more) {
    std::vector<std::string> all = ggx;
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  check_refused(scratch, with({"--axis", "up"}), "--axis");
  check_refused(scratch, with({"--axis", "95,0"}), "0 to 90");
  check_refused(scratch, with({"--half-angle", "91"}), "half-angle");
  check_refused(scratch, {"table", "scatter", "he-1991", "--set", "sigma0_um=0.1", "--set", "correlation_um=2"},
                "--at");
  const Outcome text = run_gonio(with({"--theta-i", "20", "--half-angle", "5", "--stop", "1"}));
  CHECK(text.status == 0);
  CHECK(text.out.find("less 1 degrees about the mirror direction") != std::string::npos);
}

TEST_CASE("measurements info: reflectance of a scanned hemisphere, reciprocal pairs, noise", "[cli][quality]") {
  const Json ptfe = json_of({"measurements", "info", measurement("ptfe-sintered-nist-532nm")})["quality"];
  REQUIRE(ptfe["reflectance"].size() == 6);
  for (const Json& e : ptfe["reflectance"])
    CHECK(e["value"].get<double>() == Approx(0.98).margin(0.015));  // sintered PTFE
  CHECK(ptfe["warnings"].empty());
  const Json tape = json_of({"measurements", "info", measurement("retro-tape-yellow")})["quality"];
  CHECK(tape["noise"]["from"] == "reciprocity");
  CHECK(tape["reciprocal"]["pairs"].get<int>() > 100);
  const Outcome text = run_gonio({"measurements", "info", measurement("ptfe-sintered-nist-532nm")});
  CHECK(text.out.find("of the light from 75 degrees") != std::string::npos);
}

TEST_CASE("fit writes its diagnostics and where it misses the scan", "[cli][diagnostics]") {
  const Scratch scratch;
  const Json fit = json_of(
      {"fit", measurement("starlink-chassis-532nm"), "--model", "ggx", "--starts", "4", "-o", scratch.path("out")});
  CHECK(fit["diagnostics"]["energy"]["largest"].get<double>() > 0);
  CHECK(fit["diagnostics"]["outliers"]["largest"].size() <= 20);
  CHECK(fit["diagnostics"]["model_reciprocal"] == true);
  CHECK(Json::parse(content_of(scratch.path("out/fit.json"))) == fit);
  const std::string map = content_of(scratch.path("out/residuals.svg"));
  CHECK(map.find("</svg>") != std::string::npos);
}

TEST_CASE("The likelihood takes what a scan's reciprocal pairs show where it states no standard deviation",
          "[cli][quality]") {
  const Scratch scratch;
  const std::string tape = measurement("retro-tape-yellow");
  const Json fit = json_of(
      {"fit", tape, "--model", "oren-nayar", "--metric", "likelihood", "--starts", "2", "-o", scratch.path("a")});
  const double noise = json_of({"measurements", "info", tape})["quality"]["noise"]["relative_sd"];
  CHECK(fit["relative_sd"].get<double>() == noise);
  CHECK(fit["warnings"].dump().find("standard deviations are not stated") != std::string::npos);
  check_refused(scratch,
                {"fit", measurement("ptfe-sintered-nist-532nm"), "--model", "lambert", "--metric", "likelihood", "-o",
                 scratch.path("b")},
                "the standard deviation of its values is not known");
}
