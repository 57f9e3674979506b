// Polarised and transmitted light, and slabs, from the command.
#include <cmath>
#include <nlohmann/json.hpp>

#include "brdf/rough_dielectric.h"
#include "catch.h"
#include "cli/command.h"

using namespace gonio;
using namespace gonio::test;
using nlohmann::json;

namespace {

const std::string kHeader = "theta_i_deg,theta_o_deg,phi_deg\n";
double first_f(const std::vector<std::string>& arguments, const std::string& row) {
  auto with = arguments;
  with.push_back("--json");
  const Outcome outcome = run_gonio(with, kHeader + row + "\n");
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  return json::parse(outcome.out)["rows"][0]["f_r_per_sr"];
}

}  // namespace

TEST_CASE("gonio eval --mueller: sixteen columns, divided by m11; Brewster's m12 = 1", "[cli]") {
  const double brewster = std::atan(1.5) * 180 / M_PI;
  const std::string row = std::to_string(brewster) + "," + std::to_string(brewster) + ",180";
  const std::vector<std::string> base{"eval", "torrance-sparrow", "--set", "m=0.2", "--n", "1.5"};
  for (const std::string precision : {"float", "double", "reference"}) {
    auto arguments = base;
    arguments.insert(arguments.end(), {"--mueller", "--precision", precision});
    const Outcome csv = run_gonio(arguments, kHeader + row + "\n");
    REQUIRE(csv.status == 0);
    CHECK(csv.out.rfind("theta_i_deg,theta_o_deg,phi_deg,f_r_per_sr,m11,m12,m13,m14,m21,m22,m23,m24,m31,m32,m33,m34,"
                        "m41,m42,m43,m44\n",
                        0) == 0);
    arguments.push_back("--json");
    const json one = json::parse(run_gonio(arguments, kHeader + row + "\n").out)["rows"][0];
    CHECK(one["m11"] == one["f_r_per_sr"]);
    CHECK(one["m12"].get<double>() == Approx(1).margin(1e-6));
    CHECK(one["m22"].get<double>() == Approx(1).margin(1e-6));
    CHECK(std::abs(one["m33"].get<double>()) < 1e-6);
    CHECK(one["m11"].get<double>() == Approx(first_f(base, row)).epsilon(2e-5));
  }
  // A lobe that has vanished says nothing of its polarisation.
  const json gone = json::parse(
      run_gonio({"eval", "torrance-sparrow", "--set", "m=0.001", "--mueller", "--json"}, kHeader + "0,80,0\n").out);
  CHECK(gone["rows"][0]["m12"].is_null());
}

TEST_CASE("gonio eval --polarisation: s and p average to the unpolarised value, at any azimuth", "[cli]") {
  const std::vector<std::string> base{
      "eval", "he-1991", "--set", "sigma0_um=0.2", "--set", "correlation_um=2", "--material", "Au", "--at", "550"};
  const std::string row = "60,50,150";
  const auto polarised = [&](const std::string& what, const std::string& precision = "double") {
    auto arguments = base;
    arguments.insert(arguments.end(), {"--polarisation", what, "--precision", precision});
    return first_f(arguments, row);
  };
  const double f = first_f(base, row), s = polarised("s"), p = polarised("p");
  CHECK(0.5 * (s + p) == Approx(f).epsilon(1e-13));
  CHECK(0.5 * (polarised("30") + polarised("120")) == Approx(f).epsilon(1e-13));
  CHECK(polarised("0") == Approx(s).epsilon(1e-14));
  CHECK(polarised("90") == Approx(p).epsilon(1e-14));
  CHECK(polarised("-20") != Approx(polarised("20")).epsilon(1e-3));  // out of the plane the two differ
  CHECK(polarised("37", "reference") == Approx(polarised("37")).epsilon(1e-10));
  CHECK(polarised("37", "float") == Approx(polarised("37")).epsilon(2e-5));
}

TEST_CASE("gonio eval rough-dielectric below the horizon: f_t of Walter et al. by hand, in every precision", "[cli]") {
  // Straight through at the normal: f_t = n²(1-F)·D(0)/(n-1)²·…, |i·h| = |o·h| = 1, G = 1: n²·(4n/(n+1)²)/(π·α²·(n-1)²).
  const double n = 1.5, alpha = 0.2,
               by_hand = n * n * (4 * n / ((n + 1) * (n + 1))) / (M_PI * alpha * alpha * (n - 1) * (n - 1));
  const std::vector<std::string> base{"eval", "rough-dielectric", "--set", "alpha=0.2", "--n", "1.5"};
  for (const std::string precision : {"float", "double", "reference"}) {
    auto arguments = base;
    arguments.insert(arguments.end(), {"--precision", precision});
    CHECK(first_f(arguments, "0,180,0") == Approx(by_hand).epsilon(precision == "float" ? 1e-5 : 1e-13));
    CHECK(first_f(arguments, "40,150,165") ==
          Approx(first_f(base, "40,150,165")).epsilon(precision == "float" ? 2e-5 : 1e-12));
    arguments.insert(arguments.end(), {"--polarisation", "25"});
    CHECK(first_f(arguments, "40,150,165") > 0);
  }
  // Reciprocity n_i²·f_t(i→o) = n_o²·f_t(o→i), the other way seen from inside the glass.
  const double there = first_f(base, "40,155,165");
  const double back =
      first_f({"eval", "rough-dielectric", "--set", "alpha=0.2", "--n", "0.66666666666666663"}, "25,140,165");
  CHECK(there == Approx(n * n * back).epsilon(1e-12));
  auto p_and_s = base;
  p_and_s.insert(p_and_s.end(), {"--polarisation", "s"});
  auto p_only = base;
  p_only.insert(p_only.end(), {"--polarisation", "p"});
  CHECK(0.5 * (first_f(p_and_s, "40,155,165") + first_f(p_only, "40,155,165")) == Approx(there).epsilon(1e-13));
  CHECK(first_f(p_only, "60,145,180") > first_f(p_and_s, "60,145,180"));  // p enters more easily
  // With the database's glass: dispersion is in f_t.
  const std::vector<std::string> glass{"eval", "rough-dielectric", "--set", "alpha=0.2", "--material", "BK7", "--at"};
  auto blue = glass, red = glass;
  blue.push_back("400"), red.push_back("700");
  CHECK(first_f(blue, "0,180,0") < first_f(red, "0,180,0"));  // a larger n spreads the light more
}

TEST_CASE("gonio fresnel --thickness-um: every path summed, absorption and dispersion by wavelength", "[cli]") {
  // Without absorption a slab in air: R = 2r/(1+r), T = (1-r)/(1+r).
  const json clear =
      json::parse(run_gonio({"fresnel", "--n", "1.5", "--thickness-um", "1000", "--angles", "0", "--json"}).out);
  CHECK(clear["rows"][0]["R"].get<double>() == Approx(0.08 / 1.04).epsilon(1e-14));
  CHECK(clear["rows"][0]["T"].get<double>() == Approx(0.96 / 1.04).epsilon(1e-14));
  // Internal transmittance exp(-4π·k·d/λ): paths counted one by one.
  const double k = 1e-6, t = std::exp(-4 * M_PI * k * 1e4 / 0.5);
  const json grey = json::parse(run_gonio({"fresnel", "--n", "1.5", "--k", "1e-6", "--thickness-um", "10000", "--at",
                                           "500", "--angles", "0", "--json"})
                                    .out);
  double reflected = 0.04, transmitted = 0, inside = 0.96 * t;
  for (int bounce = 0; bounce < 60; ++bounce) {
    transmitted += inside * 0.96;
    inside *= 0.04 * t;
    reflected += inside * 0.96;
    inside *= 0.04 * t;
  }
  CHECK(grey["rows"][0]["T"].get<double>() == Approx(transmitted).epsilon(1e-10));
  CHECK(grey["rows"][0]["R"].get<double>() == Approx(reflected).epsilon(1e-10));
  const Outcome spectrum = run_gonio(
      {"fresnel", "BK7", "--thickness-um", "10000", "--wavelengths", "400,550,700", "--angles", "0,45", "--json"});
  REQUIRE(spectrum.status == 0);
  const json glass = json::parse(spectrum.out);
  CHECK(glass["id"] == "N-BK7_SCHOTT");
  REQUIRE(glass["wavelengths"].size() == 3);
  CHECK(glass["wavelengths"][0]["n"].get<double>() > glass["wavelengths"][2]["n"].get<double>());
  for (const json& one : glass["wavelengths"]) {
    REQUIRE(one["rows"].size() == 2);
    const double r = one["rows"][0]["R"], through = one["rows"][0]["T"];
    CHECK(r + through <= 1 + 1e-15);
    CHECK(through > 0.9);
  }
}

TEST_CASE("gonio models says what a model knows of polarisation", "[cli]") {
  const auto of = [](const std::string& name) {
    return json::parse(run_gonio({"models", name, "--json"}).out)["polarisation"];
  };
  CHECK(of("he-1991") == "facets");
  CHECK(of("stogryn-1967") == "facets");
  CHECK(of("oren-nayar") == "depolarising");
  CHECK(of("ward-1992") == "not stated");
}

TEST_CASE("Polarisation, transmission and slabs: what a user may get wrong is refused", "[cli]") {
  const Scratch scratch;
  const std::string row = kHeader + "30,40,180\n", below = kHeader + "30,140,180\n";
  check_refused(scratch, {"eval", "ward-1992", "--set", "alpha=0.2", "--mueller"}, "polarisation", row);
  check_refused(scratch, {"eval", "torrance-sparrow", "--set", "m=0.2", "--set", "retro=yes", "--polarisation", "s"},
                "retro", row);
  check_refused(scratch, {"eval", "stogryn-1967", "--set", "m=0.2", "--variant", "in-plane-s", "--mueller"},
                "polarisation", row);
  check_refused(scratch, {"eval", "ggx", "--set", "alpha=0.2", "--polarisation", "x"}, "--polarisation", row);
  check_refused(scratch, {"eval", "ggx", "--set", "alpha=0.2", "--polarisation", "nan"}, "--polarisation", row);
  check_refused(scratch, {"eval", "ggx", "--set", "alpha=0.2", "--polarisation", "400"}, "--polarisation", row);
  check_refused(scratch, {"eval", "ggx", "--set", "alpha=0.2", "--polarisation", "s", "--mueller"}, "both", row);
  check_refused(scratch, {"eval", "ggx", "--set", "alpha=0.2", "--n", "1.5"}, "theta_o_deg", below);
  check_refused(scratch, {"eval", "rough-dielectric", "--set", "alpha=0.2"}, "perfect", below);
  check_refused(scratch, {"eval", "rough-dielectric", "--set", "alpha=0.2", "--n", "1.5", "--k", "1"}, "absorbs",
                below);
  check_refused(scratch, {"eval", "rough-dielectric", "--set", "alpha=0.2", "--n", "1.5"}, "transmitted",
                kHeader + "30,90,180\n");
  check_refused(scratch, {"eval", "rough-dielectric", "--set", "alpha=0.2", "--n", "1.5"}, "theta_o_deg",
                kHeader + "30,181,180\n");
  check_refused(scratch, {"fresnel", "Au", "--at", "550", "--thickness-um", "1"}, "absorbs");
  check_refused(scratch, {"fresnel", "--n", "1.5", "--thickness-um", "-1"}, "--thickness-um");
  check_refused(scratch, {"fresnel", "--n", "1.5", "--k", "1e-6", "--thickness-um", "10"}, "wavelength");
  check_refused(scratch, {"fresnel", "BK7", "--at", "550", "--wavelengths", "400,500"}, "--wavelengths");
  check_refused(scratch, {"fresnel", "--n", "1.5", "--wavelengths", "400,500"}, "--wavelengths");
}
