// What `gonio assess speed fit` compares are the same residuals, and its loops come to the same end.
#include "assess/fit_speed_rows.h"
#include "base/error.h"
#include "catch.h"
#include "fit/start.h"

using namespace gonio;

TEST_CASE("Lanes, Jets and differences see the same residuals and slopes", "[assess][fit]") {
  for (const char* name : {"torrance-sparrow", "ggx", "beckmann-kirchhoff"})
    for (const Metric metric : {Metric::log, Metric::linear, Metric::cuberoot}) {
      const FitSamples samples = fit_samples({name, metric, 60, 3});
      std::vector<double> x = samples.truth;
      for (double& one : x) one += 0.2;
      const Linearised lanes = linearise(samples.problem, x),
                       jet = linearise_with_ceres(samples.problem, x, Derivatives::jet),
                       numeric = linearise_with_ceres(samples.problem, x, Derivatives::numeric);
      INFO(name << " " << name_of(metric));
      REQUIRE(lanes.finite);
      REQUIRE(jet.finite);
      const double residual = jet.residual.cwiseAbs().maxCoeff(), slope = jet.jacobian.cwiseAbs().maxCoeff();
      CHECK((lanes.residual - jet.residual).cwiseAbs().maxCoeff() < 1e-9 * residual);
      CHECK((numeric.residual - jet.residual).cwiseAbs().maxCoeff() < 1e-12 * residual);
      CHECK((lanes.jacobian - jet.jacobian).cwiseAbs().maxCoeff() < 1e-8 * slope);
      CHECK((numeric.jacobian - jet.jacobian).cwiseAbs().maxCoeff() < 1e-5 * slope);
    }
}

TEST_CASE("All three kinds of derivatives reach the same minimum", "[assess][fit]") {
  const FitSamples samples = fit_samples({"ggx", Metric::log, 120, 2});
  const Solution lanes = solve_starts(samples.problem, 2).best;
  for (const Derivatives derivatives : {Derivatives::jet, Derivatives::numeric}) {
    const Solution other = solve_starts(samples.problem, 2, derivatives).best;
    INFO(name_of(derivatives));
    CHECK(other.cost == Approx(lanes.cost).epsilon(1e-7));
    for (std::size_t i = 0; i < lanes.x.size(); ++i) CHECK(other.x[i] == Approx(lanes.x[i]).margin(1e-3));
  }
}

TEST_CASE("Samples without noise give back their truth, in every way they are fitted", "[assess][fit]") {
  FitCase wanted{"torrance-sparrow", Metric::log, 100, 4, 0};
  for (const bool own : {false, true}) {
    wanted.own_scales = own;
    const FitSamples samples = fit_samples(wanted);
    CHECK(samples.problem.free.size() == (own ? 9 : 3));
    const ManyStarts found = solve_starts(samples.problem, 3, Derivatives::lanes, kPolish);
    CHECK(parameter_error(samples, found.best.x) < 1e-6);
    CHECK(rms_of(samples.problem, found.best) < 1e-8);
    CHECK(found.agreeing >= 1);
  }
}

TEST_CASE("Many samples: the starts solved on some of them end where gonio fit ends", "[assess][fit]") {
  const FitSamples samples = fit_samples({"torrance-sparrow", Metric::log, 8000});
  const ManyStarts found = solve_starts(samples.problem, 4);
  CHECK(found.agreeing == 4);
  const FitResult whole = fit(samples.scan, samples.request);
  CHECK(std::exp(found.best.x[0]) == Approx(whole.value("m")).epsilon(1e-6));
  CHECK(rms_of(samples.problem, found.best) == Approx(whole.all.rms).epsilon(1e-9));
  CHECK(parameter_error(samples, found.best.x) < 0.01);  // 2 % noise over 8000 samples
}

TEST_CASE("What Ceres is not set up for is refused, not fitted as something else", "[assess][fit]") {
  const FitSamples samples = fit_samples({"he-1991", Metric::log, 20});
  CHECK_THROWS_AS(linearise_with_ceres(samples.problem, samples.truth, Derivatives::jet), InputError);
}

TEST_CASE("Rows say what was timed", "[assess][fit]") {
  const FitSpeedRow row = timed_fit("small", fit_samples({"ggx", Metric::linear, 80}), 2, 1, Derivatives::jet, 1e-8, 1);
  CHECK(row.model == "ggx");
  CHECK(row.samples == 80);
  CHECK(row.starts == 2);
  CHECK(row.ms > 0);
  CHECK(row.parameter_error < 1);
}
