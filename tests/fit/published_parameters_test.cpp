// The published MERL fits evaluate with our models; some rows by hand.
#include "fit/published_parameters.h"

#include <cmath>

#include "base/error.h"
#include "brdf/brdf.h"
#include "catch.h"

using namespace gonio;

namespace {

double value(const PublishedFit& fit, const Directions<double>& w) {
  return evaluate(make_brdf<double>(fit.spec, fit.values), w, fit.surface, 1.0);
}

}  // namespace

TEST_CASE("Every row of every published table evaluates finite and non-negative", "[published]") {
  std::size_t rows = 0;
  for (const PublishedTable& table : published_tables()) {
    DYNAMIC_SECTION(table.name) {
      for (const PublishedFit& fit : read_published(table)) {
        ++rows;
        for (const double theta_i : {0.0, 30.0, 75.0, 89.0})
          for (const double theta_o : {0.0, 31.0, 75.0, 88.0})
            for (const double phi : {0.0, 90.0, 180.0}) {
              const double f = value(fit, directions_from_deg(theta_i, theta_o, phi));
              INFO(fit.material << " " << fit.channel << " at " << theta_i << " " << theta_o << " " << phi << ": "
                                << f);
              REQUIRE(std::isfinite(f));
              REQUIRE(f >= 0);
            }
      }
      CHECK(rows == (table.name.starts_with("ngan") ? 258u : 300u));
    }
  }
}

// By hand in 40 digits (mpmath) from the printed formulas and the printed parameters, with half vectors and angles of the
// textbook: theta_i 30, theta_o 40, phi 175 degrees, green.
TEST_CASE("Published rows by hand", "[published]") {
  struct Row {
    const char* path;
    double f;
  };
  const Directions<double> w = directions_from_deg(30.0, 40.0, 175.0);
  const Row rows[] = {{"ngan-ward/black-oxidized-steel/g", 0.06246698875616746},
                      {"ngan-ward-duer/black-oxidized-steel/g", 0.0624771114803749},
                      {"ngan-blinn-phong/black-oxidized-steel/g", 0.04866653498589481},
                      {"ngan-cook-torrance/black-oxidized-steel/g", 0.02657123512551738},
                      {"ngan-ashikhmin-shirley/black-oxidized-steel/g", 0.02855757371392211},
                      {"ngan-lafortune/black-oxidized-steel/g", 0.007061893252676671},
                      {"ngan-ward/gold-metallic-paint3/g", 0.3360802031131358},
                      {"ngan-ward-duer/gold-metallic-paint3/g", 0.2589117049335281},
                      {"ngan-blinn-phong/gold-metallic-paint3/g", 0.3295970987332499},
                      {"ngan-cook-torrance/gold-metallic-paint3/g", 0.3482459078869693},
                      {"ngan-ashikhmin-shirley/gold-metallic-paint3/g", 0.273638723090191},
                      {"ngan-lafortune/gold-metallic-paint3/g", 0.3135474639743758},
                      {"low-cook-torrance-e1/alum-bronze/g", 0.02597408671302849},
                      {"low-ashikhmin-shirley-e1/alum-bronze/g", 0.02594225572504152},
                      {"low-cook-torrance-e2/alum-bronze/g", 0.1349183415367383},
                      {"low-ashikhmin-shirley-e2/alum-bronze/g", 0.1432921361743117},
                      {"low-smooth/alum-bronze/g", 0.1231580168012673},
                      {"low-microfacet/alum-bronze/g", 0.1269584559495411},
                      {"bagher-sgd/alum-bronze/g", 0.2779595297704062},
                      {"low-cook-torrance-e1/blue-rubber/g", 0.04017863067398931},
                      {"low-ashikhmin-shirley-e1/blue-rubber/g", 0.04023096507774323},
                      {"low-cook-torrance-e2/blue-rubber/g", 0.03989390502207123},
                      {"low-ashikhmin-shirley-e2/blue-rubber/g", 0.04003174256468549},
                      {"low-smooth/blue-rubber/g", 0.03939510623150604},
                      {"low-microfacet/blue-rubber/g", 0.04132141229290583},
                      {"bagher-sgd/blue-rubber/g", 0.04003240353762762},
                      {"low-cook-torrance-e1/aluminium/g", 0.02960281941509253},
                      {"low-ashikhmin-shirley-e1/aluminium/g", 0.02953915743785577},
                      {"low-cook-torrance-e2/aluminium/g", 0.01304974327816259},
                      {"low-ashikhmin-shirley-e2/aluminium/g", 0.01302283293827173},
                      {"low-smooth/aluminium/g", 0.1672017504257176},
                      {"low-microfacet/aluminium/g", 0.1572804437783569},
                      {"bagher-sgd/aluminium/g", 0.01168305113410725}};
  for (const Row& row : rows) {
    INFO(row.path);
    CHECK(value(published_fit(row.path), w) == Approx(row.f).epsilon(1e-10));
  }
}

TEST_CASE("A published row that is not there is refused", "[published]") {
  CHECK_THROWS_AS(published_fit("ngan-ward"), InputError);
  CHECK_THROWS_AS(published_fit("ngan-phong/brass/g"), InputError);
  CHECK_THROWS_AS(published_fit("ngan-lafortune/unobtainium/g"), InputError);
  CHECK_THROWS_AS(published_fit("ngan-lafortune/brass/x"), InputError);
}
