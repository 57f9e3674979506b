// Correlated colour temperatures of the lamps CIE tabulates.
#include "catch.h"
#include "materials/color_entries.h"
#include "spectrum/color_temperature.h"

using namespace gonio;

TEST_CASE("Fluorescent, high-pressure and LED lamps: the temperatures CIE 015:2018 prints", "[spectrum]") {
  struct Row {
    const char* light;
    double kelvin;
  };
  const Row rows[] = {{"FL1", 6430},    {"FL2", 4230},    {"FL3", 3450},     {"FL4", 2940},      {"FL5", 6350},
                      {"FL6", 4150},    {"FL7", 6500},    {"FL8", 5000},     {"FL9", 4150},      {"FL10", 5000},
                      {"FL11", 4000},   {"FL12", 3000},   {"HP1", 1959},     {"HP2", 2506},      {"HP3", 3144},
                      {"HP4", 4002},    {"HP5", 4039},    {"LED-B1", 2733},  {"LED-B2", 2998},   {"LED-B3", 4103},
                      {"LED-B4", 5109}, {"LED-B5", 6598}, {"LED-BH1", 2851}, {"LED-RGB1", 2840}, {"LED-V1", 2724},
                      {"LED-V2", 4070}};
  const Observer eye = observer_of(Database::bundled().find("1931-2"));
  const Factor white{0, 1e9, [](double) { return 1.0; }};
  for (const Row& row : rows) {
    INFO(row.light);
    const Entry& light = Database::bundled().find(row.light);
    const ColorTemperature found = color_temperature(color_of(white, light_of(light), eye, true).white, eye);
    CHECK(found.kelvin == Approx(row.kelvin).epsilon(0.002));
  }
}
