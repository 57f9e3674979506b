// Profile-likelihood intervals: Student's where the problem is linear, better than the curvature's where it is skewed.
#include "fit/profile_likelihood.h"

#include <tbb/parallel_for.h>

#include <atomic>
#include <memory>

#include "catch.h"
#include "fit/start.h"
#include "fit/uncertainty.h"
#include "synthetic.h"

using namespace gonio;
using namespace gonio::test;

namespace {

/// A scan of few points: one incidence angle, the plane of incidence.
Measurement few_points(double theta_i_deg, std::vector<double> angles_deg) {
  Measurement scan;
  scan.id = "few", scan.wavelength_nm = 550, scan.incidences_deg = {theta_i_deg};
  for (const double angle : angles_deg) {
    ScanPoint point;
    point.theta_i_deg = theta_i_deg, point.theta_o_deg = std::abs(angle), point.phi_o_deg = angle < 0 ? 0 : 180;
    point.wavelength_nm = 550, point.f_per_sr = 1;
    scan.points.push_back(point);
  }
  return scan;
}

FitRequest request_of(std::string_view name, std::map<std::string, double> held = {}) {
  FitRequest request;
  request.model = spec_of(name), request.starts = 4, request.material = "perfect", request.held = std::move(held);
  request.hold_out = HoldOut::none, request.floor_per_sr = 0;
  return request;
}

}  // namespace

TEST_CASE("a profile is Student's interval where residuals are linear in the logarithm", "[fit][profile]") {
  // ln f = ln kd - ln pi: linear in ln kd.
  const Measurement scan =
      synthetic(empty_scan(20), spec_of("lambert"), std::vector<double>{0.5}, perfect_interface<double>(), 0.3, 7);
  FitRequest request = request_of("lambert");
  const FitResult student = fit(scan, request);
  request.profile_intervals = true;
  const FitResult profile = fit(scan, request);
  CHECK(student.parameters[0].interval95_kind == "curvature");
  CHECK(profile.parameters[0].interval95_kind == "profile");
  CHECK(profile.parameters[0].lo95 == Approx(student.parameters[0].lo95).epsilon(1e-6));
  CHECK(profile.parameters[0].hi95 == Approx(student.parameters[0].hi95).epsilon(1e-6));
  CHECK_FALSE(profile.parameters[0].lo_open);
  CHECK_FALSE(profile.parameters[0].hi_open);
}

TEST_CASE("a profile is Student's interval of the value itself where f is linear in it", "[fit][profile]") {
  // Linear metric, kd and ks free, m held: a linear problem in kd and ks, whose Student's intervals are symmetric in them.
  const Measurement scan = synthetic(empty_scan(20), spec_of("torrance-sparrow"), std::vector<double>{0.3, 0.2, 0.5},
                                     perfect_interface<double>(), 0.1, 11);
  FitRequest request = request_of("torrance-sparrow", {{"m", 0.3}});
  request.metric = Metric::linear;
  request.profile_intervals = true;
  const FitResult result = fit(scan, request);
  const Prepared ready = prepare(scan, request, *std::make_unique<FitResult>());
  const Solution best = solve(ready.problem, {std::log(result.value("kd")), std::log(result.value("ks"))});
  const Uncertainty errors = uncertainty(ready.problem, best);
  for (std::size_t i = 0; i < 2; ++i) {
    const FittedParameter& p = *result.find(ready.problem.free[i].name);
    const double half = errors.t95 * errors.standard_error[i] * p.value;  // of the value: d value = value · d ln
    INFO(p.name);
    CHECK(p.lo95 == Approx(p.value - half).epsilon(1e-5));
    CHECK(p.hi95 == Approx(p.value + half).epsilon(1e-5));
  }
}

TEST_CASE("with small errors every profile nears the curvature, n's among them", "[fit][profile]") {
  const Measurement scan = synthetic(empty_scan(5), spec_of("torrance-sparrow"), std::vector<double>{0.25, 0.1, 0.8},
                                     Interface<double>{1.7, 0.0}, 0.002, 13);
  FitRequest request = request_of("torrance-sparrow");
  request.material.reset(), request.free_n = true;
  const FitResult curvature = fit(scan, request);
  request.profile_intervals = true;
  const FitResult profile = fit(scan, request);
  REQUIRE(profile.parameters.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) {
    const FittedParameter &p = profile.parameters[i], &c = curvature.parameters[i];
    const double half = 0.5 * (c.hi95 - c.lo95);
    INFO(p.name << ": " << p.lo95 << " to " << p.hi95 << ", by curvature " << c.lo95 << " to " << c.hi95);
    CHECK(p.interval95_kind == "profile");
    CHECK(p.lo95 == Approx(c.lo95).margin(0.1 * half));
    CHECK(p.hi95 == Approx(c.hi95).margin(0.1 * half));
  }
}

TEST_CASE("a profile that leaves the box is open there", "[fit][profile]") {
  // Two wide lobes told apart by nothing but a few noisy points near the normal: m has no upper end.
  const Measurement scan = synthetic(few_points(0, {0, 5, 10, 15, 20}), spec_of("torrance-sparrow"),
                                     std::vector<double>{0.6, 0.0, 0.9}, perfect_interface<double>(), 0.3, 3);
  FitRequest request = request_of("torrance-sparrow", {{"kd", 0.0}});
  request.profile_intervals = true;
  const FitResult result = fit(scan, request);
  const FittedParameter& m = *result.find("m");
  CHECK(m.interval95_kind == "profile");
  CHECK(m.hi_open);
  CHECK(m.hi95 == Approx(1.0));  // the box's end
  CHECK(m.lo95 < m.value);
}

TEST_CASE("few noisy points: a profile misses the truth on both sides alike, as it says", "[fit][profile][slow]") {
  // Oren and Nayar's sigma enters by its square: an interval that is symmetric in the logarithm is too short below and too long
  // above. Of 1,000 repeats a true 95 % misses 25 on either side: outside [10, 40] by chance with probability 0.002; fixed seeds.
  constexpr int kRepeats = 1000;
  const std::vector<double> truth{0.15, 0.0, 0.7};
  const ModelSpec spec = spec_of("oren-nayar");
  const Measurement clean = few_points(60, {-75, -60, -45, -30, 0, 30, 60, 75});
  struct Misses {
    std::atomic<int> below = 0, above = 0;  ///< of the truth: how often the interval lies wholly on that side
    void count(const FittedParameter& p, double value) { below += p.hi95<value, above += p.lo95> value; }
    int uneven() const { return std::abs(below - 25) + std::abs(above - 25); }
  } curvature, profile;
  tbb::parallel_for(0, kRepeats, [&](int repeat) {
    const auto seed = static_cast<std::uint64_t>(90000 + repeat);
    const Measurement scan = synthetic(clean, spec, truth, perfect_interface<double>(), 0.07, seed);
    FitRequest request = request_of("oren-nayar", {{"kd", 0.0}});
    request.starts = 2;
    curvature.count(fit(scan, request).parameters[0], truth[0]);
    request.profile_intervals = true;
    profile.count(fit(scan, request).parameters[0], truth[0]);
  });
  INFO("of " << kRepeats << ", below and above the truth: curvature " << curvature.below << ", " << curvature.above
             << "; profile " << profile.below << ", " << profile.above);
  // Measured: 3 and 40 by curvature, 31 and 24 by profile.
  CHECK(curvature.below < 10);
  CHECK(profile.uneven() < curvature.uneven());
  CHECK(profile.below >= 10);
  CHECK(profile.below <= 40);
  CHECK(profile.above >= 10);
  CHECK(profile.above <= 40);
}
