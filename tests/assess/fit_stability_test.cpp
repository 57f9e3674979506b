// Maps and atlas of `gonio assess stability fit`, small: what must be recovered is, and known failures are reported as such.
#include "assess/fit_stability.h"

#include <algorithm>

#include "catch.h"

using namespace gonio;

namespace {

const Misled& entry(const std::vector<Misled>& atlas, std::string_view name) {
  const auto at = std::find_if(atlas.begin(), atlas.end(), [&](const Misled& m) { return m.name == name; });
  REQUIRE(at != atlas.end());
  return *at;
}

bool outside(const Misled& m, std::string_view name) {
  return std::any_of(m.parameters.begin(), m.parameters.end(),
                     [&](const MisledParameter& p) { return p.name == name && p.outside(); });
}

bool says(const Misled& m, std::string_view words) {
  return std::any_of(m.warnings.begin(), m.warnings.end(),
                     [&](const std::string& w) { return w.find(words) != w.npos; });
}

}  // namespace

TEST_CASE("Recovery: little noise gives the parameters back, much does not", "[assess][fit]") {
  for (const char* name : {"torrance-sparrow", "ggx"}) {
    const RecoveryMap map = recovery_map(name, RecoverySweep::noise, 3, 2, 3);
    const RecoveryCell &quiet = map.cells[1], &loud = map.cells[4];  // roughness 0.1; noise 0.1 % and a factor e
    INFO(name << " " << quiet.decades << " " << loud.decades);
    CHECK(quiet.decades < 0.01);
    CHECK(quiet.recovered());
    CHECK(quiet.share_silent == 0);
    CHECK(loud.decades > kFailedDecades);
    CHECK_FALSE(loud.recovered());
  }
}

TEST_CASE("Recovery: steps wider than the lobe lose it", "[assess][fit]") {
  const RecoveryMap map = recovery_map("torrance-sparrow", RecoverySweep::step, 2, 2, 2);
  CHECK(map.cells[1].recovered());        // m = 1, half a degree
  CHECK_FALSE(map.cells[2].recovered());  // m = 0.01, 16 degrees that miss the mirror direction
}

TEST_CASE("Basins: the search brings nearly every start to the best minimum", "[assess][fit]") {
  for (const char* name : {"beckmann-kirchhoff", "cook-torrance-1981-two-widths"}) {
    const BasinMap map = basin_map(name, 7, 7);
    REQUIRE(map.plain.size() == 49);
    REQUIRE_FALSE(map.minima.empty());
    const double least = map.minima.front().rms;
    CHECK(least == Approx(0.02).epsilon(0.2));  // the noise
    int at_least = 0, counted = 0;
    for (const BasinMap::Minimum& m : map.minima) {
      if (m.rms < least * (1 + 1e-3)) at_least += m.improved;  // two widths may change places
      counted += m.plain;
    }
    INFO(name << ": " << at_least);
    CHECK(at_least >= 44);
    CHECK(counted == std::count_if(map.plain.begin(), map.plain.end(), [](int m) { return m >= 0; }));
  }
}

TEST_CASE("Recovery: ggx seen in the plane of incidence and across it gives back both widths", "[assess][fit]") {
  for (const RecoveryCell& cell : recovery_map("ggx", RecoverySweep::step, 2, 2, 1).cells)
    if (cell.x < -1 && cell.y < 0) CHECK(cell.recovered());
}

TEST_CASE("Atlas: each flaw misleads the parameter it must, and silence is called silence", "[assess][fit]") {
  const std::vector<Misled> atlas = failure_atlas();
  CHECK(atlas.size() >= 5);
  for (const Misled& m : atlas) {
    INFO(m.name);
    CHECK(m.noticed() == (!m.warnings.empty() || !m.result.converged));
    CHECK(m.parameters.size() == m.result.parameters.size());
  }
  CHECK(outside(entry(atlas, "aperture"), "m"));  // wider than the surface's lobe
  CHECK(entry(atlas, "aperture").result.value("m") > 0.02);
  CHECK(outside(entry(atlas, "narrow-hit"), "ks"));    // only ks/m² is seen
  CHECK(says(entry(atlas, "narrow-hit"), "points an incidence"));
  CHECK_FALSE(entry(atlas, "stray-light").noticed());  // no fit could: it is a diffuse part
  CHECK(entry(atlas, "stray-light").explained());
  CHECK_FALSE(entry(atlas, "wrong-material").noticed());
  CHECK(says(entry(atlas, "narrow"), "no point within 5 degrees of the mirror direction"));
  CHECK(outside(entry(atlas, "saturated"), "m"));
  CHECK(says(entry(atlas, "saturated"), "the detector may have been at its end"));
  CHECK(outside(entry(atlas, "stray-light"), "kd"));
  CHECK(entry(atlas, "stray-light").result.value("kd") == Approx(0.01 + kPi<double> * 0.02).epsilon(0.1));
  CHECK(says(entry(atlas, "wrong-model"), "does not explain these data"));
  CHECK(entry(atlas, "wrong-model").noticed());
}
