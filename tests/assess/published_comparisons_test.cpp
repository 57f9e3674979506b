// What the pages of published experiments and published tables say, held; their tools against closed forms.
#include "assess/published_comparisons.h"

#include <set>

#include "assess/merl_checks.h"
#include "catch.h"
#include "materials/database.h"

using namespace gonio;

namespace {

/// Statements (first words) that do not hold.
std::set<std::string> failing(const std::vector<Claim>& claims) {
  std::set<std::string> names;
  for (const Claim& claim : claims) {
    CHECK(std::isfinite(claim.value));
    if (!claim.holds()) names.insert(claim.statement);
  }
  return names;
}

/// Directional reflectance of a published fit (a broad lobe) from a plain grid of the hemisphere.
double energy_on_a_grid(const std::string& path, double theta_i) {
  const PublishedFit fit = published_fit(path);
  const Brdf<double> brdf = make_brdf<double>(fit.spec, fit.values);
  double energy = 0;
  const int rings = 600, sectors = 360;
  for (int a = 0; a < rings; ++a)
    for (int b = 0; b < sectors; ++b) {
      const double theta = (a + 0.5) * 90 / rings, phi = (b + 0.5) * 360 / sectors, radians = theta * kPi<double> / 180;
      energy += evaluate(brdf, directions_from_deg(theta_i, theta, phi), fit.surface, 1.0) * std::cos(radians) *
                std::sin(radians) * (kPi<double> / 2 / rings) * (2 * kPi<double> / sectors);
    }
  return energy;
}

}  // namespace

TEST_CASE("Gold at 633 nm is Johnson & Christy's", "[assess][comparisons]") {
  const Interface<double> gold = SurfaceMaterial("Au_Johnson").at(633);
  CHECK(gold.n == Approx(0.18344).margin(2e-4));  // as tabulated between their points
  CHECK(gold.k == Approx(3.4332).margin(1e-3));
}

TEST_CASE("Tools of the comparisons: power per steradian, lobes, shares", "[assess][comparisons]") {
  const Interface<double> perfect = perfect_interface<double>();
  CHECK(power_per_sr(TorranceSparrow<double>{0.3}, perfect, 40, 55, 0.5) ==
        Approx(TorranceSparrow<double>{0.3}.shape(directions_from_deg(40.0, 55.0, 180.0)) *
               std::cos(55 * kPi<double> / 180))
            .epsilon(1e-12));
  Curve triangle{"", {}};
  for (int n = 0; n <= 100; ++n)
    triangle.points.emplace_back(n, n <= 60 ? n / 60.0 : std::max(0.0, 1 - (n - 60) / 20.0));
  const LobeShape shape = shape_of(triangle);
  CHECK(shape.peak_deg == 60);
  CHECK(shape.width_deg == Approx(40));  // 30 to 70
  CHECK(value_at(triangle, 45.5) == Approx(45.5 / 60));
  Curve flat{"", {}};
  for (int n = 0; n <= 110; ++n) flat.points.emplace_back(n, 2.0);
  CHECK(share_behind(flat) == Approx(20.0 / 110));
  CHECK(kirchhoff_validity(2.27, 21.9, 20, 0.633) == Approx(21.9 / 0.633));
}

TEST_CASE("Two scales of roughness: one scale where they are one, a sum of variances where lengths agree",
          "[assess][comparisons]") {
  const Interface<double> perfect = perfect_interface<double>();
  for (const double to : {-20.0, 31.0, 60.0}) {
    const double whole = power_per_sr(BeckmannKirchhoff<double>{0.25, 4}, perfect, 30, to, 0.55);
    CHECK(two_scale_power_per_sr(0.25, 4, 0, 50, 30, to, 0.55) == Approx(whole).epsilon(1e-10));
    CHECK(two_scale_power_per_sr(0.15, 4, 0.2, 4, 30, to, 0.55) == Approx(whole).epsilon(1e-10));
  }
}

TEST_CASE("Published comparisons: the statements that do not hold are these", "[assess][comparisons]") {
  std::vector<Claim> all;
  for (const Comparison& c : published_comparisons()) all.insert(all.end(), c.claims.begin(), c.claims.end());
  CHECK(failing(all) == std::set<std::string>{"F of Nieto-Vesperinas, read literally, is as near",
                                              "… with + too, if θ_o is positive on the mirror side",
                                              "… and loses none towards grazing", "Dür's form conserves energy"});
}

TEST_CASE("MERL tables: quantiles and deviations from the median by hand", "[assess][comparisons]") {
  CHECK(quantile({3, 1, 2}, 0.5) == 2);
  CHECK(quantile({4, 1, 2, 3}, 0.5) == Approx(2.5));
  std::vector<MerlFit> fits(3);
  for (std::size_t n = 0; n < 3; ++n)
    fits[n].material = "x", fits[n].table = n, fits[n].f.fill(std::pow(10.0, static_cast<double>(n * n)));
  const auto deviations = merl_deviations(fits);  // decades 0, 1, 4
  CHECK(deviations[0].decades[2] == Approx(-1));
  CHECK(deviations[2].decades[2] == Approx(3));
}

TEST_CASE("MERL tables: what agrees and what does not", "[assess][comparisons][slow]") {
  const std::vector<MerlFit> fits = merl_fits();
  CHECK(fits.size() == 7 * 86 + 7 * 100);
  CHECK(failing(merl_claims(fits, merl_deviations(fits))) ==
        std::set<std::string>{"at the mirror direction too", "Lafortune's lobe follows Cook-Torrance's (Ngan's two)",
                              "… another lobe does too", "… and at 75°", "… at 10° if MERL's scale is π too small",
                              "MERL's scale is absolute: teflon reflects as PTFE does (0.99)"});
  double brightest = 0;
  for (const char* channel : {"r", "g", "b"})
    brightest = std::max(brightest, energy_on_a_grid(std::string("low-smooth/teflon/") + channel, 10));
  for (const MerlFit& fit : fits)
    if (fit.material == "teflon" && published_tables()[fit.table].name == "low-smooth")
      CHECK(fit.energy[0] == Approx(brightest).epsilon(1e-3));
}
