// The contract's JSON and the bars on its numbers, met through the command itself.
#include <nlohmann/json.hpp>

#include "catch.h"
#include "cli/command.h"
#include "oracles/fifty_digits.h"

using namespace gonio;
using namespace gonio::test;
using nlohmann::json;

TEST_CASE("gonio fresnel answers with the contract's keys and 13 digits", "[cli]") {
  const Outcome outcome = run_gonio({"fresnel", "--n", "0.97", "--k", "6.7", "--angles", "0,30,89.99", "--json"});
  REQUIRE(outcome.status == 0);
  const json answer = json::parse(outcome.out);
  CHECK(answer["n"] == 0.97);
  CHECK(answer["k"] == 6.7);
  REQUIRE(answer["rows"].size() == 3);
  for (const json& row : answer["rows"]) {
    const auto exact = oracle::fresnel(row["theta_deg"], 0.97, 6.7);
    CHECK(row["R_s"].get<double>() == Approx(exact.s.convert_to<double>()).epsilon(1e-13));
    CHECK(row["R_p"].get<double>() == Approx(exact.p.convert_to<double>()).epsilon(1e-13));
    CHECK_FALSE(row.contains("T"));
  }
  const json glass = json::parse(run_gonio({"fresnel", "BK7", "--at", "550", "--from", "1.33", "--json"}).out);
  CHECK(glass["rows"][0].contains("T_s"));
  CHECK(glass["id"] == "N-BK7_SCHOTT");
  CHECK(glass["n"].get<double>() == Approx(1.5185 / 1.33).epsilon(1e-4));
}

TEST_CASE("gonio eval writes the same rows and f_r, in every precision", "[cli]") {
  const std::string rows = "wavelength_nm,theta_i_deg,theta_r_deg,phi_deg,comment\n550,30,40,170,a\n633,75,70,180,b\n";
  for (const auto& [precision, bar] : {std::pair{"float", 2e-5}, {"double", 1e-10}, {"reference", 1e-12}}) {
    const Outcome outcome = run_gonio({"eval", "beckmann-kirchhoff", "--set", "sigma_um=0.2", "--set", "correlation_um=3", "--precision",
                                       precision, "--json"}, rows);
    REQUIRE(outcome.status == 0);
    const json answer = json::parse(outcome.out);
    REQUIRE(answer["rows"].size() == 2);
    const double first = answer["rows"][0]["f_r_per_sr"], second = answer["rows"][1]["f_r_per_sr"];
    CHECK(first == Approx(oracle::kirchhoff(30, 40, 170, 0.2, 3, 0.55).convert_to<double>()).epsilon(bar));
    CHECK(second == Approx(oracle::kirchhoff(75, 70, 180, 0.2, 3, 0.633).convert_to<double>()).epsilon(bar));
    CHECK(answer["rows"][0].contains("coherent_energy"));
  }
  const Outcome csv = run_gonio({"eval", "lambert", "--set", "kd=0.5"}, rows);
  CHECK(csv.out.rfind("wavelength_nm,theta_i_deg,theta_r_deg,phi_deg,comment,f_r_per_sr\n550,30,40,170,a,0.15915494309189", 0) == 0);
}

TEST_CASE("m and alpha name one roughness: alpha = sqrt(2) m", "[cli]") {
  const std::string rows = "theta_i_deg,theta_o_deg,phi_deg\n20,35,160\n";
  const json by_m = json::parse(run_gonio({"eval", "torrance-sparrow", "--set", "m=0.2", "--json"}, rows).out);
  const json by_alpha =
      json::parse(run_gonio({"eval", "torrance-sparrow", "--set", "alpha=0.28284271247461903", "--json"}, rows).out);
  CHECK(by_m["rows"][0]["f_r_per_sr"].get<double>() == Approx(by_alpha["rows"][0]["f_r_per_sr"].get<double>()).epsilon(1e-14));
}

TEST_CASE("gonio table limits: E = 1.149 of the pseudo-realistic model at m = 1, 89 degrees; exit 1 where (43) breaks", "[cli]") {
  const Outcome broken = run_gonio({"table", "limits", "pseudo-realistic", "--set", "m=1", "--angles", "89", "--json"});
  CHECK(broken.status == 1);
  const json answer = json::parse(broken.out);
  REQUIRE(answer["E"].size() == 1);
  CHECK(answer["E"][0]["E"].get<double>() == Approx(1.149).margin(5e-4));
  CHECK(answer["E"][0]["error"].get<double>() < 1e-6);
  CHECK(answer["ks_max"].get<double>() < 1 / 1.149);
  for (const auto* key : {"kd_max", "coherent_energy", "range_nm"}) CHECK(answer.contains(key));
  const Outcome held = run_gonio({"table", "limits", "pseudo-realistic", "--set", "m=0.3", "--material", "Au", "--at", "550", "--ks", "0.5", "--json"});
  CHECK(held.status == 0);
  CHECK(json::parse(held.out)["kd_max"].get<double>() > 0.5);
}

TEST_CASE("gonio models lists parameters with units and ranges", "[cli]") {
  const json all = json::parse(run_gonio({"models", "--json"}).out);
  REQUIRE(all.size() >= 4);
  for (const json& one : all)
    for (const json& p : one["parameters"]) {
      CHECK(p.contains("unit"));
      CHECK(p["range"].size() == 2);
    }
}
