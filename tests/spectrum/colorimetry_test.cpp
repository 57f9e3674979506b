// Sums over observers against CIE's published chromaticities and closed forms.
#include "spectrum/colorimetry.h"

#include <numeric>

#include "base/error.h"
#include "catch.h"
#include "materials/color_entries.h"

using namespace gonio;

namespace {

const Database& database() { return Database::bundled(); }
const Factor kWhite{0, 1e9, [](double) { return 1.0; }};

Chromaticity<double> white_of(std::string_view light, std::string_view observer) {
  return chromaticity(color_of(kWhite, light_of(database().find(light)), observer_of(database().find(observer))).white);
}

}  // namespace

TEST_CASE("White points of CIE 015:2018", "[spectrum]") {
  // C and E are published to sums other than at 1 nm and linear between 5 nm points, which moves C by up to 7e-5;
  // E's 1/3 is nominal (the columns of the observer differ in their sums).
  struct Row {
    const char *light, *observer;
    double x, y, margin;
  };
  const Row rows[] = {{"D65", "1931-2", 0.31272, 0.32903, 2e-5}, {"A", "1931-2", 0.44758, 0.40745, 2e-5},
                      {"D50", "1931-2", 0.34567, 0.35851, 2e-5}, {"C", "1931-2", 0.31006, 0.31616, 8e-5},
                      {"E", "1931-2", 0.33333, 0.33333, 5e-5},   {"D65", "1964-10", 0.31382, 0.33100, 2e-5},
                      {"A", "1964-10", 0.45117, 0.40594, 2e-5},  {"D50", "1964-10", 0.34773, 0.35952, 2e-5},
                      {"C", "1964-10", 0.31039, 0.31905, 8e-5}};
  for (const Row& row : rows) {
    INFO(row.light << " " << row.observer);
    const Chromaticity<double> xy = white_of(row.light, row.observer);
    CHECK(xy.x == Approx(row.x).margin(row.margin).epsilon(0));
    CHECK(xy.y == Approx(row.y).margin(row.margin).epsilon(0));
  }
}

TEST_CASE("Luminous efficiencies: integrals and peaks", "[spectrum]") {
  const Entry &v = database().find("V"), &scotopic = database().find("V-prime");
  const auto sum = [](const Entry& e) { return std::accumulate(e.columns[0].begin(), e.columns[0].end(), 0.0); };
  CHECK(sum(v) == Approx(106.857).margin(1e-3));
  CHECK(sum(scotopic) == Approx(97.07).margin(0.1));
  CHECK(v.at(555) == Approx(1).margin(1e-4));
  CHECK(scotopic.at(507) == Approx(1).margin(1e-4));
  const Entry& eye = database().find("1931-2");  // ȳ is V
  for (double nm : {400.0, 480.0, 555.0, 610.0, 700.0}) CHECK(eye.at(nm, 1) == Approx(v.at(nm)).epsilon(1e-3));
}

TEST_CASE("A grey has the white's chromaticity and Y = 100 R", "[spectrum]") {
  const Factor grey{300, 900, [](double) { return 0.4; }};
  const ColorSum sum = color_of(grey, light_of(database().find("D65")), observer_of(database().find("1931-2")));
  CHECK(sum.white.y == Approx(100).epsilon(1e-14));
  CHECK(sum.xyz.y == Approx(40).epsilon(1e-13));
  CHECK(color_values(sum).lab.a == Approx(0).margin(1e-11));
  CHECK(color_values(sum).luv.v == Approx(0).margin(1e-11));
  CHECK(sum.lo_nm == 360);
  CHECK(sum.hi_nm == 780);
  CHECK(sum.share_left_out < 1e-4);
}

TEST_CASE("What is left out is counted, and refused above one per cent", "[spectrum]") {
  const Spectrum light = light_of(database().find("E"));
  const Observer eye = observer_of(database().find("1931-2"));
  const auto grey = [](double lo, double hi) { return Factor{lo, hi, [](double) { return 0.5; }}; };
  const ColorSum cut = color_of(grey(380.5, 650), light, eye, true);
  const Entry& v = database().find("V");
  double outside = 0, all = 0;
  for (int nm = 360; nm <= 830; ++nm) all += v.at(nm), outside += nm < 381 || nm > 650 ? v.at(nm) : 0;
  CHECK(cut.share_left_out == Approx(outside / all).epsilon(1e-3));
  CHECK(cut.lo_nm == 381);
  CHECK(cut.xyz.y == Approx(50));  // white from the same sum
  CHECK_THROWS_WITH(color_of(grey(380.5, 650), light, eye),
                    Catch::Contains("data: the common range 381 to 650 nm leaves out 1.59 %"));
  CHECK_NOTHROW(color_of(grey(400, 700), light, eye));
  CHECK_THROWS_AS(color_of(grey(900, 950), light, eye, true), InputError);
  // The light's own end counts too: a light known up to 600 nm only is partial.
  const Spectrum short_light{{360, 600}, {1, 1}};
  CHECK_THROWS_AS(color_of(grey(360, 830), short_light, eye), InputError);
}

TEST_CASE("ColorChecker (Ohta 1997) under C: the chart's published xyY", "[spectrum]") {
  struct Row {
    const char* id;
    double x, y, luminance;
  };
  // McCamy, Marcus & Davidson 1976, illuminant C; Ohta's chart is another specimen, hence the margins.
  const Row rows[] = {
      {"dark-skin", 0.400, 0.350, 10.1}, {"light-skin", 0.377, 0.345, 35.8}, {"blue-sky", 0.247, 0.251, 19.3},
      {"foliage", 0.337, 0.422, 13.3},   {"orange", 0.506, 0.407, 30.1},     {"blue", 0.187, 0.129, 6.1},
      {"green", 0.305, 0.478, 23.4},     {"red", 0.539, 0.313, 12.0},        {"yellow", 0.448, 0.470, 59.1},
      {"magenta", 0.364, 0.233, 19.8},   {"white-9.5", 0.310, 0.316, 90.0},  {"neutral-5", 0.310, 0.316, 19.8}};
  const Spectrum light = light_of(database().find("C"));
  const Observer eye = observer_of(database().find("1931-2"));
  for (const Row& row : rows) {
    INFO(row.id);
    const ColorValues values =
        color_values(color_of(factor_of(fmt::format("colorchecker-ohta-{}", row.id)), light, eye));
    CHECK(values.xy.x == Approx(row.x).margin(0.015).epsilon(0));
    CHECK(values.xy.y == Approx(row.y).margin(0.015).epsilon(0));
    CHECK(values.xyz.y == Approx(row.luminance).epsilon(0.08).margin(0.3));
  }
}

TEST_CASE("Optical constants show their reflectance at normal incidence", "[spectrum]") {
  const ColorValues gold =
      color_values(color_of(factor_of("Au"), light_of(database().find("D65")), observer_of(database().find("1931-2"))));
  const ColorValues silver =
      color_values(color_of(factor_of("Ag"), light_of(database().find("D65")), observer_of(database().find("1931-2"))));
  CHECK(gold.lab.b > 30);  // yellow
  CHECK(std::abs(silver.lab.b) < 5);
  CHECK(silver.xyz.y > 95);
  const ColorValues glass =
      color_values(color_of(factor_of("BK7"), light_of(database().find("E")), observer_of(database().find("1931-2"))));
  CHECK(glass.xyz.y == Approx(100 * square(0.5168 / 2.5168)).epsilon(5e-3));
}

TEST_CASE("A renderer's weights equal the sum at whole nanometres", "[spectrum]") {
  const Observer eye = observer_of(database().find("1931-2"));
  std::vector<double> nm;
  for (int w = 0; w < 32; ++w) nm.push_back(390 + 10 * w);
  for (const std::vector<double>& at :
       {nm, std::vector<double>{380.5, 455.25, 520, 611.75, 700.5}, std::vector<double>{300, 900}}) {
    const ColorWeights weights = color_weights(at, eye);
    const std::vector<double> ones(at.size(), 1.0);
    CHECK(weights.xyz(ones.data()).y == Approx(1).epsilon(1e-13));
    Spectrum radiance{at, {}};
    for (const double w : at) radiance.value.push_back(1 + 0.3 * std::sin(w / 40));
    Xyz<double> sum{0, 0, 0};
    double luminance = 0;
    for (int w = 360; w <= 830; ++w) {
      if (w < at.front() || w > at.back()) continue;
      const Xyz<double> c = eye.at(w);
      const double l = radiance.at(w);
      sum = {sum.x + c.x * l, sum.y + c.y * l, sum.z + c.z * l}, luminance += c.y;
    }
    const Xyz<double> quick = weights.xyz(radiance.value.data());
    CHECK(quick.x == Approx(sum.x / luminance).epsilon(1e-12));
    CHECK(quick.y == Approx(sum.y / luminance).epsilon(1e-12));
    CHECK(quick.z == Approx(sum.z / luminance).epsilon(1e-12));
  }
  CHECK_THROWS_AS(color_weights({900, 950}, eye), InputError);
}
