// Every ColorChecker patch under every bundled light, both observers, against a summation written here.
#include <cmath>

#include "catch.h"
#include "materials/color_entries.h"
#include "spectrum/colorimetry.h"

using namespace gonio;

namespace {

/// Linear between the points around nm, walking from the front: nothing shared with the library.
double between(const std::vector<double>& x, const std::vector<double>& y, int nm) {
  std::size_t i = 0;
  while (i + 2 < x.size() && x[i + 1] < nm) ++i;
  return y[i] + (y[i + 1] - y[i]) * (nm - x[i]) / (x[i + 1] - x[i]);
}

/// An entry's column at the whole nanometres from 1 to 999 within its table; NaN elsewhere.
std::vector<double> tabulate(const Entry& entry, std::size_t column) {
  std::vector<double> values(1000, std::nan(""));
  for (int nm = 1; nm < 1000; ++nm)
    if (nm >= entry.wavelength_nm.front() && nm <= entry.wavelength_nm.back())
      values[nm] = between(entry.wavelength_nm, entry.columns[column], nm);
  return values;
}

}  // namespace

TEST_CASE("Every ColorChecker patch under every light, both observers: 1e-9 of an independent sum", "[spectrum]") {
  std::vector<const Entry*> lights, patches;
  for (const Entry* entry : Database::bundled().all()) {
    if (entry->kind == "illuminant") lights.push_back(entry);
    if (entry->id.starts_with("colorchecker-ohta")) patches.push_back(entry);
  }
  REQUIRE(patches.size() == 24);
  REQUIRE(lights.size() >= 100);
  double worst = 0;
  for (const char* observer : {"1931-2", "1964-10"}) {
    const Entry& eye = Database::bundled().find(observer);
    const std::vector<double> x = tabulate(eye, 0), y = tabulate(eye, 1), z = tabulate(eye, 2);
    for (const Entry* light : lights) {
      const std::vector<double> power = tabulate(*light, 0);
      for (const Entry* patch : patches) {
        const std::vector<double> r = tabulate(*patch, 0);
        double sum_x = 0, sum_y = 0, sum_z = 0, white = 0;
        for (int nm = 1; nm < 1000; ++nm) {
          if (std::isnan(power[nm]) || std::isnan(r[nm]) || std::isnan(y[nm])) continue;
          sum_x += power[nm] * x[nm] * r[nm], sum_y += power[nm] * y[nm] * r[nm], sum_z += power[nm] * z[nm] * r[nm];
          white += power[nm] * y[nm];
        }
        const Xyz<double> found = color_of(factor_of(patch->id), light_of(*light), observer_of(eye), true).xyz;
        worst =
            std::max({worst, std::abs(found.x / (100 * sum_x / white) - 1),
                      std::abs(found.y / (100 * sum_y / white) - 1), std::abs(found.z / (100 * sum_z / white) - 1)});
      }
    }
  }
  INFO(lights.size() << " lights, worst relative difference " << worst);
  CHECK(worst < 1e-9);
}
