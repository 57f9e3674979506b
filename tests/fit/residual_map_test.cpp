#include "fit/residual_map.h"

#include "catch.h"
#include "fit/made_fit.h"

using namespace gonio;
using namespace gonio::test;

namespace {

/// Incidences every 5°, and azimuths where asked for.
FitResult fit_of(bool azimuths, double noise) {
  Measurement scan;
  scan.name = "a 'quoted' name_with^marks";
  for (double theta_i = 0; theta_i < 80; theta_i += 5)
    for (double theta_o = 0; theta_o < 80; theta_o += 10)
      for (double phi = 0; phi < 360; phi += azimuths ? 30 : 180) {
        ScanPoint p;
        p.theta_i_deg = theta_i, p.theta_o_deg = theta_o, p.phi_o_deg = phi, p.f_per_sr = 1;
        scan.points.push_back(p);
      }
  group_by_incidence(scan);
  FitResult result = made_fit(scan, lobe_sum("ggx"), {0.3, 0.3, 0.1, 0.5});
  add_noise(result, noise, 31);
  return result;
}

std::size_t count(const std::string& text, std::string_view words) {
  std::size_t found = 0;
  for (std::size_t at = text.find(words); at != text.npos; at = text.find(words, at + 1)) ++found;
  return found;
}

}  // namespace

TEST_CASE("A residual map has at most 12 panels, for cuts and for hemispheres, exact data too", "[fit][plots]") {
  for (const bool azimuths : {false, true})
    for (const double noise : {0.0, 0.1}) {
      const auto svg = residual_map_svg(fit_of(azimuths, noise));
      REQUIRE(svg);
      CHECK(svg->find("</svg>") != std::string::npos);
      CHECK(count(*svg, "= 75°") == 1);  // the last of 16 incidences is one of the 12
      CHECK(count(*svg, "°</tspan>") + count(*svg, "° </tspan>") >= 12);
      CHECK(*svg == *residual_map_svg(fit_of(azimuths, noise)));
    }
}

TEST_CASE("A map of nothing positive is none", "[fit][plots]") {
  FitResult result = fit_of(false, 0);
  for (FittedPoint& p : result.points) p.measured_per_sr = -1;
  CHECK_FALSE(residual_map_svg(result));
}
