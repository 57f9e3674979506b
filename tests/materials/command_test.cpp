// `gonio materials` and `gonio color` from outside: the keys of the contract and figures known from elsewhere.
#include "cli/command.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "catch.h"

using namespace gonio::test;
using Json = nlohmann::json;

namespace {

Json json_of(std::vector<std::string> arguments) {
  arguments.emplace_back("--json");
  const Outcome outcome = run_gonio(arguments);
  REQUIRE(outcome.status == 0);
  REQUIRE(outcome.err.empty());
  return Json::parse(outcome.out);
}

}  // namespace

TEST_CASE("materials list: one object an entry, with the contract's keys", "[materials]") {
  const Json list = json_of({"materials", "list"});
  CHECK(list.size() >= 960);
  for (const Json& entry : list) {
    for (const char* key : {"id", "kind", "name", "source", "licence"})
      CHECK(!entry.at(key).get<std::string>().empty());
    REQUIRE(entry.at("range_nm").size() == 2);
    CHECK(entry["range_nm"][0].get<double>() < entry["range_nm"][1].get<double>());
  }
  const Json gold = json_of({"materials", "search", "gold", "christy"});
  REQUIRE(gold.size() == 1);
  CHECK(gold[0]["id"] == "Au_Johnson");
}

TEST_CASE("materials show: the card, and the values at a wavelength unrounded", "[materials]") {
  const Json at = json_of({"materials", "show", "Au", "--at", "548.6"});
  CHECK(at["id"] == "Au_Johnson");
  CHECK(at["wavelength_nm"] == 548.6);
  CHECK(at["n"] == 0.43);  // a point of Johnson & Christy's table
  CHECK(at["k"] == 2.455);
  CHECK(at["R_normal"].get<double>() ==
        Approx((0.57 * 0.57 + 2.455 * 2.455) / (1.43 * 1.43 + 2.455 * 2.455)).epsilon(1e-14));
  CHECK(at["source"].get<std::string>().find("Johnson") != std::string::npos);
  CHECK(at["licence"].get<std::string>().find("CC0") == 0);
  const std::string card = run_gonio({"materials", "show", "BK7"}).out;
  for (const char* word : {"N-BK7_SCHOTT", "sellmeier-2", "300 to 2500 nm", "SCHOTT Zemax catalog", "CC0 1.0"})
    CHECK_THAT(card, Catch::Contains(word));
}

TEST_CASE("fresnel: the weak absorption of a glass does not hide its transmittance", "[materials]") {
  const Json rows = json_of({"fresnel", "BK7", "--at", "550", "--angles", "0"});
  CHECK(rows["k"].get<double>() > 0);
  CHECK(rows["rows"][0]["T"].get<double>() == Approx(1 - 0.5185 * 0.5185 / (2.5185 * 2.5185)).epsilon(1e-4));
  CHECK_FALSE(json_of({"fresnel", "Au", "--at", "550", "--angles", "0"})["rows"][0].contains("T"));
}

TEST_CASE("materials check: silent on the bundled database, exit 1 with findings", "[materials]") {
  const Json good = json_of({"materials", "check"});
  CHECK(good["findings"].empty());
  CHECK(good["entries"].get<int>() >= 960);
  const Scratch scratch;
  CHECK(run_gonio({"materials", "check", scratch.path()}).status == 1);
  CHECK(run_gonio({"materials", "search", "unobtainium"}).status == 1);
}

TEST_CASE("color: the contract's keys; the perfect diffuser is the light's white", "[materials]") {
  const Json white = json_of({"color", "perfect", "--light", "D65", "--observer", "1931-2"});
  CHECK(white["XYZ"][1].get<double>() == Approx(100).epsilon(1e-14));
  CHECK(white["xyY"][0].get<double>() == Approx(0.31272).margin(2e-5).epsilon(0));
  CHECK(white["xyY"][1].get<double>() == Approx(0.32903).margin(2e-5).epsilon(0));
  CHECK(white["Lab"][0].get<double>() == Approx(100).epsilon(1e-13));
  CHECK(white["Luv"][1].get<double>() == Approx(0).margin(1e-10));
  CHECK(json_of({"color", "perfect", "--light", "A"})["xyY"][0].get<double>() ==
        Approx(0.44758).margin(2e-5).epsilon(0));
}

TEST_CASE("color --difference: zero for one and the same, the distance of L*a*b* otherwise", "[materials]") {
  const Json same = json_of({"color", "--difference", "Au", "gold"});
  for (const char* key : {"delta_E_ab", "delta_E_uv", "delta_E_2000"}) CHECK(same[key] == 0.0);
  const Json other = json_of({"color", "--difference", "Au", "Ag", "--light", "A"});
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    const double d = other["colors"][0]["Lab"][i].get<double>() - other["colors"][1]["Lab"][i].get<double>();
    sum += d * d;
  }
  CHECK(other["delta_E_ab"].get<double>() == Approx(std::sqrt(sum)).epsilon(1e-13));
  CHECK(other["delta_E_2000"].get<double>() > 5);
}

TEST_CASE("color: what cannot be a colour is refused in one line", "[materials]") {
  const Scratch scratch;
  check_refused(scratch, {"color"}, "expected an ID");
  check_refused(scratch, {"color", "Au", "--difference", "Au", "Ag"}, "both");
  check_refused(scratch, {"color", "D65"}, "kind illuminant");
  check_refused(scratch, {"color", "Au", "--light", "1931-2"}, "expected an illuminant");
  check_refused(scratch, {"color", "Au", "--observer", "D65"}, "expected an observer");
}
