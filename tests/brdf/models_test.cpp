// The same tests for every model of the list: a new model gets them by being listed.
#include "brdf/models.h"

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <random>

#include "base/error.h"
#include "base/jet.h"
#include "brdf/brdf.h"
#include "brdf/lanes.h"
#include "catch.h"

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
    for (std::size_t p = 0; p < choices.size(); ++p)
      grid.back()[p] = choices[p][std::min(corner, choices[p].size() - 1)];
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
            INFO(spec.info().name << " " << values[0] << " at " << ti << " " << to << " " << phi << ": " << f << " "
                                  << g);
            REQUIRE(std::isfinite(f));
            REQUIRE(f >= 0);
            if (spec.info().reciprocal) REQUIRE(std::abs(f - g) <= 1e-12 * f);
            const float fast =
                evaluate(lanes, spread<FloatLanes>(w), spread<FloatLanes>(kMetal), FloatLanes(float(kUm))).get(0);
            REQUIRE(fast >= 0);
            if (f < 1e30) REQUIRE(std::isfinite(fast));
          }
    }
}

TEST_CASE("Derivatives come out of the models' own code", "[brdf]") {
  using J = Jet<12>;
  for (const ModelSpec& spec : specs())
    for (const double theta : {0.0, 30.0, 75.0}) {
      std::vector<double> values;
      for (const ParameterInfo& p : spec.info().parameters)
        values.push_back(p.linear ? 0.4 : std::pow(p.fit_lo * p.fit_hi * p.fit_hi, 1.0 / 3));
      const Directions<double> w = directions_from_deg(theta, theta + 3, 175.0);
      std::vector<J> jets;
      for (std::size_t i = 0; i < values.size(); ++i) jets.emplace_back(values[i], int(i));
      const J f = evaluate(make_brdf<J>(spec, jets), w, Interface<J>{J(kMetal.n), J(kMetal.k)}, J(kUm));
      for (std::size_t i = 0; i < values.size(); ++i) {
        auto above = values, below = values;
        const double step = 1e-5 * values[i];
        above[i] += step;
        below[i] -= step;
        const double difference = (evaluate(make_brdf<double>(spec, above), w, kMetal, kUm) -
                                   evaluate(make_brdf<double>(spec, below), w, kMetal, kUm)) /
                                  (2 * step);
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
  CHECK(evaluate(make_brdf<double>({ModelId::pseudo_realistic}, values), directions_from_deg(0.0, 0.0, 0.0), kMetal,
                 kUm) ==
        Approx(0.3 * r0 / kPi<double> + 0.7 * r0 / (4 * 0.2 * std::sqrt(2 * kPi<double>))).epsilon(1e-14));
  // Torrance-Sparrow at the normal: F/(4 π α²), α² = 2m².
  CHECK(evaluate(make_brdf<double>({ModelId::torrance_sparrow}, values), directions_from_deg(0.0, 0.0, 0.0), kMetal,
                 kUm) == Approx(0.3 / kPi<double> + 0.7 * r0 / (4 * kPi<double> * 0.08)).epsilon(1e-14));
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
