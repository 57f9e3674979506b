#include "energy/cone_reflectance.h"

#include "brdf/lobe_sum.h"
#include "catch.h"

using namespace gonio;

namespace {

const Interface<double> kPerfect = perfect_interface<double>();
constexpr double kUm = 0.55;

std::vector<Brdf<double>> lobes_of(const char* names, std::vector<double> values) {
  return make_brdfs(lobe_sum(names), values);
}
ConeReflectance into(const std::vector<Brdf<double>>& lobes, double theta_i_deg, const Cone& cone,
                     std::optional<Cone> stop = {}) {
  return cone_reflectance(lobes, theta_i_deg, kPerfect, kUm, cone, stop);
}

}  // namespace

TEST_CASE("Lambert into a cone: sin² of its half angle times the cosine of its axis", "[energy][cone]") {
  const auto white = lobes_of("lambert", {0.8});
  for (const double half : {0.01, 1.0, 30.0, 90.0})
    for (const double axis : {0.0, 40.0}) {
      if (axis + half > 90 && axis > 0) continue;
      const Estimate e = into(white, 20, {axis, 130, half}).total;
      INFO(axis << " " << half << ": " << e.value << " ± " << e.error);
      CHECK(e.converged);
      CHECK(e.value == Approx(0.8 * square(sin_deg(half)) * cos_deg(axis)).epsilon(1e-6));
    }
  // Cut in halves by the horizon: the form factor of a half disc seen edge on, (β - sin β·cos β)/π.
  const double beta = 35 * kPi<double> / 180;
  CHECK(into(white, 0, {90, 0, 35}).total.value ==
        Approx(0.8 * (beta - std::sin(beta) * std::cos(beta)) / kPi<double>).epsilon(1e-6));
}

TEST_CASE("The hemisphere is the directional reflectance, lobe by lobe", "[energy][cone]") {
  struct Case {
    const char* model;
    std::vector<double> values;
  };
  const std::vector<Case> cases{
      {"torrance-sparrow", {0.3, 0, 1}},          {"ggx", {0.02, 0.02, 0, 1}}, {"ggx", {0.1, 0.4, 0, 1}},
      {"beckmann-kirchhoff", {0.2, 3, 0, 1}},     {"he-1991", {0.1, 2, 0, 1}}, {"oren-nayar", {0.4, 0, 1}},
      {"lafortune-1997", {-1, -1, 0.9, 30, 0, 1}}};
  for (const Case& c : cases)
    for (const double theta : {0.0, 35.0, 75.0}) {
      const auto lobes = lobes_of(c.model, c.values);
      const ConeReflectance cone = into(lobes, theta, kHemisphere);
      const Estimate e = directional_reflectance(lobes[0].lobe, theta, {{kPerfect}, {kUm}}, 1e-8)[0];
      INFO(c.model << " at " << theta << ": " << cone.total.value - cone.coherent << " ± " << cone.total.error
                   << " against " << e.value << " ± " << e.error);
      CHECK(cone.total.converged);
      CHECK(cone.total.error <= 1e-6 * cone.total.value);
      CHECK(std::abs(cone.total.value - cone.coherent - e.value) < 3e-7 + e.error);
      CHECK(cone.coherent == coherent_energy(lobes[0], cos_deg(theta), kPerfect, kUm));
    }
}

TEST_CASE("A lobe much narrower than its cone lies in it, and cone and ring make the larger cone", "[energy][cone]") {
  const auto narrow = lobes_of("beckmann", {1e-3, 1e-3, 0, 0.7});
  for (const double theta : {0.0, 8.0, 60.0}) {
    CHECK(into(narrow, theta, {theta, 180, 5}).total.value == Approx(0.7).epsilon(1e-5));
    CHECK(into(narrow, theta, {theta + 3, 180, 5}).total.value == Approx(0.7).epsilon(1e-5));
    CHECK(into(narrow, theta, kHemisphere, Cone{theta, 180, 2}).total.value < 1e-9);
  }
  // Normal incidence: the share beyond s of a Gaussian of slopes is exp(-tan²(s/2)/α²) (no shadowing to speak of).
  const auto lobe = lobes_of("beckmann", {0.02, 0.02, 0, 1});
  const double beyond = std::exp(-square(std::tan(kPi<double> / 180) / 0.02));
  CHECK(into(lobe, 0, {0, 0, 30}, Cone{0, 0, 2}).total.value == Approx(beyond).epsilon(1e-4));

  const auto sum = lobes_of("ggx+beckmann", {0.1, 0.1, 0.3, 0.2, 0.2, 0.5, 0.3});
  const Cone small{40, 170, 6}, large{45, 180, 25};
  const Estimate whole = into(sum, 42, large).total, inner = into(sum, 42, small).total,
                 ring = into(sum, 42, large, small).total;
  CHECK(std::abs(inner.value + ring.value - whole.value) <= inner.error + ring.error + whole.error);
  CHECK(whole.error <= 1e-6 * whole.value);
}

TEST_CASE("The coherent delta belongs to the cone that holds the mirror direction and to no stop", "[energy][cone]") {
  const auto smooth = lobes_of("beckmann-kirchhoff", {0.01, 3, 0, 1});
  const double delta = coherent_energy(smooth[0], cos_deg(30.0), kPerfect, kUm);
  REQUIRE(delta > 0.8);
  CHECK(into(smooth, 30, {30, 180, 1}).coherent == delta);
  CHECK(into(smooth, 30, {30, 0, 1}).coherent == 0);
  CHECK(into(smooth, 30, kHemisphere, Cone{30, 180, 1}).coherent == 0);
  const auto mirror = lobes_of("mirror", {0, 0.9});
  CHECK(into(mirror, 30, {35, 180, 6}).total.value == 0.9);
  auto back = lobes_of("ggx", {0.01, 0.01, 0, 1});
  back[0].retro = true;
  CHECK(into(back, 50, {50, 0, 20}).total.value > 0.95);
  CHECK(into(back, 50, {50, 180, 20}).total.value < 0.01);
}
