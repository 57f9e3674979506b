// Chosen wavelengths, judged by sums written here: every product, every whole nanometre, one after the other.
#include "spectrum/wavelengths.h"

#include <tbb/global_control.h>

#include <cmath>
#include <random>

#include "base/error.h"
#include "catch.h"
#include "materials/color_entries.h"
#include "spectrum/wavelength_rules.h"

using namespace gonio;

namespace {

const Database& database() { return Database::bundled(); }
Observer observer() { return observer_of(database().find("1931-2")); }

/// The 24 patches and five metals at normal incidence.
std::vector<Factor> patches_and_metals() {
  std::vector<Factor> list;
  for (const std::string& id : database().ids())
    if (id.starts_with("colorchecker-ohta-")) list.push_back(factor_of(id));
  for (const char* metal : {"Au", "Ag", "Cu", "Al", "Fe"}) list.push_back(factor_of(metal));
  REQUIRE(list.size() == 29);
  return list;
}

SpectralScene scene_under(const char* light) {
  return {patches_and_metals(), {light_of(database().find(light))}, observer()};
}

/// The worst ΔE_2000 of the products of exactly `depth` reflectances under the scene's only light.
double worst_at_depth(const SpectralScene& scene, const NodeWeights& choice, int depth, double lo, double hi) {
  const Observer& eye = scene.observer;
  double worst = 0;
  std::vector<std::size_t> pick(static_cast<std::size_t>(depth), 0);
  for (;;) {
    const auto product = [&](double nm) {
      double value = 1;
      for (const std::size_t p : pick) {
        const Factor& f = scene.reflectances[p];  // linear between whole nanometres, as stated
        const double below = std::floor(nm), t = nm - below;
        value *= t == 0 ? f.at(nm) : (1 - t) * f.at(below) + t * f.at(below + 1);
      }
      return value;
    };
    const auto power = [&](double nm) {
      const double below = std::floor(nm), t = nm - below;
      return t == 0 ? scene.lights[0].at(nm) : (1 - t) * scene.lights[0].at(below) + t * scene.lights[0].at(below + 1);
    };
    Xyz<double> sum{0, 0, 0}, white{0, 0, 0}, few{0, 0, 0};
    double luminous = 0;
    for (double nm = lo; nm <= hi; ++nm) {
      const Xyz<double> c = eye.at(nm);
      const double s = power(nm), r = product(nm);
      sum = {sum.x + s * r * c.x, sum.y + s * r * c.y, sum.z + s * r * c.z};
      white = {white.x + s * c.x, white.y + s * c.y, white.z + s * c.z};
      luminous += c.y;
    }
    const ColorWeights weights = color_weights(choice);
    std::vector<double> radiance;
    for (const double nm : weights.wavelength_nm) radiance.push_back(power(nm) * product(nm) * luminous);
    few = weights.xyz(radiance.data());
    worst = std::max(worst, delta_e_2000(lab(sum, white), lab(few, white)));
    std::size_t at = 0;  // the next non-decreasing tuple
    while (at < pick.size() && pick[at] + 1 == scene.reflectances.size()) ++at;
    if (at == pick.size()) return worst;
    const std::size_t next = pick[at] + 1;
    for (std::size_t i = 0; i <= at; ++i) pick[i] = next;
  }
}

double unit(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

/// Scenes of 2 to 6 of the database's reflectances and metals under one of its lights, 1 or 2 bounces deep, 3 to 10
/// nodes: how often the true worst exceeds what was reported (or its multiple, one bounce deeper).
int understated(int scenes, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<std::string> surfaces{"Au", "Ag", "Cu", "Al", "Fe", "Ni", "Pt", "Cr", "W", "Ti"}, lights;
  for (const Entry* entry : database().all()) {
    if (entry->kind == "reflectance" && entry->range_lo_nm <= 400 && entry->range_hi_nm >= 700)
      surfaces.push_back(entry->id);
    if (entry->kind == "illuminant" && entry->range_lo_nm <= 380 && entry->range_hi_nm >= 730)
      lights.push_back(entry->id);
  }
  const auto any_of = [&](const std::vector<std::string>& list) {
    return list[static_cast<std::size_t>(unit(random) * static_cast<double>(list.size()))];
  };
  int count = 0;
  for (int s = 0; s < scenes; ++s) {
    SpectralScene scene{{}, {light_of(database().find(any_of(lights)))}, observer()};
    for (int n = 2 + static_cast<int>(5 * unit(random)); n > 0; --n)
      scene.reflectances.push_back(factor_of(any_of(surfaces)));
    const int bounces = 1 + static_cast<int>(2 * unit(random)), nodes = 3 + static_cast<int>(8 * unit(random));
    const SceneProducts products(scene, bounces);
    const NodeWeights choice = fewest_wavelengths(products, unit(random), nodes);
    const double reported = choice.worst_e2000 * (1 + 1e-9) + 1e-9;
    for (int depth = 1; depth <= bounces + 1; ++depth)
      if (worst_at_depth(scene, choice, depth, products.lo_nm(), products.hi_nm()) >
          reported * (depth > bounces ? kOneBounceMore : 1))
        ++count;
  }
  return count;
}

}  // namespace

TEST_CASE("Few wavelengths: the reported error is the worst of every product, summed at 1 nm", "[spectrum]") {
  for (const char* light : {"D65", "FL11"}) {
    const SpectralScene scene = scene_under(light);
    const SceneProducts products(scene, 2);
    const NodeWeights choice = choose_wavelengths(products, 8);
    CHECK(choice.weight.minCoeff() >= 0);
    CHECK(std::is_sorted(choice.nodes_nm.begin(), choice.nodes_nm.end()));
    const double one = worst_at_depth(scene, choice, 1, 380, 780), two = worst_at_depth(scene, choice, 2, 380, 780);
    INFO(light << ": " << one << " and " << two << " after two bounces");
    CHECK(std::max(one, two) <= choice.worst_e2000 * (1 + 1e-9));
    CHECK(std::max(one, two) >= choice.worst_e2000 / 2);
    CHECK(choice.worst_e2000 < 0.6);  // the quick search; uniform grids need 12 to 16 nodes under D65 for as much
  }
}

TEST_CASE("Few wavelengths: better than every rule that does not know the scene", "[spectrum]") {
  const SpectralScene scene = scene_under("FL11");
  const SceneProducts products(scene, 2);
  for (const int count : {6, 10}) {
    const double chosen = choose_wavelengths(products, count).worst_e2000;
    for (const auto rule : {WavelengthRule::uniform, WavelengthRule::gauss_legendre, WavelengthRule::observer})
      CHECK(rule_weights(products, scene.observer, rule, count).worst_e2000 > 5 * chosen);
  }
  CHECK(rule_weights(products, scene.observer, WavelengthRule::uniform, 48).worst_e2000 > 0.5);
}

TEST_CASE("Few wavelengths: quadrature rules are what they are called", "[spectrum]") {
  const SpectralScene scene = scene_under("E");
  const SceneProducts products(scene, 1);
  const NodeWeights gauss = rule_weights(products, scene.observer, WavelengthRule::gauss_legendre, 3);
  const double middle = (products.lo_nm() + products.hi_nm()) / 2, half = (products.hi_nm() - products.lo_nm()) / 2;
  CHECK(gauss.nodes_nm[0] == Approx(middle - std::sqrt(0.6) * half));
  CHECK(gauss.nodes_nm[1] == Approx(middle));
  CHECK(gauss.weight(0, 1) / scene.observer.at(gauss.nodes_nm[0]).y * scene.observer.at(middle).y /
            gauss.weight(1, 1) ==
        Approx(5.0 / 8));
  CHECK(rule_weights(products, scene.observer, WavelengthRule::uniform, 4).nodes_nm[0] == Approx(middle - 0.75 * half));
  // Converge to the 1 nm sum; in proportion to the observer, every node has the same x̄ + ȳ + z̄ share.
  CHECK(rule_weights(products, scene.observer, WavelengthRule::uniform, 200).worst_e2000 < 0.01);
  CHECK(rule_weights(products, scene.observer, WavelengthRule::gauss_legendre, 200).worst_e2000 < 0.01);
  CHECK(rule_weights(products, scene.observer, WavelengthRule::observer, 2000).worst_e2000 <
        0.02);  // slowly: its tails
  const NodeWeights share = rule_weights(products, scene.observer, WavelengthRule::observer, 7);
  for (int i = 1; i < 7; ++i) CHECK(share.weight.row(i).sum() == Approx(share.weight.row(0).sum()));
}

TEST_CASE("Few wavelengths: the fewest that keep a tolerance", "[spectrum]") {
  const SceneProducts products(scene_under("A"), 2);
  std::size_t before = 0;
  for (const double tolerance : {2.0, 0.5, 0.15}) {
    const NodeWeights choice = fewest_wavelengths(products, tolerance, 24);
    CHECK(choice.worst_e2000 <= tolerance);
    CHECK(choice.nodes_nm.size() > before);
    before = choice.nodes_nm.size();
  }
  CHECK(before <= 13);
  CHECK(fewest_wavelengths(products, 1e-6, 6).nodes_nm.size() == 6);  // not to be had: the most, and its error
  CHECK(fewest_wavelengths(products, 1e-6, 6).worst_e2000 > 1e-6);
}

TEST_CASE("Few wavelengths: one grey needs two; line lamps; bad counts", "[spectrum]") {
  const Factor grey{360, 830, [](double) { return 0.4; }, "grey"};
  const SceneProducts products({{grey}, {light_of(database().find("D65"))}, observer()}, 2);
  CHECK(choose_wavelengths(products, 3).worst_e2000 < 1e-6);
  CHECK_THROWS_AS(choose_wavelengths(products, 1), InputError);
  CHECK_THROWS_AS(choose_wavelengths(products, 65), InputError);
  CHECK_THROWS_AS(SceneProducts({{}, {light_of(database().find("D65"))}, observer()}, 2), InputError);
  const Spectrum sodium{{360, 584, 589, 594, 830}, {0, 0, 1, 0, 0}};
  const SceneProducts lit({patches_and_metals(), {sodium}, observer()}, 1);
  CHECK(choose_wavelengths(lit, 3).worst_e2000 < 0.1);
  const SceneProducts mixed({patches_and_metals(), {sodium, light_of(database().find("D65"))}, observer()}, 1);
  CHECK(choose_wavelengths(mixed, 12).worst_e2000 < 0.6);  // common nodes and weights for both
}

TEST_CASE("Few wavelengths: same bits for any number of threads", "[spectrum]") {
  const Factor red{360, 830, [](double nm) { return 1 / (1 + std::exp((600 - nm) / 15)); }, "red"};
  const Factor blue{360, 830, [](double nm) { return 1 / (1 + std::exp((nm - 480) / 20)); }, "blue"};
  const SceneProducts products({{red, blue}, {light_of(database().find("D65"))}, observer()}, 2);
  WavelengthSearch search;
  search.thorough_starts = 2;
  const NodeWeights some = choose_wavelengths(products, 4, search);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const NodeWeights again = choose_wavelengths(products, 4, search);
  CHECK(some.nodes_nm == again.nodes_nm);
  CHECK(some.weight == again.weight);
  CHECK(some.worst_e2000 <= choose_wavelengths(products, 4).worst_e2000);
}

TEST_CASE("Few wavelengths: the report never understates the worst of random scenes", "[spectrum]") {
  CHECK(understated(60, 1) == 0);
}

TEST_CASE("Few wavelengths: the report never understates the worst of 1,000 random scenes", "[spectrum][slow]") {
  CHECK(understated(1000, 2) == 0);
}
