// Files of other people as entries: records of refractiveindex.info, tables; what is refused, and where.
#include "materials/import.h"

#include <cmath>

#include "base/error.h"
#include "catch.h"

using namespace gonio;

namespace {

const std::string kReferences =
    "REFERENCES: 'A. Nobody. <i>J. Opt.</i> <a href=\"https://doi.org/10.1000/xyz\">1, 2 (1999)</a>'\n";

std::string record(const std::string& data) { return kReferences + "COMMENTS: room temperature\nDATA:\n" + data; }

Entry import(const std::string& text, const std::string& file = "x.yml", const ImportOptions& options = {}) {
  return read_import(text, file, options);
}

std::string refusal(const std::string& text, const std::string& file = "x.yml", const ImportOptions& options = {}) {
  try {
    read_import(text, file, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

ImportOptions cited() {
  ImportOptions options;
  options.citation = "me";
  return options;
}

}  // namespace

TEST_CASE("A record with n and k: wavelengths in um become nm exactly", "[materials]") {
  const Entry gold =
      import(record("  - type: tabulated nk\n    data: |\n        0.1879 1.28 1.188\n        0.1916 1.32 1.203\n"
                    "        1.937 0.92 13.78\n"),
             "Johnson.yml");
  CHECK(gold.id == "Johnson");
  CHECK(gold.kind == "optical-constants");
  CHECK(gold.citation == "A. Nobody. J. Opt. 1, 2 (1999)");
  CHECK(gold.doi == "10.1000/xyz");
  CHECK(gold.note == "room temperature");
  CHECK(gold.wavelength_nm == std::vector<double>{187.9, 191.6, 1937});
  CHECK(gold.at(191.6, 1) == 1.203);
}

TEST_CASE("References in Markdown, a DOI with brackets, conditions", "[materials]") {
  const Entry entry = import(
      "# a comment\nREFERENCES: |\n    A. Nobody and B. Else.\n    Title [of a kind].\n"
      "    [*J. Opt.* **40**, 17 (2000)](https://doi.org/10.1016/S0042-6989(00)00021-3)\n"
      "COMMENTS: cut along <111>, k < 1e-6\nCONDITIONS:\n  temperature: 293\nDATA:\n  - type: tabulated n\n    data: "
      "|\n        0.4 1.5\n        0.7 1.4\n");
  CHECK(entry.citation == "A. Nobody and B. Else. Title [of a kind]. J. Opt. 40, 17 (2000)");
  CHECK(entry.doi == "10.1016/S0042-6989(00)00021-3");
  CHECK(entry.note == "cut along <111>, k < 1e-6");
  CHECK(entry.temperature == "293 K");
  CHECK_FALSE(entry.has_k());
}

TEST_CASE("A record of a formula keeps the formula; k may follow in a table", "[materials]") {
  const std::string bk7 =
      "  - type: formula 2\n    wavelength_range: 0.3 2.5\n    coefficients: 0 1.03961212 0.00600069867 "
      "0.231792344 0.0200179144 1.01046945 103.560653\n";
  const Entry glass =
      import(record(bk7 + "  - type: tabulated k\n    data: |\n      0.25 1E-3\n      0.4 2.3e-9\n      0.7 4.9e-9\n"));
  CHECK(glass.formula == "sellmeier-2");
  CHECK(glass.at(587.5618) == Approx(1.51680).margin(5e-6).epsilon(0));  // SCHOTT's n_d
  CHECK(glass.range_lo_nm == 300);
  CHECK(glass.at(400, 1) == 2.3e-9);
  CHECK_FALSE(import(record(bk7)).has_k());
  for (int i = 1; i <= 9; ++i) {
    const char* coefficients = i == 4   ? "2 0.1 0 0.1 1"
                               : i == 7 ? "1.5 0.01 0.001 0 0 0"
                               : i == 8 ? "0.3 0.01 0.01 0"
                               : i == 9 ? "2.2 0.01 0.01 0.01 1.5 0.1"
                               : i == 6 ? "0 0.05 238"
                                        : "1.1 0.1 0.01";
    INFO("formula " << i);
    CHECK(refusal(record(fmt::format("  - type: formula {}\n    range: 0.4 0.7\n    coefficients: {}\n", i,
                                     coefficients))) == "accepted");
  }
}

TEST_CASE("Tables of n and of k at different wavelengths stay the same functions", "[materials]") {
  const Entry both =
      import(record("  - type: tabulated n\n    data: |\n      0.4 1.5\n      0.6 1.4\n      0.8 1.35\n"
                    "  - type: tabulated k\n    data: |\n      0.45 0.1\n      0.65 0.3\n"));
  CHECK(both.at(500) == Approx(1.45).epsilon(1e-14));
  CHECK(both.at(700) == Approx(1.375).epsilon(1e-14));
  CHECK(both.at(550, 1) == Approx(0.2).epsilon(1e-14));
  CHECK(both.at(650, 1) == Approx(0.3).epsilon(1e-14));
  CHECK_THROWS_WITH(both.at(700, 1), Catch::Contains("k is not known"));
}

TEST_CASE("Tables: separators, units, per cent, notes in their first lines", "[materials]") {
  ImportOptions options = cited();
  const Entry csv = import("wavelength_um,n,k\n0.4,1.5,\n0.55,1.4,0.1\n0.7,1.3,0.2\n", "film.csv", options);
  CHECK(csv.id == "film");
  CHECK(csv.licence == "not stated");
  CHECK(csv.wavelength_nm == std::vector<double>{400, 550, 700});
  CHECK(std::isnan(csv.columns[1][0]));
  options.percent = true;
  const Entry paint =
      import("# citation: a lab\n# name: red paint\nLambda [nm];R\n400;5.5\n700;80\n", "red.txt", options);
  CHECK(paint.kind == "reflectance");
  CHECK(paint.name == "red paint");
  CHECK(paint.at(400) == 0.055);
  CHECK(paint.at(700) == 0.8);
  options.wavelength_unit = "nm";
  CHECK(import("wavelength\tspd\r\n400\t1\r\n500\t2\r\n", "lamp.tsv", options).kind == "illuminant");
  CHECK(import("wl_nm xbar ybar zbar\n400 0 1 2\n  500   1 0 3\n", "film.dat", cited()).columns[2][1] == 3);
  CHECK(import("\xEF\xBB\xBFwavelength (A),T\n4000,0.5\n7000,1\n", "x.csv", cited()).range_hi_nm == 700);
}

TEST_CASE("Bad files are refused by name and line", "[materials]") {
  struct Bad {
    std::string text, file;
    ImportOptions options;
    std::string says;
  };
  const std::string csv = "wavelength_nm,n,k\n400,1.5,0\n500,1.4,0.1\n600,1.3,0.2\n";
  const auto with = [](std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  };
  ImportOptions wrong_unit = cited(), blank_id = cited(), light = cited();
  wrong_unit.wavelength_unit = "inch", blank_id.id = "my film", light.kind = "illuminant";
  const std::string yaml = "  - type: tabulated nk\n    data: |\n      0.4 1.5 0\n      0.5 1.4 0.1\n";
  const Bad cases[] = {
      {csv, "a.csv", {}, "a.csv: citation is missing"},
      {with(csv, "500,", "400,"), "a.csv", cited(), "a.csv:3: wavelength 400 nm is given twice"},
      {with(csv, "500,", "350,"), "a.csv", cited(), "a.csv:3: wavelength 350 nm after 400 nm"},
      {with(csv, "0.1", "-0.1"), "a.csv", cited(), "a.csv:3: k is -0.1"},
      {with(csv, "0.1", "nan"), "a.csv", cited(), "a.csv:3: k is 'nan'"},
      {with(csv, "1.4", "1.4.1"), "a.csv", cited(), "a.csv:3: n is '1.4.1'"},
      {with(csv, "1.4", "1e400"), "a.csv", cited(), "a.csv:3: n is '1e400'"},
      {with(csv, "1.4,", "1.4,7,"), "a.csv", cited(), "a.csv:3: 4 cells; expected 3"},
      {with(csv, "_nm", ""), "a.csv", cited(), "a.csv:1: the wavelength has no unit"},
      {with(csv, "_nm", ""), "a.csv", wrong_unit, "a.csv:1: 'inch' is no unit"},
      {with(csv, "_nm", "_cm"), "a.csv", cited(), "a.csv:1: 'cm' is no unit"},
      {with(csv, "_nm", "_um"), "a.csv", cited(), "look like nm"},
      {"wavelength_nm,n\n0.4,1.5\n0.7,1.4\n", "a.csv", cited(), "look like um"},
      {with(csv, "n,k", "n,extinction"), "a.csv", cited(), "a.csv:1: the columns are"},
      {csv, "a.csv", blank_id, "id 'my film' has a blank"},
      {csv, "a.csv", light, "a.csv:1: the columns of kind optical-constants; expected those of illuminant"},
      {"400,1.5\n500,1.4\n600,1.3\n", "a.csv", cited(), "a.csv:1: the first column is '400'"},
      {"wavelength_nm,R\n400,50\n700,60\n", "a.csv", cited(), "a.csv:2: reflectance is 50"},
      {std::string("PK\3\4\0\0", 6), "a.csv", cited(), "a.csv:1: not text"},
      {"", "a.csv", cited(), "a.csv: is empty"},
      {std::string("\x7f"
                   "ELF\0",
                   5),
       "a.yml", cited(), "a.yml:1: not text"},
      {with(record(yaml), kReferences, ""), "a.yml", {}, "a.yml: citation is missing"},
      {with(record(yaml), "0.5 1.4", "0.4 1.4"), "a.yml", {}, "a.yml:7: wavelength 400 nm is given twice"},
      {with(record(yaml), "0.5 1.4", "0.3 1.4"), "a.yml", {}, "a.yml:7: wavelength 300 nm after 400 nm"},
      {with(record(yaml), "1.4 0.1", "1.4 -0.1"), "a.yml", {}, "a.yml:7: k is -0.1"},
      {with(record(yaml), "1.4 0.1", "1.4"), "a.yml", {}, "a.yml:7: 2 numbers; expected 3"},
      {with(with(record(yaml), "0.4 ", "400 "), "0.5 ", "500 "), "a.yml", {}, "look like nm"},
      {with(record(yaml), "tabulated nk", "tabulated eps"), "a.yml", {}, "a.yml:4: type 'tabulated eps'"},
      {with(record(yaml), "COMMENTS", "REFERENCES"), "a.yml", {}, "a.yml:2: a key is given again"},
      {record(yaml + yaml), "a.yml", {}, "a.yml:8: type 'tabulated nk'"},
      {record("  - type: tabulated k\n    data: |\n      0.4 0\n      0.5 0.1\n"),
       "a.yml",
       {},
       "a.yml: DATA gives n 0 times"},
      {record("  - type: formula 12\n    range: 0.4 0.7\n    coefficients: 1\n"), "a.yml", {}, "a.yml:4: formula '12'"},
      {record("  - type: formula 5\n    range: 0.7 0.4\n    coefficients: 1\n"),
       "a.yml",
       {},
       "a.yml:4: wavelength_range is"},
      {record("  - type: formula 5\n    range: 0.4 0.7\n    coefficients: 1 2\n"),
       "a.yml",
       {},
       "2 coefficients; formula cauchy"},
      {record("  - type: formula 1\n    range: 0.4 0.7\n    coefficients: -3 0 0\n"),
       "a.yml",
       {},
       "the formula gives n = "},
      {"DATA: [", "a.yml", cited(), "a.yml:1: no YAML"},
      {"- 1\n- 2\n", "a.yml", cited(), "a.yml:1: the file is no mapping"},
  };
  for (const Bad& bad : cases) {
    const std::string got = refusal(bad.text, bad.file, bad.options);
    INFO(got);
    CHECK_THAT(got, Catch::Contains(bad.says));
    CHECK(got.find('\n') == std::string::npos);
  }
}
