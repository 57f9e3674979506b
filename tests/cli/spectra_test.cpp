// What the colour and materials commands tell of lights, sensors, metamers, depths, Kramers-Kronig, plots and swatches.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "catch.h"
#include "cli/json_of.h"

using namespace gonio::test;
using Json = nlohmann::ordered_json;

TEST_CASE("light: temperature, efficacy, and watts from lumens", "[cli]") {
  const Json d65 = json_of({"light", "D65"});
  CHECK(d65["id"] == "D65");
  CHECK(d65["color_temperature_K"].get<double>() == Approx(6504).margin(3));
  CHECK(d65["XYZ"][1].get<double>() == Approx(100).epsilon(1e-13));
  CHECK(d65["scotopic_over_photopic"].get<double>() == Approx(2.47).margin(0.02));
  const Json lamp = json_of({"light", "A", "--lumens", "800"});
  CHECK(lamp["photopic_lm"].get<double>() == Approx(800).epsilon(1e-12));
  CHECK(lamp["XYZ_absolute_lm"][1].get<double>() == Approx(800).epsilon(1e-4));
  CHECK(lamp["radiant_W"].get<double>() * lamp["photopic_lm_per_W"].get<double>() == Approx(800).epsilon(1e-12));
  const Scratch scratch;
  check_refused(scratch, {"light", "Au"}, "expected an illuminant");
  check_refused(scratch, {"light", "A", "--watts", "-1"}, "expected more than 0");
}

TEST_CASE("materials show --at: depths of what absorbs", "[cli]") {
  const Json gold = json_of({"materials", "show", "Au_Johnson", "--at", "548.6"});
  const double pi = std::acos(-1.0);
  CHECK(gold["intensity_depth_nm"].get<double>() == Approx(548.6 / (4 * pi * 2.455)).epsilon(1e-13));
  CHECK(gold["field_depth_nm"].get<double>() == Approx(548.6 / (2 * pi * 2.455)).epsilon(1e-13));
  CHECK_FALSE(json_of({"materials", "show", "SiO2_Malitson", "--at", "550"}).contains("field_depth_nm"));
}

TEST_CASE("materials show --path and fresnel --conductivity", "[cli]") {
  const Json water = json_of({"materials", "show", "H2O_Hale", "--at", "700", "--path", "1000"});
  const double k = water["k"].get<double>();
  CHECK(water["internal_transmittance"].get<double>() ==
        Approx(std::exp(-4 * std::acos(-1.0) * k * 1e9 / 700)).epsilon(1e-12));
  CHECK(water["internal_transmittance"].get<double>() ==
        Approx(0.55).margin(0.1));  // a metre of water takes half the red
  const Json copper = json_of({"fresnel", "--conductivity", "5.96e7", "--at", "1e6", "--angles", "0"});
  CHECK(1 - copper["rows"][0]["R"].get<double>() ==
        Approx(2 * std::sqrt(2 * 8.8541878128e-12 * 1.8836516e12 / 5.96e7)).epsilon(2e-3));
  const Scratch scratch;
  check_refused(scratch, {"fresnel", "--conductivity", "5.96e7"}, "expected --at NM");
  check_refused(scratch, {"fresnel", "Au", "--conductivity", "5.96e7", "--at", "550"}, "given with an index");
  for (const char* path : {"nan", "-1", "inf"})
    check_refused(scratch, {"materials", "show", "BK7", "--at", "550", "--path", path}, "expected 0 mm or more");
  for (const char* command : {"plot", "kk"})
    check_refused(scratch, {"materials", command, "Au", "--lo", "nan", "--hi", "700"}, "expected two wavelengths");
  check_refused(scratch, {"materials", "show", "D65", "--at", "550", "--path", "1"}, "expected optical-constants");
}

TEST_CASE("color: a user's curves as the observer", "[cli]") {
  const Scratch scratch;
  const std::string film = scratch.file("film.csv", "wavelength_nm,red,green\n600,0,0\n640,1,0\n680,0,0\n");
  check_refused(scratch, {"color", "Au", "--observer", film}, "channel green sees nothing");
  const std::string good =
      scratch.file("good.csv", "wavelength_nm,red,blue\n440,0,0\n450,0,1\n460,0,0\n600,0,0\n640,1,0\n680,0,0\n");
  const Json seen = json_of({"color", "Au", "--observer", good});
  CHECK(seen["observer"] == good);
  CHECK(seen["responses"]["red"].get<double>() > 90);
  CHECK(seen["responses"]["blue"].get<double>() < 45);
  const std::string unsorted = scratch.file("unsorted.csv", "wavelength_nm,red\n600,0\n500,1\n");
  check_refused(scratch, {"color", "Au", "--observer", unsorted},
                "unsorted.csv:3: wavelength_nm is 500; expected more than 600");
  check_refused(scratch, {"light", "A", "--observer", good}, "expected xbar, ybar, zbar");
}

TEST_CASE("color --sum: weights of ASTM E2022 close to the sum at 1 nm", "[cli]") {
  const Json direct = json_of({"color", "colorchecker-ohta-orange"});
  const Json weighed = json_of({"color", "colorchecker-ohta-orange", "--sum", "astm-e2022-10"});
  for (int i = 0; i < 3; ++i) {
    CHECK(weighed["Lab"][i].get<double>() == Approx(direct["Lab"][i].get<double>()).margin(0.15));
    CHECK(weighed["Lab"][i] != direct["Lab"][i]);
  }
}

TEST_CASE("color --metamer-under: one colour under the first light, two under the second", "[cli]") {
  const Scratch scratch;
  const Json metamer =
      json_of({"color", "colorchecker-ohta-red", "--metamer-under", "FL11", "--out", scratch.path("m.csv")});
  CHECK(metamer["delta_E_2000"][0].get<double>() < 1e-6);
  CHECK(metamer["delta_E_2000"][1].get<double>() > 1);
  CHECK(content_of(scratch.path("m.csv")).starts_with("wavelength_nm,reflectance,metamer\n380,"));
  check_refused(scratch, {"color", "Au", "--out", "x.csv"}, "without --metamer-under");
}

TEST_CASE("materials kk: a file's reflectance becomes n and k with intervals", "[cli]") {
  const Scratch scratch;
  std::string csv = "wavelength_nm,reflectance\n";
  for (int nm = 1; nm <= 1000; nm += 3) csv += std::to_string(nm) + ",0.04\n";  // glass of n = 1.5, all over
  const Json json =
      json_of({"materials", "kk", scratch.file("glass.csv", csv), "--decay", "0", "--out", scratch.path("nk.csv")});
  const Json& row = json["rows"][200];
  CHECK(row["R"] == Approx(0.04));
  CHECK(row["k"].get<double>() == Approx(0).margin(1e-12));
  // A constant R has φ = 0 (n > 1) or φ = π (n < 1); the transform gives the first.
  CHECK(row["n"].get<double>() == Approx(1.5).epsilon(1e-12));
  CHECK(row["n_interval"][0].get<double>() <= 1.5);
  CHECK(content_of(scratch.path("nk.csv")).starts_with("wavelength_nm,R,phase_rad,n,k,"));
  check_refused(scratch,
                {"materials", "kk", scratch.file("bad.csv", "wavelength_nm,reflectance\n400,0.5\n500,1.5\n600,0.5\n")},
                "R = 1.5 at 500 nm; expected 0 < R <= 1");
}

TEST_CASE("materials plot: SVG and PNG, the same bytes twice", "[cli]") {
  const Scratch scratch;
  for (const char* name : {"a.svg", "b.svg", "a.png", "b.png"})
    REQUIRE(run_gonio({"materials", "plot", "Au", "BK7", "D65", "1931-2", "--lo", "380", "--hi", "780", "--out",
                       scratch.path(name)})
                .status == 0);
  const std::string svg = content_of(scratch.path("a.svg"));
  for (const char* word : {"Au_Johnson", "N-BK7_SCHOTT", "D65", "1931-2 zbar", "R at normal incidence"})
    CHECK_THAT(svg, Catch::Contains(word));
  CHECK(svg == content_of(scratch.path("b.svg")));
  CHECK(content_of(scratch.path("a.png")) == content_of(scratch.path("b.png")));
  CHECK(content_of(scratch.path("a.png")).starts_with("\x89PNG"));
  check_refused(scratch, {"materials", "plot", "Au", "--out", scratch.path("c.pdf")}, "expected FILE.svg or FILE.png");
  check_refused(scratch, {"materials", "plot", "Au", "--lo", "5000", "--hi", "6000", "--out", scratch.path("c.svg")},
                "expected some of 5000 to 6000 nm");
}

TEST_CASE("materials swatch: white is white under every light; gold lies outside sRGB", "[cli]") {
  const Scratch scratch;
  const Json sheet = json_of({"materials", "swatch", "perfect", "Au", "colorchecker-ohta-neutral-5", "--light", "D65",
                              "A", "FL2", "--out", scratch.path("s.svg")});
  REQUIRE(sheet["swatches"].size() == 9);
  for (const Json& swatch : sheet["swatches"]) {
    INFO(swatch.dump());
    if (swatch["id"] == "perfect") CHECK(swatch["sRGB_8bit"] == Json({255, 255, 255}));
    if (swatch["id"] == "perfect") CHECK(swatch["out_of_gamut"] == false);
    if (swatch["id"] == "Au_Johnson") CHECK(swatch["out_of_gamut"] == (swatch["linear_sRGB"][0].get<double>() > 1));
    if (swatch["id"] ==
        "colorchecker-ohta-neutral-5") {  // McCamy's neutral 5 is sRGB (122, 122, 121) in the chart's data sheet
      CHECK(swatch["sRGB_8bit"][0].get<int>() == Approx(122).margin(4));
      CHECK(swatch["sRGB_8bit"][2].get<int>() == Approx(121).margin(4));
    }
  }
  // The cell of gold is in the picture with its own colour.
  const Json& gold = sheet["swatches"][1]["sRGB_8bit"];
  CHECK_THAT(content_of(scratch.path("s.svg")),
             Catch::Contains(
                 fmt::format("rgb({:>3}, {:>3}, {:>3})", gold[0].get<int>(), gold[1].get<int>(), gold[2].get<int>())));
  const Json tinted = json_of(
      {"materials", "swatch", "perfect", "--light", "A", "--adaptation", "none", "--out", scratch.path("t.png")});
  CHECK(tinted["swatches"][0]["out_of_gamut"] == true);  // incandescent light on a D65 screen is orange
}
