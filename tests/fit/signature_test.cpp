// An instrument's signature is taken out as it was put in; polarisation judges a fit by what it has not seen.
#include "fit/signature.h"

#include "base/error.h"
#include "brdf/polarised.h"
#include "catch.h"
#include "fit/polarisation.h"
#include "materials/database.h"
#include "synthetic.h"

using namespace gonio;
using namespace gonio::test;

namespace {

/// f·cos θ_o of a made-up instrument against the angle from the mirror direction.
double stray(double from_mirror) {
  return 40 * std::exp(-square(from_mirror / 1.5)) + 0.02 * std::exp(-from_mirror / 6);
}

Measurement beam() {
  Measurement scan;
  scan.id = "beam";
  for (double angle = -80; angle <= 80.01; angle += 0.1) {
    ScanPoint p;
    p.theta_o_deg = std::abs(angle), p.phi_o_deg = angle < 0 ? 0 : 180;
    p.f_per_sr = stray(std::abs(angle)) / cos_deg(p.theta_o_deg);
    scan.points.push_back(p);
  }
  group_by_incidence(scan);
  return scan;
}

}  // namespace

TEST_CASE("the angle from the mirror direction", "[fit][signature]") {
  ScanPoint p;
  p.theta_i_deg = 30, p.theta_o_deg = 30, p.phi_o_deg = 180;
  CHECK(from_mirror_deg(p) == Approx(0).margin(1e-12));
  p.theta_o_deg = 30 + 1e-6;
  CHECK(from_mirror_deg(p) == Approx(1e-6).epsilon(1e-6));
  p.theta_o_deg = 20, p.phi_o_deg = 0;
  CHECK(from_mirror_deg(p) == Approx(50));
  p.theta_i_deg = 90, p.theta_o_deg = 90, p.phi_o_deg = 90;
  CHECK(from_mirror_deg(p) == Approx(90));
}

TEST_CASE("a signature is subtracted, and what is nothing else is left out", "[fit][signature]") {
  const Signature signature(beam());
  CHECK(signature.at(0) == Approx(stray(0)));
  CHECK(signature.at(10.13) == Approx(stray(10.13)).epsilon(1e-5));  // between two angles
  CHECK(signature.at(81) == 0);

  const Interface<double> gold = SurfaceMaterial("Au").at(550);
  const std::vector<double> truth{0.15, 0.05, 0.6};
  const Measurement pure = synthetic(empty_scan(2), spec_of("torrance-sparrow"), truth, gold);
  Measurement seen = pure;
  for (ScanPoint& p : seen.points) p.f_per_sr += 0.8 * stray(from_mirror_deg(p)) / cos_deg(p.theta_o_deg);
  FitRequest request;
  request.model = spec_of("torrance-sparrow"), request.material = "Au";
  CHECK(std::abs(fit(seen, request).value("m") / truth[0] - 1) > 0.02);
  const FitResult clean = fit(without_signature(seen, signature, 0.8), request);
  for (std::size_t i = 0; i < truth.size(); ++i) CHECK(clean.values()[i] == Approx(truth[i]).epsilon(1e-3));

  const Measurement nothing_else = without_signature(seen, signature, 0.8 * 20);
  CHECK(nothing_else.left_out.begin()->second == int(seen.points.size() - nothing_else.points.size()));
  CHECK_THROWS_AS(without_signature(seen, signature, -1), InputError);
  CHECK_THROWS_AS(without_signature(beam(), signature, 1), InputError);
  Measurement dark = beam();
  for (ScanPoint& p : dark.points) p.f_per_sr = 0;
  CHECK_THROWS_AS(Signature(dark), InputError);
}

TEST_CASE("Mueller elements judge a fit of f_r alone", "[fit][polarisation]") {
  const LobeSum model = spec_of("torrance-sparrow");
  const std::vector<double> truth{0.2, 0.1, 0.5};
  const Interface<double> glass{1.5, 0, false};
  Measurement scan = synthetic(empty_scan(), model.first(), truth, glass);
  scan.mueller_names = {"m12", "m33"};
  const Brdf<double> brdf = make_brdf<double>(model.first(), truth);
  for (ScanPoint& p : scan.points) {
    const Mueller<double> m = evaluate_mueller(brdf, directions_from_deg(p.theta_i_deg, p.theta_o_deg, p.phi_deg()),
                                               azimuth_from_deg(p.phi_deg()), glass, 0.55);
    p.mueller = {m.m[0][1] / m.m[0][0], m.m[2][2] / m.m[0][0]};
  }
  scan.points[0].mueller[0] = kNotStated;  // an empty cell
  FitRequest request;
  request.model = model, request.free_n = true, request.hold_out = HoldOut::none;
  const FitResult result = fit(scan, request);
  const MuellerJudgement judgement = judge_polarisation(scan, result);
  REQUIRE(judgement.stated);
  CHECK(judgement.elements[0].element == "m12");
  CHECK(judgement.elements[0].points == int(scan.points.size()) - 1);
  CHECK(judgement.rms_measured > 0.1);
  CHECK(judgement.rms_residual < 1e-6);
  CHECK(to_json(judgement, scan)["elements"].size() == 2);

  request.free_n = false, request.material = "Au";  // another material: f_r may pass, its polarisation does not
  CHECK(judge_polarisation(scan, fit(scan, request)).rms_residual > 0.05);
  request.model.set("retro", "yes");
  CHECK_FALSE(judge_polarisation(scan, fit(scan, request)).stated);
  scan.mueller_names.clear();
  CHECK(to_json(judge_polarisation(scan, result), scan).is_null());
}
