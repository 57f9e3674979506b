#include "energy/instrument_reflectance.h"

#include <random>

#include "brdf/lobe_sum.h"
#include "brdf/sampling.h"
#include "catch.h"
#include "energy/instrument_geometry.h"
#include "energy/spherical_cap.h"

using namespace gonio;

namespace {

const Interface<double> kPerfect = perfect_interface<double>(), kGlass{1.5, 0}, kGold{0.42, 2.35};
constexpr double kUm = 0.55, kDegree = 0.017453292519943295;

std::vector<Brdf<double>> lobes_of(const char* names, std::vector<double> values) {
  return make_brdfs(lobe_sum(names), values);
}
InstrumentReflectance seen(const std::vector<Brdf<double>>& lobes, const InstrumentGeometry& geometry,
                           const Interface<double>& surface = kPerfect, double tolerance = 1e-6) {
  const InstrumentReflectance found = instrument_reflectance(lobes, geometry, surface, kUm, tolerance);
  CHECK(found.factor.converged);
  CHECK(found.factor.error <= tolerance * std::max(1e-6, found.factor.value) * 1.5);
  return found;
}

struct Mean {
  double value, standard_error;
};
template <class F>
Mean mean_of(std::size_t samples, F&& draw) {
  double sum = 0, squares = 0;
  for (std::size_t s = 0; s < samples; ++s) {
    const double x = draw();
    sum += x, squares += x * x;
  }
  const double n = static_cast<double>(samples), mean = sum / n;
  return {mean, std::sqrt(std::max(0.0, squares / n - mean * mean) / n)};
}

/// Plain Monte Carlo, with nothing of the quadrature but the test whether a cap holds a direction.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}
  double number() { return std::uniform_real_distribution<double>(0, 1)(random_); }

  /// Uniform in solid angle within the cone, whatever the stop and the horizon.
  UnitVector<double> in(const Cone& cone) {
    const double fall = number() * 2 * haversine(cone.half_angle_deg * kDegree);
    return frame(cone).direction(std::acos(1 - fall), 2 * kPi<double> * number());
  }
  /// Uniform in projected solid angle within the opening.
  UnitVector<double> projected(const Opening& opening) {
    if (opening.is_direction()) return frame(opening.cone).p;
    for (;;) {
      const UnitVector<double> v = in(opening.cone);
      if (is_in(opening, v) && number() < v.z) return v;
    }
  }
  static bool is_in(const Opening& opening, const UnitVector<double>& v) {
    return v.z > 0 && cap(opening.cone).has(v) && !(opening.stop && cap(*opening.stop).has(v));
  }

 private:
  static Frame frame(const Cone& cone) { return Frame::at(cone.theta_deg * kDegree, cone.phi_deg * kDegree); }
  static Cap cap(const Cone& cone) { return {frame(cone).p, cone.half_angle_deg * kDegree}; }

  std::mt19937_64 random_;
};

/// The reflectance by light that is traced with the lobe's own sampler (reciprocal models).
Mean traced(const Brdf<double>& brdf, const InstrumentGeometry& geometry, const Interface<double>& surface,
            std::size_t samples, std::uint64_t seed) {
  Draw draw(seed);
  const BrdfSampler<double> sampler(brdf, surface, kUm);
  return mean_of(samples, [&] {
    const UnitVector<double> i = draw.projected(geometry.source);
    const double u0 = draw.number(), u1 = draw.number(), u2 = draw.number();
    const auto sample = sampler.sample(i, u0, u1, u2);
    if (!sample || !Draw::is_in(geometry.collector, sample->i)) return 0.0;
    return sample->f / sample->pdf * (sample->delta ? 1 : sample->i.z);
  });
}

/// The factor by pairs of directions drawn without looking at the lobe.
Mean paired(const std::vector<Brdf<double>>& lobes, const InstrumentGeometry& geometry, std::size_t samples,
            std::uint64_t seed) {
  Draw draw(seed);
  return mean_of(samples, [&] {
    const UnitVector<double> i = draw.projected(geometry.source), o = draw.projected(geometry.collector);
    return kPi<double> * evaluate(std::span(lobes), reduce(i.x, i.y, i.z, o.x, o.y, o.z), kPerfect, kUm);
  });
}

}  // namespace

TEST_CASE("Lambert has the factor kd in every geometry, and the reflectance kd·Ω_r/π", "[energy][instrument]") {
  const auto white = lobes_of("lambert", {0.8});
  for (const char* name : {"8:di", "8:de", "di:8", "de:8", "45:0", "0:45", "45a:0", "0:45a", "h:h", "45:45"}) {
    INFO(name);
    CHECK(seen(white, instrument_geometry(name)).factor.value == Approx(0.8).epsilon(1e-12));
  }
  for (const double half : {0.01, 3.0, 40.0})
    CHECK(seen(white, {{{20, 10, 5}}, {{45, 130, half}}}).reflectance->value ==
          Approx(0.8 * square(sin_deg(half)) * cos_deg(45.0)).epsilon(1e-9));
  const InstrumentReflectance ring = seen(white, instrument_geometry("45a:8", {.half_angle_deg = 5}));
  CHECK(ring.source_sr == Approx(kPi<double> * (square(sin_deg(50.0)) - square(sin_deg(40.0)))).epsilon(1e-10));
  CHECK(!seen(white, instrument_geometry("45:0")).reflectance);
}

TEST_CASE("A mirror between two hemispheres is the mean of R over projected directions", "[energy][instrument]") {
  const auto mirror = lobes_of("mirror", {0, 1});
  // Walsh 1926, in closed form for a dielectric.
  const double n = 1.5, n2 = n * n, n4 = n2 * n2;
  const double walsh = 0.5 + (n - 1) * (3 * n + 1) / (6 * square(n + 1)) +
                       n2 * square(n2 - 1) / std::pow(n2 + 1, 3) * std::log((n - 1) / (n + 1)) -
                       2 * n * n2 * (n2 + 2 * n - 1) / ((n2 + 1) * (n4 - 1)) +
                       8 * n4 * (n4 + 1) / ((n2 + 1) * square(n4 - 1)) * std::log(n);
  CHECK(seen(mirror, instrument_geometry("h:h"), kGlass).reflectance->value == Approx(walsh).epsilon(1e-6));
  double gold = 0;  // Simpson over the cosine
  constexpr int kSteps = 20000;
  for (int s = 0; s <= kSteps; ++s) {
    const double c = static_cast<double>(s) / kSteps, weight = s == 0 || s == kSteps ? 1 : s % 2 ? 4 : 2;
    gold += weight / (3 * kSteps) * 2 * c * kGold.reflectance(c);
  }
  CHECK(seen(mirror, instrument_geometry("d:d"), kGold).reflectance->value == Approx(gold).epsilon(1e-6));
  // In one direction: R itself, whichever side is the sphere; nothing where the trap is.
  for (const char* name : {"8:di", "di:8"})
    CHECK(seen(mirror, instrument_geometry(name), kGold).factor.value ==
          Approx(kGold.reflectance(cos_deg(8.0))).epsilon(1e-9));
  for (const char* name : {"8:de", "de:8", "45:0"})
    CHECK(seen(mirror, instrument_geometry(name), kGold).factor.value == 0);
  // 20:20 of a gloss meter with a source narrower than its collector: all of R.
  CHECK(seen(mirror, instrument_geometry("20:20", {0, 0.5, 1}), kGold).reflectance->value ==
        Approx(kGold.reflectance(cos_deg(20.0))).epsilon(1e-4));
}

TEST_CASE("A mirror between cones that overlap in part sends the share that they have in common",
          "[energy][instrument]") {
  const auto mirror = lobes_of("mirror", {0, 1});
  // A cone about the normal seen by half of all directions; a collector wholly inside the source's image.
  CHECK(seen(mirror, {{{0, 0, 30}}, {{90, 70, 90}}}).reflectance->value == Approx(0.5).epsilon(1e-6));
  CHECK(seen(mirror, {{{30, 0, 20}}, {{35, 180, 5}}}).reflectance->value ==
        Approx(square(sin_deg(5.0) / sin_deg(20.0)) * cos_deg(35.0) / cos_deg(30.0)).epsilon(1e-6));
  for (const auto& geometry : {InstrumentGeometry{{{40, 0, 5}}, {{43, 180, 5}}},
                               InstrumentGeometry{{{75, 20, 25}}, {{60, 150, 25}, Cone{75, 180, 10}}}}) {
    const double value = seen(mirror, geometry).reflectance->value;
    InstrumentGeometry turned = geometry;  // to azimuths from the grain
    turned.collector.cone.phi_deg += geometry.source.cone.phi_deg;
    if (turned.collector.stop) turned.collector.stop->phi_deg += geometry.source.cone.phi_deg;
    const Mean monte_carlo = traced(mirror[0], turned, kPerfect, 400000, 21);
    INFO(value << " against " << monte_carlo.value << " ± " << monte_carlo.standard_error);
    CHECK(std::abs(value - monte_carlo.value) < 5 * monte_carlo.standard_error);
  }
}

TEST_CASE("45:0 with apertures is the mean over pairs of directions", "[energy][instrument]") {
  const InstrumentGeometry geometry = instrument_geometry("45:0", {0, 2, 5});
  for (const auto& [model, values] :
       {std::pair{"ggx", std::vector{0.3, 0.3, 0.1, 0.9}}, {"torrance-sparrow", {0.2, 0.2, 0.8}}}) {
    const auto lobes = lobes_of(model, values);
    const double value = seen(lobes, geometry).factor.value;
    const Mean monte_carlo = paired(lobes, geometry, 1000000, 22);
    INFO(model << ": " << value << " against " << monte_carlo.value << " ± " << monte_carlo.standard_error);
    CHECK(std::abs(value - monte_carlo.value) < 4 * monte_carlo.standard_error);
    CHECK(monte_carlo.standard_error < 2e-4 * value);
    // Two directions are the limit of narrow cones.
    const double directions = seen(lobes, instrument_geometry("45:0")).factor.value;
    CHECK(seen(lobes, instrument_geometry("45:0", {0, 0.05, 0.05})).factor.value == Approx(directions).epsilon(1e-5));
  }
}

TEST_CASE("Directional-hemispherical and hemispherical-directional agree where a model is reciprocal",
          "[energy][instrument]") {
  struct Case {
    const char* model;
    std::vector<double> values;
  };
  const std::vector<Case> cases{{"ggx", {0.3, 0.3, 0.2, 0.7}},
                                {"ggx", {0.1, 0.4, 0, 1}},
                                {"torrance-sparrow", {0.1, 0, 1}},
                                {"beckmann-kirchhoff", {0.2, 3, 0, 1}},
                                {"he-1991", {0.05, 2, 0, 1}},
                                {"oren-nayar", {0.4, 0, 1}},
                                {"lafortune-1997", {1, 0.8, 0.9, 30, 0, 1}}};
  for (const Case& c : cases) {
    const auto lobes = lobes_of(c.model, c.values);
    const Opening all{kHemisphere};
    for (const double theta : {8.0, 70.0}) {
      const double out = seen(lobes, {{{theta, 30, 0}}, all}).factor.value,
                   in = seen(lobes, {all, {{theta, 30, 0}}}).factor.value;
      INFO(c.model << " at " << theta << ": " << out << " and " << in);
      CHECK(std::abs(out - in) < 2e-6 * out);  // each to 1e-6
    }
  }
  const auto phong = lobes_of("phong-1975", {20, 0, 1});
  const Opening all{kHemisphere};
  CHECK(std::abs(seen(phong, {{{60, 0, 0}}, all}).factor.value / seen(phong, {all, {{60, 0, 0}}}).factor.value - 1) >
        0.01);
}

TEST_CASE("A lobe much narrower than both cones is found, and lost at their edges as light that is traced",
          "[energy][instrument][slow]") {
  const auto narrow = lobes_of("torrance-sparrow", {0.002, 0, 1});
  const double directional = seen(narrow, instrument_geometry("8:di"), kGold).factor.value;
  CHECK(seen(narrow, {{{8, 0, 2}}, {{8, 180, 5}}}, kGold).reflectance->value == Approx(directional).epsilon(1e-4));
  CHECK(seen(narrow, {{{8, 0, 0}}, {{8, 180, 5}}}, kGold).reflectance->value == Approx(directional).epsilon(1e-4));
  CHECK(seen(narrow, {{{8, 0, 2}}, {{20, 180, 5}}}, kGold).factor.value < 1e-12);
  for (const double axis : {8.0, 12.0}) {
    const InstrumentGeometry equal{{{8, 0, 5}}, {{axis, 180, 5}}};
    const double value = seen(narrow, equal, kGold, 1e-4).reflectance->value;
    const Mean monte_carlo = traced(narrow[0], equal, kGold, 400000, 23);
    INFO(axis << ": " << value << " against " << monte_carlo.value << " ± " << monte_carlo.standard_error);
    CHECK(std::abs(value - monte_carlo.value) < 4 * monte_carlo.standard_error + 1e-4 * value);
  }
}

TEST_CASE("Cones, holes and hemispheres agree with light that is traced", "[energy][instrument][slow]") {
  const auto check = [](const char* model, std::vector<double> values, const InstrumentGeometry& geometry, bool retro) {
    auto lobes = lobes_of(model, std::move(values));
    lobes[0].retro = retro;
    const double value = seen(lobes, geometry, kPerfect, 1e-4).reflectance->value;
    const Mean monte_carlo = traced(lobes[0], geometry, kPerfect, 300000, 24);
    INFO(model << ": " << value << " against " << monte_carlo.value << " ± " << monte_carlo.standard_error);
    CHECK(std::abs(value - monte_carlo.value) < 4 * monte_carlo.standard_error + 1e-4 * value);
  };
  const Opening all{kHemisphere};
  check("he-1991", {0.05, 2, 0, 1}, {{{8, 0, 5}}, {{0, 0, 90}, Cone{8, 180, 4}}}, false);
  check("ggx", {0.1, 0.4, 0, 1}, {all, all}, false);
  check("ggx", {0.1, 0.4, 0, 1}, {{{50, 0, 20}}, {{30, 150, 35}}}, false);
  check("ggx", {0.05, 0.05, 0, 1}, {{{50, 0, 10}}, {{45, 10, 12}}}, true);
  check("beckmann-kirchhoff", {0.05, 2, 0, 1}, {{{0, 0, 50}, Cone{0, 0, 40}}, {{0, 0, 60}, Cone{0, 0, 38}}}, false);
  check("lafortune-1997", {1, 1, 0.8, 40, 0, 1}, {{{40, 0, 10}}, {{50, 180, 15}}}, false);
}

TEST_CASE("Between hemispheres: the directional reflectance, averaged", "[energy][instrument]") {
  for (const auto& [model, values] :
       {std::pair{"ggx", std::vector{0.3, 0.3, 0.0, 1.0}}, {"torrance-sparrow", {0.1, 0.0, 1.0}}}) {
    const auto lobes = lobes_of(model, values);
    double mean = 0;  // Simpson over the root of the cosine, of the cone integral
    constexpr int kSteps = 100;
    for (int s = 1; s <= kSteps; ++s) {
      const double root = static_cast<double>(s) / kSteps, weight = s == kSteps ? 1 : s % 2 ? 4 : 2;
      const double theta_deg = std::acos(root * root) / kDegree;
      mean += weight / (3 * kSteps) * 4 * root * root * root *
              cone_reflectance(lobes, theta_deg, kPerfect, kUm, kHemisphere).total.value;
    }
    INFO(model);
    CHECK(seen(lobes, instrument_geometry("h:h")).reflectance->value == Approx(mean).epsilon(1e-5));
  }
  // Facets without shadowing, f = D·R/(4·cos_i·cos_o): for one facet the lights whose mirror direction is above the horizon
  // too project onto it as an ellipse of area π·cos_h, so that with R = 1 the whole is ∫ D·cos_h dω_h. f has no bound.
  CHECK(seen(lobes_of("trowbridge-reitz", {0.3, 0, 1}), instrument_geometry("h:h")).factor.value ==
        Approx(0.09).epsilon(1e-6));
  LobeSum rough = lobe_sum("beckmann-kirchhoff");
  REQUIRE(rough.set("variant", "rough-limit"));
  CHECK(seen(make_brdfs(rough, std::vector{0.5, 3.0, 0.0, 1.0}), instrument_geometry("h:h")).factor.value ==
        Approx(1).epsilon(1e-6));
  // Grows as 1/cos_i at grazing, which the projected solid angle takes away.
  CHECK(seen(lobes_of("ward-duer-2006", {0.2, 0.2, 0, 1}), instrument_geometry("h:h")).factor.value < 1);
}

TEST_CASE("Openings that make no measurement are refused", "[energy][instrument]") {
  const auto mirror = lobes_of("mirror", {0, 1}), white = lobes_of("lambert", {0.5});
  const auto at = [&](const std::vector<Brdf<double>>& lobes, const InstrumentGeometry& geometry) {
    return instrument_reflectance(lobes, geometry, kPerfect, kUm);
  };
  CHECK_THROWS_WITH(at(mirror, instrument_geometry("45:45")), Catch::Contains("infinite"));
  CHECK_THROWS_WITH(at(white, {{{90, 0, 0}}, {kHemisphere}}), Catch::Contains("89.99"));
  CHECK_THROWS_WITH(at(white, {{{8, 0, 0}}, {{8, 180, 3}, Cone{8, 180, 4}}}), Catch::Contains("collector: nothing"));
  LobeSum kirchhoff = lobe_sum("beckmann-kirchhoff");
  REQUIRE(kirchhoff.set("variant", "nieto-vesperinas-1982"));
  const auto infinite = make_brdfs(kirchhoff, std::vector{0.2, 3.0, 0.0, 1.0});
  CHECK_THROWS_WITH(at(infinite, instrument_geometry("8:di")), Catch::Contains("infinite"));
  CHECK(at(infinite, {{{8, 0, 0}}, {{8, 180, 20}}}).factor.converged);
}

TEST_CASE("Geometries by the names that instruments bear", "[energy][instrument]") {
  const InstrumentGeometry de8 = instrument_geometry("de:8°", {.phi_i_deg = 30, .trap_half_angle_deg = 5});
  CHECK(de8.source.is_direction() == false);
  CHECK(de8.source.stop->theta_deg == 8);
  CHECK(de8.source.stop->phi_deg == 30);  // across the normal from the collector, which is at 30 + 180
  CHECK(de8.source.stop->half_angle_deg == 5);
  CHECK(de8.collector.cone.phi_deg == 180);
  const InstrumentGeometry ring = instrument_geometry("45°a:0°");
  CHECK(ring.source.cone.half_angle_deg == 50);
  CHECK(ring.source.stop->half_angle_deg == 40);
  CHECK(nicodemus_name(ring) == "conical-directional");
  CHECK(nicodemus_name(instrument_geometry("8/d")) == "directional-hemispherical");
  CHECK(nicodemus_name(instrument_geometry("h:h")) == "bihemispherical");
  CHECK(nicodemus_name(instrument_geometry("45:0")) == "bidirectional");
  CHECK(nicodemus_name(instrument_geometry("45:0", {0, 1, 2})) == "biconical");
  for (const char* bad :
       {"", "8", "8:", ":8", "8:x", "91:0", "-8:d", "8:d:d", "nan:0", "de:de", "d:de", "88a:0", "a:0"})
    CHECK_THROWS(instrument_geometry(bad));
  CHECK_THROWS(instrument_geometry("8:di", {.half_angle_deg = 3}));
}
