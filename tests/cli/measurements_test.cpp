// gonio measurements info, convert, plot, compare, as a person or a script meets them.
#include <nlohmann/json.hpp>

#include "catch.h"
#include "cli/json_of.h"

using namespace gonio::test;
using Json = nlohmann::ordered_json;

namespace {

std::string sample(const std::string& name) { return std::string(GONIO_SOURCE_DIR) + "/tests/fit/samples/" + name; }

Json answer_of(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "measurements");
  return json_of(std::move(arguments));
}

}  // namespace

TEST_CASE("measurements info says what is there and how it was read", "[cli][formats]") {
  const Json info = answer_of({"info", sample("painted.astm")});
  CHECK(info["points"] == 9);
  CHECK(info["incidences_deg"] == Json::array({30.0, 60.0}));
  CHECK(info["wavelengths_nm"] == Json::array({465.0, 525.0, 630.0}));
  CHECK(info["f_per_sr"] == Json::array({0.0625, 1.5}));
  CHECK(info["conventions"].size() == 4);
  CHECK(info["left_out"]["zenith angle of 90 degrees"] == 3);
  CHECK(answer_of({"info", std::string(GONIO_SOURCE_DIR) + "/measurements/aluminium-merl"})["conventions"].size() == 4);
  const Outcome text = run_gonio({"measurements", "info", sample("he.txt")});
  CHECK(text.status == 0);
  CHECK(text.out.find("read as      azimuth: signed") != std::string::npos);
}

TEST_CASE("a broken file of a format's own ending is refused by that format's reader", "[cli][formats]") {
  const Scratch scratch;
  scratch.file("cut.binary", std::string("\x5a\0\0\0\x5a\0", 6));
  check_refused(scratch, {"measurements", "info", scratch.path("cut.binary")}, "offset");
  scratch.file("broken.ddr", "no table\n");
  check_refused(scratch, {"measurements", "info", scratch.path("broken.ddr")}, "broken.ddr:1");
}

TEST_CASE("measurements convert writes what reads back, and says what has no place", "[cli][formats]") {
  const Scratch scratch;
  CHECK(answer_of({"convert", sample("he.txt"), "-o", scratch.path("he")})["format"] == "csv");
  const Json astm = answer_of({"convert", sample("he.txt"), "-o", scratch.path("he.astm")});
  CHECK(astm["not_written"] == Json::array({"standard deviations"}));
  const Json same = answer_of({"compare", scratch.path("he"), scratch.path("he.astm"), "--tolerance-deg", "0"});
  CHECK(same["compared"] == 3);
  CHECK(same["ratio_mean"] == 1.0);
  CHECK(same["rms_log10"] == 0.0);
  check_refused(scratch, {"measurements", "convert", sample("he.txt"), "-o", scratch.path("x"), "--to", "merl"},
                "--to");
  check_refused(scratch, {"measurements", "info", sample("he.txt"), "--format", "tea"}, "tea");
  check_refused(scratch, {"measurements", "info", sample("vinyl.bsdf"), "--format", "lighttools"}, "vinyl.bsdf:");
}

TEST_CASE("measurements plot draws; compare without a common direction is exit 1", "[cli][formats]") {
  const Scratch scratch;
  CHECK(answer_of({"plot", sample("vinyl.bsdf"), "-o", scratch.path("a.svg")})["curves"] == 2);
  const std::string svg = content_of(scratch.path("a.svg"));
  CHECK(svg.find("</svg>") != std::string::npos);
  CHECK(svg.find("30°") != std::string::npos);
  const Outcome none = run_gonio({"measurements", "compare", sample("he.txt"), sample("retro.alta")});
  CHECK(none.status == 1);
  check_refused(scratch, {"measurements", "plot", sample("vinyl.bsdf"), "-o", scratch.path("a.gif")}, "--out");
}

TEST_CASE("a foreign file is fitted like a folder, and how it was read is said", "[cli][formats]") {
  const Scratch scratch;
  const std::string rows = [] {
    std::string text = "# columns: theta_i theta_o value\n# angles: degrees\n# quantity: brdf\n# azimuth: signed\n";
    for (const int i : {0, 20, 40, 60})
      for (int o = -80; o <= 80; o += 10) text += std::to_string(i) + " " + std::to_string(o) + " 0.25\n";
    return text;
  }();
  const Outcome fitted = run_gonio({"fit", scratch.file("flat.txt", rows), "--model", "lambert", "--material",
                                    "perfect", "--out", scratch.path("out"), "--json"});
  INFO(fitted.err);
  REQUIRE(fitted.status == 0);
  CHECK(Json::parse(fitted.out)["parameters"]["kd"]["value"].get<double>() ==
        Approx(0.25 * 3.141592653589793).epsilon(1e-6));
  CHECK(fitted.err.find("read as: azimuth: signed") != std::string::npos);
}
