// The leave-out errors against a sum by hand, and the defaults against what the errors say.
#include "assess/interpolation_error.h"

#include <cmath>

#include "base/error.h"
#include "catch.h"
#include "materials/interpolated_entry.h"

using namespace gonio;

TEST_CASE("Leave-out: every second point, predicted, relative to the range", "[assess]") {
  // Squares at 0 … 12: linear between even points misses each odd one by 1; the range is 144.
  std::vector<double> x, y;
  for (int i = 0; i <= 12; ++i) x.push_back(i), y.push_back(i * i);
  const LeaveOutError linear = leave_out_error(x, y, Interpolation::linear);
  CHECK(linear.kept == 7);
  CHECK(linear.predicted == 6);
  CHECK(linear.max == Approx(1.0 / 144));
  CHECK(linear.rms == Approx(1.0 / 144));
  CHECK(leave_out_error(x, y, Interpolation::barycentric_rational).max < 1e-13);
  x.push_back(13), y.push_back(1e6);  // a left-out point beyond the last one kept is not predicted
  CHECK(leave_out_error(x, y, Interpolation::linear).predicted == 6);
}

TEST_CASE("Leave-out: the default of each class is what its errors justify", "[assess]") {
  const std::vector<ClassError> classes = errors_by_class(leave_out_errors(Database::bundled()));
  int judged = 0;
  for (const ClassError& best : classes) {
    if (best.equidistant) continue;
    for (const ClassError& own : classes)
      if (!own.equidistant && own.data_class == best.data_class &&
          own.variant == default_interpolation(own.data_class)) {
        INFO(own.data_class << ": " << name_of(own.variant) << " against " << name_of(best.variant));
        CHECK(own.median_rms <= 1.02 * best.median_rms);
        ++judged;
      }
  }
  CHECK(judged == 45);  // nine classes, five variants
}

TEST_CASE("A value between an entry's points by any variant; beyond them only when asked, and marked", "[assess]") {
  const Entry& gold = Database::bundled().find("Au_Johnson");
  for (const Interpolation variant : {Interpolation::linear, Interpolation::akima, Interpolation::natural_cubic}) {
    CHECK(interpolated(gold, gold.wavelength_nm[20], 0, variant).value == gold.columns[0][20]);
    CHECK_FALSE(interpolated(gold, 550, 1, variant).extrapolated);
  }
  CHECK(interpolated(gold, 550, 1, Interpolation::linear).value == Approx(gold.at(550, 1)).epsilon(1e-14));
  CHECK_THROWS_AS(interpolated(gold, 5000, 0, Interpolation::linear), InputError);
  const Interpolated beyond = interpolated(gold, 5000, 0, Interpolation::linear, Extension::nearest);
  CHECK(beyond.extrapolated);
  CHECK(beyond.value == gold.columns[0].back());
  Entry step = gold;  // a natural cubic swings below 0 beside a step; k does not
  for (std::size_t i = 0; i < step.columns[1].size(); ++i) step.columns[1][i] = i < 20 ? 0 : 1;
  for (double nm = step.range_lo_nm; nm < step.range_hi_nm; nm += 1.7)
    CHECK(interpolated(step, nm, 1, Interpolation::natural_cubic).value >= 0);
  const Entry& glass = Database::bundled().find("N-BK7_SCHOTT");  // a formula stays a formula
  CHECK(interpolated(glass, 587.6, 0, Interpolation::akima).value == glass.at(587.6));
  CHECK_THROWS_AS(interpolated(glass, 1e6, 0, Interpolation::akima, Extension::linear), InputError);
}
