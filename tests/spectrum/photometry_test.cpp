// Photometry against the candela's own definitions and published ratios.
#include "spectrum/photometry.h"

#include "base/error.h"
#include "catch.h"
#include "materials/color_entries.h"

using namespace gonio;

namespace {

Spectrum column(std::string_view id) {
  const Entry& entry = Database::bundled().find(id);
  return {entry.wavelength_nm, entry.columns[0]};
}

/// One watt within a nanometre or so.
Spectrum line(double nm) { return {{nm - 1, nm, nm + 1}, {0, 1, 0}}; }

/// Spectral radiance of a black body in W/(m²·sr·nm).
double planck_radiance(double nm, double kelvin) {
  const double m = nm * 1e-9;
  return 1.191042972e-16 / std::pow(m, 5) / std::expm1(1.438776877e-2 / (m * kelvin)) * 1e-9;
}

}  // namespace

TEST_CASE("A watt at 555 nm carries K_m lumens, at 507 nm K'_m scotopic ones", "[spectrum]") {
  CHECK(photopic(line(555), column("V")) == Approx(683.002).epsilon(1e-6));
  CHECK(scotopic(line(507), column("V-prime")) == Approx(1700).epsilon(1e-6));
  CHECK(scotopic(line(555), column("V-prime")) == Approx(683).epsilon(2e-3));  // where the two meet, by definition
  CHECK(radiant(line(555)) == 1);
}

TEST_CASE("The candela of 1948: a black body at platinum's freezing point has 60 cd/cm²", "[spectrum]") {
  Spectrum radiance;
  for (double nm = 300; nm <= 900; ++nm)
    radiance.wavelength_nm.push_back(nm), radiance.value.push_back(planck_radiance(nm, 2042));
  CHECK(photopic(radiance, column("V")) == Approx(60e4).epsilon(5e-3));
}

TEST_CASE("Scotopic over photopic of the standard lights", "[spectrum]") {
  const auto ratio = [](std::string_view light) {
    const LuminousEfficacy e = luminous_efficacy(column(light), column("V"), column("V-prime"));
    return e.scotopic_lm_per_w / e.photopic_lm_per_w;
  };
  CHECK(ratio("A") == Approx(1.41).margin(0.01));  // CIE 191:2010 and lighting tables
  CHECK(ratio("D65") == Approx(2.47).margin(0.02));
  CHECK(ratio("E") == Approx(1700 * 97.07 / (683.002 * 106.857)).epsilon(2e-3));
}

TEST_CASE("Absolute XYZ: Y is the photopic quantity; relative XYZ has its chromaticity", "[spectrum]") {
  const Spectrum light = column("D65");
  const Observer eye = observer_of(Database::bundled().find("1931-2"));
  const Xyz<double> absolute = absolute_xyz(light, eye);
  CHECK(absolute.y == Approx(luminous(light, {eye.wavelength_nm, eye.ybar}, 683.002)).epsilon(1e-14));
  CHECK(absolute.y == Approx(photopic(light, column("V"))).epsilon(1e-4));
  const Factor white{0, 1e9, [](double) { return 1.0; }};
  const Xyz<double> relative = color_of(white, light, eye).xyz;
  CHECK(relative.x / relative.y == Approx(absolute.x / absolute.y).epsilon(1e-13));
  CHECK(relative.z / relative.y == Approx(absolute.z / absolute.y).epsilon(1e-13));
}

TEST_CASE("Radiometric from photometric and back", "[spectrum]") {
  Spectrum shape = column("A");
  const double scale = radiometric_scale(shape, column("V"), kPhotopicEfficacy, 800);  // an 800 lm lamp
  for (double& value : shape.value) value *= scale;
  CHECK(photopic(shape, column("V")) == Approx(800).epsilon(1e-13));
  CHECK_THROWS_AS(radiometric_scale({{900, 1000}, {1, 1}}, column("V"), kPhotopicEfficacy, 800), InputError);
  CHECK_THROWS_AS(radiometric_scale({{400, 500}, {0, 0}}, column("V"), kPhotopicEfficacy, 800), InputError);
}
