// The same tests for every model of the list: a new model gets them by being listed.
#include "brdf/models.h"

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <random>

#include "base/error.h"
#include "base/jet.h"
#include "brdf/brdf.h"
#include "brdf/lanes.h"
#include "catch.h"
#include "reference/reference.h"

using namespace gonio;

namespace {

/// Corners and middles of the documented box, kd and ks as a user would set them: all of them for few parameters, else each
/// parameter in turn through its values, the others at their middles, and both extreme corners.
std::vector<std::vector<double>> parameter_grid(const ModelInfo& info) {
  std::vector<std::vector<double>> choices;
  std::size_t nonlinear = 0;
  for (const ParameterInfo& p : info.parameters) {
    const double lo = std::max(p.lo, p.fit_lo * 1e-3);
    choices.push_back(p.linear ? std::vector<double>{p.name == "kd" ? 0.25 : 0.8}
                               : std::vector<double>{std::sqrt(lo * p.hi), p.lo, p.hi, p.fit_lo, p.fit_hi});
    nonlinear += !p.linear;
  }
  std::vector<std::vector<double>> grid{{}};
  if (nonlinear <= 2) {
    for (const auto& options : choices) {
      std::vector<std::vector<double>> next;
      for (const auto& values : grid)
        for (const double choice : options) {
          next.push_back(values);
          next.back().push_back(choice);
        }
      grid = std::move(next);
    }
    return grid;
  }
  for (const auto& options : choices) grid[0].push_back(options[0]);
  const std::vector<double> middle = grid[0];
  for (std::size_t p = 0; p < choices.size(); ++p)
    for (std::size_t c = 1; c < choices[p].size(); ++c) {
      grid.push_back(middle);
      grid.back()[p] = choices[p][c];
    }
  for (const std::size_t corner : {1, 2}) {
    grid.push_back(middle);
    for (std::size_t p = 0; p < choices.size(); ++p) grid.back()[p] = choices[p][std::min(corner, choices[p].size() - 1)];
  }
  return grid;
}

std::vector<ModelSpec> specs() {
  std::vector<ModelSpec> all;
  for (const ModelInfo& info : models()) {
    ModelSpec spec;
    spec.id = info.id;
    if (info.shadowings.empty()) all.push_back(spec);
    for (const auto name : info.shadowings) {
      set_shadowing(spec, name);
      all.push_back(spec);
    }
  }
  return all;
}

const std::vector<double> kAngles{0, 1e-3, 20, 55, 80, 89, 89.9, 89.9999};
const Interface<double> kMetal{0.96, 6.7};
constexpr double kUm = 0.55;

}  // namespace

TEST_CASE("Every model is finite, non-negative and reciprocal over its box, grazing and normal included", "[brdf]") {
  for (const ModelSpec& spec : specs())
    for (const auto& values : parameter_grid(spec.info())) {
      const Brdf<double> brdf = make_brdf<double>(spec, values);
      const auto lanes = spread_brdf<FloatLanes>(spec, values);
      for (const double ti : kAngles)
        for (const double to : kAngles)
          for (const double phi : {0.0, 90.0, 180.0}) {
            const Directions<double> w = directions_from_deg(ti, to, phi, 20.0), back = swapped(w);
            const double f = evaluate(brdf, w, kMetal, kUm), g = evaluate(brdf, back, kMetal, kUm);
            INFO(spec.info().name << " " << values[0] << " at " << ti << " " << to << " " << phi << ": " << f << " " << g);
            REQUIRE(std::isfinite(f));
            REQUIRE(f >= 0);
            if (spec.info().reciprocal) REQUIRE(std::abs(f - g) <= 1e-12 * f);
            const float fast = evaluate(lanes, spread<FloatLanes>(w), spread<FloatLanes>(kMetal), FloatLanes(float(kUm))).get(0);
            REQUIRE(fast >= 0);
            if (f < 1e30) REQUIRE(std::isfinite(fast));
          }
    }
}

TEST_CASE("Double and float lanes agree with 50 digits", "[brdf]") {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const ModelSpec& spec : specs()) {
    double worst_double = 0, worst_float = 0;
    for (int i = 0; i < 60; ++i) {
      std::vector<double> values;
      for (const ParameterInfo& p : spec.info().parameters)
        values.push_back(p.linear ? 0.1 + uniform(random) : p.fit_lo * std::pow(p.fit_hi / p.fit_lo, uniform(random)));
      const double ti = 89.9 * uniform(random), to = std::clamp(ti + 20 * (uniform(random) - 0.5), 0.0, 89.9), phi = 160 + 40 * uniform(random);
      const Directions<double> w = directions_from_deg(ti, to, phi);
      const double exact = reference_evaluate(spec, values, ti, to, phi, kMetal, kUm).value;
      const double f = evaluate(make_brdf<double>(spec, values), w, kMetal, kUm);
      worst_double = std::max(worst_double, std::abs(f - exact) / exact);
      const auto lanes = spread_brdf<FloatLanes>(spec, values);
      const float fast = evaluate(lanes, spread<FloatLanes>(w), spread<FloatLanes>(kMetal), FloatLanes(float(kUm))).get(0);
      const Directions<float> wf{float(w.cos_i), float(w.cos_o), float(w.cos_d), float(w.tan2_h), float(w.tan2_i), float(w.tan2_o),
                                 float(w.ix), float(w.iy), float(w.ox), float(w.oy), float(w.hx), float(w.hy)};
      const std::vector<float> vf(values.begin(), values.end());
      const Directions<double> given{wf.cos_i, wf.cos_o, wf.cos_d, wf.tan2_h, wf.tan2_i, wf.tan2_o, wf.ix, wf.iy, wf.ox, wf.oy, wf.hx, wf.hy};
      const std::vector<double> rounded(vf.begin(), vf.end());
      const Interface<double> metal{double(float(kMetal.n)), double(float(kMetal.k))};
      const double exact_f = reference_evaluate(spec, rounded, given, metal, double(float(kUm))).value;
      worst_float = std::max(worst_float, std::abs(fast - exact_f) / exact_f);
    }
    INFO(spec.info().name << " " << name_of(spec.shadowing) << ": double " << worst_double << ", float " << worst_float);
    CHECK(worst_double < (spec.info().needs_wavelength ? 1e-10 : 1e-12));
    CHECK(worst_float < 2e-5);
  }
}

TEST_CASE("Derivatives come out of the models' own code", "[brdf]") {
  using J = Jet<12>;
  for (const ModelSpec& spec : specs())
    for (const double theta : {0.0, 30.0, 75.0}) {
      std::vector<double> values;
      for (const ParameterInfo& p : spec.info().parameters) values.push_back(p.linear ? 0.4 : std::pow(p.fit_lo * p.fit_hi * p.fit_hi, 1.0 / 3));
      const Directions<double> w = directions_from_deg(theta, theta + 3, 175.0);
      std::vector<J> jets;
      for (std::size_t i = 0; i < values.size(); ++i) jets.emplace_back(values[i], int(i));
      const J f = evaluate(make_brdf<J>(spec, jets), w, Interface<J>{J(kMetal.n), J(kMetal.k)}, J(kUm));
      for (std::size_t i = 0; i < values.size(); ++i) {
        auto above = values, below = values;
        const double step = 1e-5 * values[i];
        above[i] += step;
        below[i] -= step;
        const double difference =
            (evaluate(make_brdf<double>(spec, above), w, kMetal, kUm) - evaluate(make_brdf<double>(spec, below), w, kMetal, kUm)) / (2 * step);
        INFO(spec.info().name << " d/d" << spec.info().parameters[i].name << " at " << theta);
        CHECK(f.v[int(i)] == Approx(difference).epsilon(1e-6).margin(1e-9 * f.a / values[i]));
      }
    }
}

TEST_CASE("Known values", "[brdf]") {
  const Directions<double> mirror = directions_from_deg(30.0, 30.0, 180.0);
  CHECK(mirror.tan2_h == 0);
  CHECK(mirror.cos_d == Approx(std::sqrt(3.0) / 2));
  const std::vector<double> half{0.5};
  CHECK(evaluate(make_brdf<double>({ModelId::lambert}, half), mirror, kMetal, kUm) == Approx(0.5 / kPi<double>));
  // (31) at the normal: kd R0/π + ks R0/(4 m √(2π)).
  const std::vector<double> values{0.2, 0.3, 0.7};
  const double r0 = kMetal.r0();
  CHECK(evaluate(make_brdf<double>({ModelId::pseudo_realistic}, values), directions_from_deg(0.0, 0.0, 0.0), kMetal, kUm) ==
        Approx(0.3 * r0 / kPi<double> + 0.7 * r0 / (4 * 0.2 * std::sqrt(2 * kPi<double>))).epsilon(1e-14));
  // Torrance-Sparrow at the normal: F/(4 π α²), α² = 2m².
  CHECK(evaluate(make_brdf<double>({ModelId::torrance_sparrow}, values), directions_from_deg(0.0, 0.0, 0.0), kMetal, kUm) ==
        Approx(0.3 / kPi<double> + 0.7 * r0 / (4 * kPi<double> * 0.08)).epsilon(1e-14));
}

TEST_CASE("What a user may get wrong is refused", "[brdf]") {
  CHECK_THROWS_AS(model("phong-1976"), InputError);
  CHECK_THROWS_AS(model("lambert").index_of("m"), InputError);
  const std::vector<double> nan{std::nan(""), 0, 1}, negative{0.1, -1, 1}, fine{0.1, 0, 1};
  CHECK_THROWS_AS(check_values(model("torrance-sparrow"), nan), InputError);
  CHECK_THROWS_AS(check_values(model("torrance-sparrow"), negative), InputError);
  CHECK_NOTHROW(check_values(model("torrance-sparrow"), fine));
  ModelSpec spec{ModelId::pseudo_realistic};
  CHECK_THROWS_AS(set_shadowing(spec, "v-cavity"), InputError);
  CHECK_THROWS_AS(set_variant(spec, "schlick"), InputError);
}
