// What the charts of Kramers-Kronig on cut bands say, held.
#include "assess/kramers_kronig_cut.h"

#include <map>

#include "catch.h"

using namespace gonio;

TEST_CASE(
    "Eleven closed-form metals: exact over the whole band, off by tens of per cent when cut, never outside the "
    "interval",
    "[assess][slow]") {
  std::map<std::string, double> mean, worst;
  for (const CutRow& row : drude_lorentz_cuts()) {
    INFO(row.metal << " " << row.band.name);
    CHECK(row.share_held == Approx(1).epsilon(1e-12));
    mean[row.band.name] += row.median / 11, worst[row.band.name] = std::max(worst[row.band.name], row.worst);
  }
  CHECK(worst["whole"] < 1e-4);
  for (const char* band : {"200-2000", "300-1100", "360-830"}) CHECK(worst[band] > 0.3);
  CHECK(mean["360-830 & 589.3"] < 0.4 * mean["360-830"]);
}

TEST_CASE("Tabulated metals fail alike and stay within the interval", "[assess][slow]") {
  for (const CutRow& row : tabulated_cuts()) {
    INFO(row.metal << " " << row.band.name);
    CHECK(row.share_held == Approx(1).epsilon(1e-12));
    CHECK(row.worst > 0.01);
  }
}

TEST_CASE("The decay assumed by default is the one of least error", "[assess][slow]") {
  std::map<std::string, std::pair<double, double>> best;  // error, exponent
  for (const DecayRow& row : decay_exponents())
    if (row.band != "200-2000" && (!best.contains(row.band) || row.mean_error < best[row.band].first))
      best[row.band] = {row.mean_error, row.decay_exponent};
  REQUIRE(best.size() == 2);
  for (const auto& [band, least] : best) CHECK(least.second == KramersKronigAssumption{}.decay_exponent);
}
