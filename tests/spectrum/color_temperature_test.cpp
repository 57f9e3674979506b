// Correlated colour temperature against the radiator itself and CIE's published values.
#include "spectrum/color_temperature.h"

#include "catch.h"
#include "materials/color_entries.h"

using namespace gonio;

namespace {

const Observer& eye() {
  static const Observer observer = observer_of(Database::bundled().find("1931-2"));
  return observer;
}

ColorTemperature of_light(std::string_view id) {
  const Factor white{0, 1e9, [](double) { return 1.0; }};
  return color_temperature(color_of(white, light_of(Database::bundled().find(id)), eye(), true).white, eye());
}

}  // namespace

TEST_CASE("A black body has its own temperature; off the locus, the foot's", "[spectrum]") {
  for (const double kelvin : {1200.0, 1667.0, 2856.0, 4000.0, 6504.0, 10000.0, 25000.0, 60000.0}) {
    INFO(kelvin << " K");
    const Chromaticity<double> on = planckian_ucs(kelvin, eye());
    const ColorTemperature found = color_temperature(on, eye());
    CHECK(found.kelvin == Approx(kelvin).epsilon(1e-6));
    CHECK(found.duv == Approx(0).margin(1e-8));
    CHECK((found.meaningful && !found.at_the_end));
    const Chromaticity<double> ahead = planckian_ucs(kelvin * (1 - 1e-5), eye()),
                               behind = planckian_ucs(kelvin * (1 + 1e-5), eye());
    const double du = ahead.x - behind.x, dv = ahead.y - behind.y, length = std::hypot(du, dv);
    for (const double duv : {0.01, -0.01}) {  // across the locus, v up (du > 0: towards lower temperature)
      const ColorTemperature beside =
          color_temperature(Chromaticity<double>{on.x - duv * dv / length, on.y + duv * du / length}, eye());
      CHECK(beside.kelvin == Approx(kelvin).epsilon(2e-4));
      CHECK(beside.duv == Approx(duv).epsilon(1e-5));
    }
  }
}

TEST_CASE("Colour temperatures CIE publishes for its illuminants", "[spectrum]") {
  // CIE 015:2018, tables of illuminants; A is 2856 K on c2 = 1.435e-2 m·K rescaled, i.e. 2855.5 K.
  CHECK(of_light("A").kelvin == Approx(2848 * 1.438776877 / 1.435).margin(0.1));
  CHECK(of_light("A").duv == Approx(0).margin(1e-5));
  CHECK(of_light("D65").kelvin == Approx(6504).margin(3));
  CHECK(of_light("D65").duv == Approx(0.0032).margin(1e-4));
  CHECK(of_light("D50").kelvin == Approx(5003).margin(3));
  CHECK(of_light("C").kelvin == Approx(6774).margin(5));
  CHECK(of_light("E").kelvin == Approx(5455).margin(3));
}

TEST_CASE("Ohno's example", "[spectrum]") {
  // u, v = 0.1978, 0.3122: 6507 K, Duv 0.00322 (Y. Ohno, LEUKOS 10, 47-55 (2014), as computed by published programs).
  const ColorTemperature found = color_temperature(Chromaticity<double>{0.1978, 0.3122}, eye());
  CHECK(found.kelvin == Approx(6507.5).margin(1.5));
  CHECK(found.duv == Approx(0.003223).margin(2e-6));
}

TEST_CASE("Where the notion ends it says so", "[spectrum]") {
  const ColorTemperature green = color_temperature(Xyz<double>{20, 60, 10}, eye());
  CHECK(green.duv > 0.05);
  CHECK_FALSE(green.meaningful);
  const ColorTemperature red = color_temperature(Xyz<double>{60, 25, 0}, eye());
  CHECK(red.at_the_end);
  CHECK_FALSE(red.meaningful);
  CHECK(of_light("D65").meaningful);
}
