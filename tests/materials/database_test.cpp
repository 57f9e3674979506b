// The bundled database against catalogue values and published reflectances; the database's own rules.
#include "materials/database.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <thread>

#include "base/error.h"
#include "base/files.h"
#include "catch.h"

using namespace gonio;
namespace fs = std::filesystem;

namespace {

/// A folder of its own that disappears with the test.
struct Scratch {
  fs::path path = fs::temp_directory_path() / fmt::format("gonio-materials-test-{}", ::getpid());
  Scratch() { fs::remove_all(path), fs::create_directories(path / "reflectance"); }
  ~Scratch() { fs::remove_all(path); }
  void entry(const std::string& file, const std::string& id) const {
    write_file(
        path / file,
        fmt::format(
            "id: {}\nname: grey\nkind: reflectance\nunit: 1\nrange_nm: 400 700\nsource_range_nm: 400 700\n"
            "citation: nobody\nlicence: CC0\nconfidence: low\n---\nwavelength_nm,reflectance\n400,0.25\n700,1.01\n",
            id));
  }
};

}  // namespace

TEST_CASE("Every bundled entry is read, range-checked, cited and licensed", "[materials]") {
  const std::vector<const Entry*> all = Database::bundled().all();
  CHECK(all.size() >= 960);
  for (const Entry* entry : all) {
    INFO(entry->id);
    CHECK_FALSE(entry->citation.empty());
    CHECK_FALSE(entry->licence.empty());
    if (entry->kind == "rgb-observer" || entry->kind == "daylight-basis") continue;  // these change sign
    CHECK(entry->at(entry->range_lo_nm) >= 0);
    CHECK(entry->at(0.5 * (entry->range_lo_nm + entry->range_hi_nm)) >= 0);
  }
  for (const char* name : {"Al", "Ag", "Au", "Cu", "Fe", "Cr", "Ni", "Ti", "W", "Pt", "Si", "N-BK7", "BK7",
                           "fused-silica", "SiO2", "water", "PMMA", "TiO2"})
    CHECK(SurfaceMaterial(name).at(550).n > 0);
  for (const char* name : {"1931-2", "1964-10", "2015-2", "2015-10", "V", "V-prime", "V-10", "A", "D65", "E", "FL1",
                           "FL11", "FL3.15", "HP1", "LED-B1", "LED-V2", "ID65", "daylight-basis", "cones-2"})
    CHECK(Database::bundled().contains(name));
  int patches = 0;
  for (const Entry* entry : all) patches += entry->id.starts_with("colorchecker-ohta-");
  CHECK(patches == 24);
  const auto of_kind = [&](const char* kind) {
    return std::count_if(all.begin(), all.end(), [&](const Entry* entry) { return entry->kind == kind; });
  };
  CHECK(of_kind("optical-constants") == 514);
  CHECK(of_kind("illuminant") == 115);
}

TEST_CASE("Daylight of 6504 K from its three components is D65; cone fundamentals peak where they should",
          "[materials]") {
  const Database& database = Database::bundled();
  // CIE 015: chromaticity from the temperature (6500 K with today's c2), M1 and M2 from that, rounded to 3 decimals.
  const double t = 6500 * 1.4388 / 1.4380;
  const double x = -4.6070e9 / (t * t * t) + 2.9678e6 / (t * t) + 0.09911e3 / t + 0.244063;
  const double y = -3 * x * x + 2.870 * x - 0.275, m = 0.0241 + 0.2562 * x - 0.7341 * y;
  const double m1 = std::round(1e3 * (-1.3515 - 1.7703 * x + 5.9114 * y) / m) / 1e3;
  const double m2 = std::round(1e3 * (0.03 - 31.4424 * x + 30.0717 * y) / m) / 1e3;
  const Entry &basis = database.find("daylight-basis"), &d65 = database.find("D65");
  for (double nm = 300; nm <= 780; nm += 5)
    CHECK(basis.at(nm) + m1 * basis.at(nm, 1) + m2 * basis.at(nm, 2) == Approx(d65.at(nm)).margin(0.03).epsilon(0));
  const Entry& cones = database.find("cones-2");
  CHECK(cones.at(570) == Approx(1).margin(2e-3).epsilon(0));  // L at 570, M at 543, S at 442 nm
  CHECK(cones.at(543, 1) == Approx(1).margin(2e-3).epsilon(0));
  CHECK(cones.at(442, 2) == Approx(1).margin(5e-3).epsilon(0));
}

TEST_CASE("Metals reflect at normal incidence what is published", "[materials]") {
  const auto r0 = [](const char* id, double nm) { return SurfaceMaterial(id).at(nm).r0(); };
  // Gold by Johnson & Christy 1972: the figures that circulate for their data.
  CHECK(r0("Au", 450) == Approx(0.408).margin(2e-3));
  CHECK(r0("Au", 500) == Approx(0.475).margin(2e-3));
  CHECK(r0("Au", 550) == Approx(0.792).margin(2e-3));
  CHECK(r0("Au", 650) == Approx(0.957).margin(2e-3));
  CHECK(r0("Ag", 550) == Approx(0.98).margin(5e-3));
  CHECK(r0("Al", 550) == Approx(0.92).margin(6e-3));
  CHECK(r0("Cu", 450) == Approx(0.54).margin(0.02));
  CHECK(r0("Si", 550) == Approx(0.367).margin(2e-3));
  CHECK(r0("water", 589) == Approx(0.02).margin(1e-3));
}

TEST_CASE("Glasses show their catalogue indices", "[materials]") {
  const auto n = [](const char* id, double nm) { return SurfaceMaterial(id).at(nm).n; };
  // SCHOTT data sheet N-BK7: lines d, F, C, e, i.
  CHECK(n("N-BK7", 587.5618) == Approx(1.51680).margin(5e-6).epsilon(0));
  CHECK(n("N-BK7", 486.1327) == Approx(1.52238).margin(5e-6).epsilon(0));
  CHECK(n("N-BK7", 656.2725) == Approx(1.51432).margin(5e-6).epsilon(0));
  CHECK(n("N-BK7", 546.0740) == Approx(1.51872).margin(5e-6).epsilon(0));
  CHECK(n("N-BK7", 365.0146) == Approx(1.53627).margin(5e-6).epsilon(0));
  // Malitson 1965, table: computed indices at 589.29, 404.66 and 1083.03 nm.
  CHECK(n("fused-silica", 589.2938) == Approx(1.458404).margin(1.5e-6).epsilon(0));
  CHECK(n("fused-silica", 404.6561) == Approx(1.469618).margin(1.5e-6).epsilon(0));
  CHECK(n("fused-silica", 1083.03) == Approx(1.449405).margin(5e-6).epsilon(0));
  CHECK(n("sapphire", 587.5618) == Approx(1.7682).margin(1e-4).epsilon(0));
  // SCHOTT's internal transmittance at 546 nm, 0.9984 of 10 mm: k = -ln(0.9984)/(4π·10 mm)·λ = 7e-9.
  CHECK(SurfaceMaterial("N-BK7").at(546).k == Approx(7.0e-9).epsilon(0.1));
  CHECK(SurfaceMaterial("N-BK7").at(2000).k == 0);  // beyond its table of k: transparent
  CHECK_THROWS_WITH(SurfaceMaterial("ZnSe").at(2000), Catch::Contains("k is not known at 2000 nm"));
  CHECK_THROWS_WITH(SurfaceMaterial("N-BK7").at(250), Catch::Contains("300 to 2500 nm"));
}

TEST_CASE("Aliases lead to full ids; unknown names are answered with near ones", "[materials]") {
  const Database& database = Database::bundled();
  CHECK(database.full_id("Au") == "Au_Johnson");
  CHECK(database.full_id("Au_Johnson") == "Au_Johnson");
  CHECK(&database.find("Al") == &database.find("Al_Rakic"));
  CHECK(SurfaceMaterial("BK7").id() == "N-BK7_SCHOTT");
  CHECK_FALSE(database.contains("Unobtainium"));
  CHECK_THROWS_WITH(database.find("Au_Jonson"), Catch::Contains("Au_Johnson"));
  CHECK_THROWS_WITH(database.find("d65"), Catch::Contains("D65"));
  CHECK_THROWS_WITH(database.find("pmma"), Catch::Contains("PMMA"));
  CHECK_THROWS_AS(database.find(""), InputError);
  CHECK_THROWS_AS(database.find("../README"), InputError);
}

TEST_CASE("Search finds every word, whatever its case", "[materials]") {
  const std::vector<const Entry*> gold = Database::bundled().search("GOLD christy");
  REQUIRE(gold.size() == 1);
  CHECK(gold[0]->id == "Au_Johnson");
  CHECK(Database::bundled().search("optical-constants malitson sapphire").size() == 2);  // both rays
  CHECK(Database::bundled().search("no such word").empty());
  CHECK(Database::bundled().search("rakic aluminium drude OR").empty());
  CHECK_FALSE(Database::bundled().search("rakic alumin").empty());  // Rakić; words may be cut short
  CHECK(Database::bundled().search("\" * ( NEAR").empty());         // signs of the query language mean nothing
  CHECK(Database::bundled().search(" ").empty());
}

TEST_CASE("Surface materials: perfect, from reflectance, and kinds that are none", "[materials]") {
  const SurfaceMaterial perfect("perfect");
  CHECK(perfect.is_perfect());
  CHECK(perfect.at(1e6).r0() == 1);
  CHECK(perfect.range_lo_nm() == 0);
  CHECK(std::isinf(perfect.range_hi_nm()));
  const SurfaceMaterial red("colorchecker-ohta-red");
  CHECK(red.from_reflectance());
  for (const double nm : {400.0, 550.0, 777.0}) {
    CHECK(red.at(nm).r0() == Approx(red.entry()->at(nm)).epsilon(1e-13));
    CHECK(red.at(nm).k == 0);
  }
  CHECK_THROWS_WITH(SurfaceMaterial("D65"), Catch::Contains("kind illuminant"));
  CHECK_THROWS_WITH(SurfaceMaterial("Au").at(200), Catch::Contains("292.4 to 1216 nm"));
}

TEST_CASE("A database of one's own: ids are file names, noise above 1 is a perfect reflector", "[materials]") {
  const Scratch scratch;
  scratch.entry("reflectance/grey_me.txt", "grey_me");
  write_file(scratch.path / "aliases.txt", "# one\ngrey: grey_me\n");
  {
    const Database database(scratch.path.string());
    const SurfaceMaterial grey("grey", database);
    CHECK(grey.at(400).n == Approx(3));  // (1 + ½)/(1 - ½)
    CHECK(grey.at(700).r0() == 1);
  }
  scratch.entry("reflectance/wrong.txt", "right");
  const Database database(scratch.path.string());
  CHECK(database.find("grey").id == "grey_me");  // other files are not read
  CHECK_THROWS_WITH(database.find("wrong"), Catch::Contains("expected the file's name"));
  write_file(scratch.path / "aliases.txt", "grey: gray_me\n");
  CHECK_THROWS_WITH(Database(scratch.path.string()), Catch::Contains("aliases.txt:1: grey points to gray_me"));
  CHECK_THROWS_AS(Database((scratch.path / "nowhere").string()), InputError);
  write_file(scratch.path / "text.sqlite", "no database at all, but long enough to look like a file of some kind");
  CHECK_THROWS_WITH(Database((scratch.path / "text.sqlite").string()), Catch::Contains("text.sqlite: "));
}

TEST_CASE("A data file that is not there is named", "[materials]") {
  CHECK_THROWS_WITH(data_file("no-materials.sqlite"), Catch::Contains("no-materials.sqlite: was not found; expected"));
}

TEST_CASE("The compiled file holds what the text says, to the bit", "[materials]") {
  const Database text(std::string(GONIO_SOURCE_DIR) + "/materials_db");
  const Database& compiled = Database::bundled();
  CHECK(text.findings().empty());
  std::vector<std::string> bundled_ids;
  for (const std::string& id : compiled.ids())
    if (!compiled.find(id).user) bundled_ids.push_back(id);
  REQUIRE(text.ids() == bundled_ids);
  const auto same = [](const std::vector<double>& a, const std::vector<double>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
  };
  for (const std::string& id : text.ids()) {
    INFO(id);
    const Entry &a = text.find(id), &b = compiled.find(id);
    CHECK((a.name == b.name && a.kind == b.kind && a.unit == b.unit && a.citation == b.citation && a.note == b.note));
    CHECK((a.range_lo_nm == b.range_lo_nm && a.range_hi_nm == b.range_hi_nm && a.formula == b.formula));
    CHECK(a.column_names == b.column_names);
    CHECK(same(a.coefficients, b.coefficients));
    CHECK(same(a.wavelength_nm, b.wavelength_nm));
    REQUIRE(a.columns.size() == b.columns.size());
    for (std::size_t c = 0; c < a.columns.size(); ++c) CHECK(same(a.columns[c], b.columns[c]));
    CHECK(text.aliases_of(id) == compiled.aliases_of(id));
  }
}

TEST_CASE("Entries are read once, from any number of threads", "[materials]") {
  const Database database(std::string(GONIO_SOURCE_DIR) + "/materials_db");
  std::vector<const Entry*> seen(8, nullptr);
  {
    std::vector<std::jthread> threads;
    for (const Entry*& entry : seen) threads.emplace_back([&database, &entry] { entry = &database.find("Au"); });
  }
  for (const Entry* entry : seen) CHECK(entry == seen[0]);
}
