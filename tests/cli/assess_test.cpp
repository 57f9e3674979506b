// Values between points, charts and published pages through the command.
#include <nlohmann/json.hpp>

#include "catch.h"
#include "cli/command.h"

using namespace gonio::test;
using Json = nlohmann::json;

TEST_CASE("materials value: beyond the data only when asked, and marked", "[cli]") {
  const Outcome refused = run_gonio({"materials", "value", "D65", "--at", "790"});
  CHECK(refused.status == 2);
  CHECK(refused.err.find("expected 300 to 780") != std::string::npos);
  const Outcome asked = run_gonio({"materials", "value", "D65", "--at", "790", "--extrapolate", "nearest", "--json"});
  REQUIRE(asked.status == 0);
  const Json value = Json::parse(asked.out)["values"][0];
  CHECK(value["extrapolated"] == true);
  CHECK(value["value"].get<double>() == Approx(63.3828));  // CIE 015's value at 780 nm
  CHECK(run_gonio({"materials", "value", "D65", "--at", "790", "--extrapolate", "nearest"}).out.find("EXTRAPOLATED") !=
        std::string::npos);
  CHECK(run_gonio({"materials", "value", "Au", "--at", "555", "--interpolation", "spline"}).status == 2);
  CHECK(run_gonio({"materials", "value", "Au", "--at", "nan", "--extrapolate", "linear"}).status == 2);
}

TEST_CASE("assess and report: a page from the code, compared with the published one", "[cli]") {
  const Scratch scratch;
  const Outcome same = run_gonio({"report", "interpolation", "--check", "--out", scratch.path("page")});
  INFO(same.out);
  CHECK(same.status == 0);
  const Outcome list = run_gonio({"report", "--json"});
  REQUIRE(list.status == 0);
  CHECK(Json::parse(list.out).size() >= 2);
  CHECK(run_gonio({"report", "nothing"}).status == 2);
  CHECK(run_gonio({"assess", "speed", "nothing", "--out", scratch.path("x")}).status == 2);
  CHECK(run_gonio({"assess", "speed", "interpolation", "--out", scratch.path("speed")}).status == 0);
  CHECK(content_of(scratch.path("speed/errors.csv")) == content_of(scratch.path("page/errors.csv")));
  CHECK(content_of(scratch.path("speed/speed.svg")).find("</svg>") != std::string::npos);
}
