// The entry reader: what it takes, and one malformed text for each thing it refuses.
#include "materials/entry_reader.h"

#include <cmath>

#include "base/error.h"
#include "catch.h"

using namespace gonio;

namespace {

const std::string kHeader =
    "id: X\nname: x\nkind: optical-constants\nunit: 1\nrange_nm: 400 700\nsource_range_nm: 400 700\n"
    "citation: somebody (1999)\nlicence: CC0 1.0\nconfidence: high\n";
const std::string kCauchy = kHeader + "formula: cauchy\ncoefficients: 1.5 0.01 -2\n";
const std::string kTable = "---\nwavelength_nm,n,k\n400,1.5,0\n500,1.4,0.1\n700,1.3,0.2\n";

std::string with(const std::string& text, const std::string& from, const std::string& to) {
  std::string result = text;
  const auto at = result.find(from);
  REQUIRE(at != std::string::npos);
  return result.replace(at, from.size(), to);
}

std::string refusal(const std::string& text) {
  try {
    read_entry(text, "x.txt");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("An entry is read and evaluated between its points", "[materials]") {
  const Entry entry = read_entry(kHeader + kTable, "x.txt");
  CHECK(entry.at(450) == Approx(1.45).epsilon(1e-15));
  CHECK(entry.at(600, 1) == Approx(0.15).epsilon(1e-14));
  CHECK(entry.at(700) == 1.3);
  CHECK(entry.has_k());
  CHECK_THROWS_WITH(entry.at(399.9), Catch::Contains("400 to 700 nm"));
  CHECK_THROWS_WITH(entry.at(700.1), Catch::Contains("400 to 700 nm"));
  CHECK_THROWS_AS(entry.at(std::nan("")), InputError);
  CHECK(read_entry(with(kHeader, "name: x\n", "name: x\r\n") + kTable, "x.txt").name == "x");
}

TEST_CASE("k unknown in part of a table is an error there, and only there", "[materials]") {
  const Entry entry = read_entry(kHeader + with(kTable, "400,1.5,0", "400,1.5,"), "x.txt");
  CHECK(entry.at(450) == Approx(1.45));
  CHECK(entry.at(500, 1) == 0.1);
  CHECK_THROWS_WITH(entry.at(450, 1), Catch::Contains("k is not known at 450 nm"));
}

TEST_CASE("A column k may be absent: transparent", "[materials]") {
  const Entry entry = read_entry(kHeader + "---\nwavelength_nm,n\n400,1.5\n700,1.4\n", "x.txt");
  CHECK_FALSE(entry.has_k());
  CHECK(entry.at(550) == Approx(1.45));
}

TEST_CASE("A formula gives n over its range, a table after it k where the source knows it", "[materials]") {
  const Entry entry = read_entry(kCauchy + "---\nwavelength_nm,k\n450,2e-8\n500,4e-8\n", "x.txt");
  CHECK(entry.has_k());
  CHECK(entry.at(400) == Approx(1.5 + 0.01 / 0.16).epsilon(1e-15));
  CHECK(entry.at(475, 1) == Approx(3e-8).epsilon(1e-14));
  CHECK_THROWS_WITH(entry.at(400, 1), Catch::Contains("k is not known at 400 nm"));
  CHECK_THROWS_WITH(entry.at(399), Catch::Contains("400 to 700 nm"));
  CHECK_FALSE(read_entry(kCauchy, "x.txt").has_k());
}

TEST_CASE("Only the components that change sign may be negative", "[materials]") {
  const auto entry = [](const std::string& kind, const std::string& columns, const std::string& row) {
    return with(kHeader, "optical-constants", kind) + "---\nwavelength_nm," + columns + "\n400,1,1,1\n700," + row +
           "\n";
  };
  CHECK(refusal(entry("daylight-basis", "S0,S1,S2", "63.3,-12,-3")) == "accepted");
  CHECK(refusal(entry("rgb-observer", "rbar,gbar,bbar", "0.1,-0.2,0.3")) == "accepted");
  CHECK(refusal(entry("cone-fundamentals", "l,m,s", "0.1,0.2,0")) == "accepted");
  CHECK_THAT(refusal(entry("cone-fundamentals", "l,m,s", "0.1,-0.2,0")), Catch::Contains("x.txt:13: m is -0.2"));
  CHECK_THAT(refusal(entry("observer", "xbar,ybar,zbar", "0.1,-0.2,0")), Catch::Contains("x.txt:13: ybar is -0.2"));
}

TEST_CASE("Malformed entries are refused, naming file, line and expectation", "[materials]") {
  struct Bad {
    std::string text, says;
  };
  const Bad cases[] = {
      {"", "x.txt: is empty"},
      {std::string("\x7f"
                   "ELF\0\1",
                   6),
       "x.txt:1: not text"},
      {kHeader + with(kTable, "0.1", std::string("0.1\0", 4)), "x.txt:13: not text"},
      {with(kHeader, "name: x", "name: \xff\xfe") + kTable, "x.txt:2: not text"},
      {with(kHeader, "citation: somebody (1999)\n", "") + kTable, "x.txt: citation is missing"},
      {with(kHeader, "licence: CC0 1.0\n", "") + kTable, "x.txt: licence is missing"},
      {with(kHeader, "somebody (1999)", "") + kTable, "x.txt:7: citation is empty"},
      {with(kHeader, "unit: 1\n", "") + kTable, "x.txt: unit is missing"},
      {with(kHeader, "unit", "units") + kTable, "x.txt:4: unknown key 'units'"},
      {with(kHeader, "unit: 1\n", "unit: 1\nunit: 2\n") + kTable, "x.txt:5: unit given again"},
      {with(kHeader, "unit: 1", "unit 1") + kTable, "x.txt:4: no colon"},
      {with(kHeader, "optical-constants", "reflectancy") + kTable, "x.txt: kind is 'reflectancy'"},
      {with(kHeader, "confidence: high", "confidence: sure") + kTable, "x.txt: confidence is 'sure'"},
      {with(kHeader, "range_nm: 400 700", "range_nm: 400") + kTable, "x.txt:5: range_nm is '400'"},
      {with(kHeader, "range_nm: 400 700", "range_nm: 700 400") + kTable, "x.txt:5: range_nm"},
      {with(kHeader, "range_nm: 400 700", "range_nm: 400 nan") + kTable, "x.txt:5: range_nm has 'nan'"},
      {with(kHeader, "range_nm: 400 700", "range_nm: 390 700") + kTable, "x.txt: range_nm 390 700 exceeds"},
      {with(kHeader, "range_nm: 400 700", "range_nm: 400 650") + kTable, "x.txt: range_nm is 400 650"},
      {kHeader, "x.txt:9: no line ---"},
      {kHeader + "---\n", "x.txt:10: the table is missing"},
      {kHeader + with(kTable, "wavelength_nm,n,k", "wavelength_um,n,k"), "x.txt:11: the columns are"},
      {kHeader + with(kTable, "wavelength_nm,n,k", "wavelength_nm,k,n"), "x.txt:11: the columns are"},
      {kHeader + "---\nwavelength_nm,n,k\n400,1.5,0\n", "x.txt: 1 rows"},
      {kHeader + with(kTable, "500,1.4,0.1", "500,1.4"), "x.txt:13: 2 cells; expected 3"},
      {kHeader + with(kTable, "500,1.4,0.1", "500,1.4,0.1,7"), "x.txt:13: 4 cells"},
      {kHeader + with(kTable, "500,1.4,0.1", ""), "x.txt:13: an empty line"},
      {kHeader + with(kTable, "500,1.4", "400,1.4"), "x.txt:13: wavelength_nm is 400"},
      {kHeader + with(kTable, "500,1.4", "five,1.4"), "x.txt:13: wavelength_nm is 'five'"},
      {kHeader + with(kTable, "400,1.5", "-400,1.5"), "x.txt:12: wavelength_nm is -400"},
      {kHeader + with(kTable, "1.4", "nan"), "x.txt:13: n is 'nan'"},
      {kHeader + with(kTable, "1.4", "inf"), "x.txt:13: n is 'inf'"},
      {kHeader + with(kTable, "1.4", "1e999"), "x.txt:13: n is '1e999'"},
      {kHeader + with(kTable, "1.4", "1.4x"), "x.txt:13: n is '1.4x'"},
      {kHeader + with(kTable, "1.4", ""), "x.txt:13: n is ''"},
      {kHeader + with(kTable, "1.4", "0"), "x.txt:13: n is 0"},
      {kHeader + with(kTable, "0.1", "-0.1"), "x.txt:13: k is -0.1"},
      {kHeader + "formula: cauchy\n", "x.txt: formula and coefficients go together"},
      {kCauchy + kTable, "x.txt:13: the columns are 'wavelength_nm,n,k'; expected wavelength_nm,k"},
      {kCauchy + "---\nwavelength_nm,k\n350,0\n500,0\n", "x.txt: the table of k covers 350 to 500 nm"},
      {kCauchy + "---\nwavelength_nm,k\n450,0\n500,-1e-9\n", "x.txt:15: k is -1e-09"},
      {kHeader + "formula: herzberg\ncoefficients: 1 2 3\n", "x.txt: formula is 'herzberg'"},
      {kHeader + "formula: retro\ncoefficients: 1 2 3\n", "x.txt: 3 coefficients; formula retro expects 4"},
      {kHeader + "formula: exotic\ncoefficients: 1 2 3 4 5\n", "x.txt: 5 coefficients; formula exotic expects 6"},
      {kHeader + "formula: herzberger\ncoefficients: 1 2\n",
       "x.txt: 2 coefficients; formula herzberger expects 3 to 6"},
      {kHeader + "formula: cauchy\ncoefficients: 1.5 0.01\n", "x.txt: 2 coefficients"},
      {kHeader + "formula: sellmeier\ncoefficients: -3 0 0\n", "x.txt: the formula gives n = "},
      {kHeader + "formula: cauchy\ncoefficients: 1.5 x 2\n", "x.txt:11: coefficients has 'x'"},
  };
  for (const Bad& bad : cases) {
    INFO(bad.says);
    const std::string got = refusal(bad.text);
    CHECK_THAT(got, Catch::Contains(bad.says));
    CHECK(got.find('\n') == std::string::npos);
  }
}

TEST_CASE("Reflectances lie within 0 to 1, with a little noise", "[materials]") {
  const auto reflectance = [](const std::string& value) {
    return with(kHeader, "optical-constants", "reflectance") + "---\nwavelength_nm,reflectance\n400,0.5\n700," + value +
           "\n";
  };
  CHECK(refusal(reflectance("1.02")) == "accepted");
  CHECK(refusal(reflectance("0")) == "accepted");
  CHECK_THAT(refusal(reflectance("1.03")), Catch::Contains("x.txt:13: reflectance is 1.03"));
  CHECK_THAT(refusal(reflectance("-0.01")), Catch::Contains("x.txt:13: reflectance is -0.01"));
}
