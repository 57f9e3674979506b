// Which further angle helps: the rank-one update against refits with the point added.
#include "fit/next_measurement.h"

#include "catch.h"
#include "synthetic.h"

using namespace gonio;
using namespace gonio::test;

namespace {

/// The points of a scan below these zenith angles.
Measurement without_grazing(double last_deg) {
  Measurement scan = empty_scan(10);
  std::erase_if(scan.points, [&](auto& p) { return p.theta_i_deg > last_deg || p.theta_o_deg > last_deg; });
  std::erase_if(scan.incidences_deg, [&](double angle) { return angle > last_deg; });
  return scan;
}

FitRequest request_of(std::string_view name) {
  FitRequest request;
  request.model = spec_of(name), request.starts = 4, request.material = "perfect";
  request.hold_out = HoldOut::none, request.floor_per_sr = 0;
  return request;
}

/// Standard error of the logarithm after a refit with one more point, which the model predicts exactly; the residuals' variance kept.
double refitted_error(const FitProblem& problem, const Solution& best, std::size_t place, double theta_i_deg,
                      double theta_o_deg, double phi_deg) {
  FitProblem more = problem;
  FitPoint point = problem.points.front();
  point.directions = directions_from_deg(theta_i_deg, theta_o_deg, phi_deg);
  point.f_per_sr = problem.predict(best.x, std::vector<FitPoint>{point}).front();
  more.points.push_back(point);
  const Solution refitted = solve(more, best.x);
  const auto free = static_cast<double>(problem.free.size()),
             before = static_cast<double>(problem.points.size()) - free;
  return uncertainty(more, refitted).standard_error[place] * std::sqrt((before + 1) / before);
}

struct Fitted {
  Prepared ready;
  Solution best;
};

Fitted fitted(const Measurement& scan, const FitRequest& request) {
  FitResult sink;
  Fitted f{prepare(scan, request, sink), {}};
  const FitResult result = fit(scan, request);
  std::vector<double> x;
  for (const FreeParameter& p : f.ready.problem.free) x.push_back(std::log(result.value(p.name)));
  f.best = solve(f.ready.problem, x);
  return f;
}

}  // namespace

TEST_CASE("the angle that helps most is the one that refits find", "[fit][next][slow]") {
  // kd is seen best where the lobe is weak, which a scan up to 30 degrees does not reach.
  const ModelSpec spec = spec_of("torrance-sparrow");
  const Measurement scan =
      synthetic(without_grazing(30), spec, std::vector<double>{0.25, 0.1, 0.9}, perfect_interface<double>(), 0.1, 5);
  const Fitted f = fitted(scan, request_of("torrance-sparrow"));
  NextMeasurementOptions options;
  options.step_deg = 20, options.last_deg = 80;
  for (const char* name : {"m", "kd", "ks"}) {
    options.parameter = name;
    const auto next = next_measurement(f.ready.problem, f.best, options);
    REQUIRE(next.has_value());
    std::size_t place = 0;
    while (f.ready.problem.free[place].name != name) ++place;
    double least = 1e300, at_answer = 0;
    for (double i = 0; i <= 80; i += 20)
      for (double o = 0; o <= 80; o += 20)
        for (double phi = 0; phi <= 180; phi += 20) {
          const double error = refitted_error(f.ready.problem, f.best, place, i, o, phi);
          least = std::min(least, error);
          if (i == next->theta_i_deg && o == next->theta_o_deg && phi == next->phi_deg) at_answer = error;
        }
    INFO(sentence(*next));
    // The prior of the box (width/√12) is what the two may differ by.
    CHECK(at_answer == Approx(next->error_after).epsilon(1e-2));
    CHECK(at_answer <= least * (1 + 1e-2));
    CHECK(next->factor() > 1);
  }
}

TEST_CASE("the least known parameter is chosen, and said in a sentence", "[fit][next]") {
  const ModelSpec spec = spec_of("torrance-sparrow");
  const Measurement scan =
      synthetic(without_grazing(30), spec, std::vector<double>{0.25, 0.1, 0.9}, perfect_interface<double>(), 0.1, 5);
  const FitResult result = fit(scan, request_of("torrance-sparrow"));
  REQUIRE(result.next_measurement.has_value());
  CHECK(result.next_measurement->parameter == "kd");
  CHECK(result.next_measurement->factor() > 1.1);
  CHECK_THAT(sentence(*result.next_measurement), Catch::Matchers::Contains("would make the standard error of kd ") &&
                                                     Catch::Matchers::Contains("theta_i = "));
  // A scan that reaches everything needs no advice.
  const Measurement whole =
      synthetic(empty_scan(5), spec, std::vector<double>{0.25, 0.2, 0.9}, perfect_interface<double>(), 0.02, 5);
  CHECK_FALSE(fit(whole, request_of("torrance-sparrow")).next_measurement.has_value());
}

TEST_CASE("a direction that the points leave open is closed by the advised point", "[fit][next]") {
  // One azimuth: alpha_y only enters as ks/alpha_y. A point off the plane tells them apart.
  const Measurement scan = synthetic(empty_scan(10), spec_of("ggx"), std::vector<double>{0.2, 0.4, 0.0, 0.8},
                                     perfect_interface<double>(), 0.05, 9);
  FitRequest request = request_of("ggx");
  request.held = {{"kd", 0.0}};
  const FitResult result = fit(scan, request);
  REQUIRE(result.next_measurement.has_value());
  INFO(sentence(*result.next_measurement));
  CHECK(result.next_measurement->phi_deg > 0);
  CHECK(result.next_measurement->phi_deg < 180);
  CHECK(result.next_measurement->factor() > 5);
}
