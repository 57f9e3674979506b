// Peaks that a scan cannot show, and values that a detector cannot.
#include "catch.h"
#include "synthetic.h"

using namespace gonio;
using namespace gonio::test;

namespace {

constexpr const char* kUnseen = "a narrower peak there would go unseen";
constexpr const char* kFull = "the detector may have been at its end";

FitResult fitted(const Measurement& scan, bool retro = false) {
  FitRequest request;
  request.model = spec_of("torrance-sparrow"), request.material = "perfect", request.starts = 2;
  if (retro) request.model.set("retro", "yes");
  return fit(scan, request);
}

Measurement made(Measurement scan) {
  return synthetic(std::move(scan), spec_of("torrance-sparrow"), std::vector<double>{0.2, 0.1, 0.5},
                   perfect_interface<double>(), 0.01);
}

}  // namespace

TEST_CASE("a scan that steps over the mirror direction is told", "[fit][traps]") {
  CHECK_FALSE(warns(fitted(made(empty_scan())), kUnseen));
  Measurement shifted = empty_scan(10);
  for (ScanPoint& p : shifted.points) p.theta_o_deg = std::min(p.theta_o_deg + 4.5, 85.0);
  for (ScanPoint& p : shifted.points)
    if (std::fmod(p.theta_i_deg, 10) != 0) p.theta_i_deg += 5, p.f_per_sr = 1;  // 20 and 50 degrees
  group_by_incidence(shifted);
  CHECK(warns(fitted(made(shifted)), kUnseen));

  // The light's own direction counts for lobes turned back.
  Measurement mirror_side = empty_scan();
  std::erase_if(mirror_side.points, [](const ScanPoint& p) { return p.phi_o_deg == 0; });
  const Measurement scan = made(mirror_side);
  CHECK_FALSE(warns(fitted(scan), kUnseen));
  CHECK(warns(fitted(scan, true), "light's own direction"));
}

TEST_CASE("values at the detector's end are told from symmetric ones", "[fit][traps]") {
  Measurement scan = made(empty_scan());
  CHECK_FALSE(warns(fitted(scan), kFull));
  double brightest = 0;
  for (const ScanPoint& p : scan.points) brightest = std::max(brightest, p.f_per_sr);
  for (ScanPoint& p : scan.points) p.f_per_sr = std::min(p.f_per_sr, 0.5 * brightest);
  CHECK(warns(fitted(scan), kFull));
  // Without noise the two sides of normal incidence are equal, and every azimuth there.
  Measurement around = empty_scan();
  for (double phi = 10; phi < 360; phi += 10)
    for (double theta = 0; theta < 80; theta += 10) {
      ScanPoint p;
      p.theta_o_deg = theta, p.phi_o_deg = phi, p.wavelength_nm = 550;
      around.points.push_back(p);
    }
  CHECK_FALSE(warns(fitted(synthetic(around, spec_of("torrance-sparrow"), std::vector<double>{0.2, 0.1, 0.5},
                                     perfect_interface<double>())),
                    kFull));
}
