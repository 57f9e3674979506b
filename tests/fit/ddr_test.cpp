// Integra .ddr tables: read as described, and broken ones refused.
#include "fit/formats/ddr.h"

#include "format_samples.h"

using namespace gonio;
using namespace gonio::test;

namespace {

const std::string kPlane =
    ";; made by a test\nSource Measured\nTypeSym PlaneSymmetrical\nTypeColorModel BW\nTypeData Luminance Absolute\n"
    "sigma 2\n 0 30\nphi 3\n 0 90 180\ntheta 2\n 0 45\nbw\n kbdf\n 0.5 2\n def\n;; Sigma = 0\n 1 2\n 3 4\n 5 6\n;; "
    "Sigma = 30\n"
    " 7 8\n 9 10\n 11 12\n enddef\n";
const std::string kSpectral =
    "Source Generated\nTypeSym ASymmetrical 4D\nTypeColorModel spectral 2\nTypeData Intensity Relative\npsi 2\n 0 90\n"
    "sigma 1\n 20\nphi 2\n 0 180\ntheta 1\n 10\nwl 450\ndef\n 1 2 3 4\nenddef\nwl 650\ndef\n 5 6 7 8\nenddef\n";

const ScanPoint& nearest(const Measurement& scan, double theta_i, double theta_o, double phi_o) {
  for (const ScanPoint& p : scan.points) {
    const double turn = std::abs(std::remainder(p.phi_o_deg - phi_o, 360));
    if (std::abs(p.theta_i_deg - theta_i) < 1e-9 && std::abs(p.theta_o_deg - theta_o) < 1e-6 &&
        (turn < 1e-6 || theta_o < 1e-6))
      return p;
  }
  FAIL("no point at " << theta_i << ", " << theta_o << ", " << phi_o);
  return scan.points.front();
}

}  // namespace

TEST_CASE("an Integra table: mirror coordinates, absolute luminance times kbdf over pi", "[fit][ddr]") {
  const Measurement scan = format_named("ddr").read(kPlane, "FILE");
  CHECK(scan.quantity == "reflectance_factor");
  CHECK(scan.points.size() == 12);
  CHECK(scan.source == "Measured");
  // theta = 0 is the mirror direction: at azimuth 180 from the light.
  CHECK(nearest(scan, 30, 30, 180).f_per_sr == Approx(7 * 2 / M_PI));
  // phi = 0, theta = 45 leans over the normal to the light's side, 15 degrees beyond it; phi = 180 away from the normal.
  CHECK(nearest(scan, 30, 15, 0).f_per_sr == Approx(8 * 2 / M_PI));
  CHECK(nearest(scan, 30, 75, 180).f_per_sr == Approx(12 * 2 / M_PI));
  CHECK(nearest(scan, 0, 45, 0).f_per_sr == Approx(2 * 0.5 / M_PI));
  CHECK(nearest(scan, 0, 45, 90).f_per_sr == Approx(4 * 0.5 / M_PI));
  CHECK_FALSE(scan.points[0].has_wavelength());
  std::string all;
  for (const std::string& convention : scan.conventions) all += convention + "\n";
  for (const char* word : {"luminance", "absolute", "kbdf", "degrees", "mirror direction", "PlaneSymmetrical"})
    CHECK(all.find(word) != all.npos);
}

TEST_CASE("an Integra table with wavelengths, azimuths of incidence and relative intensities", "[fit][ddr]") {
  const Measurement scan = read_ddr(kSpectral, "FILE");
  CHECK(scan.quantity == "relative");
  CHECK(scan.wavelengths() == std::vector<double>{450, 650});
  REQUIRE(scan.points.size() == 8);
  CHECK(scan.points[0].theta_o_deg == Approx(10));  // 20 - 10, on the mirror side
  CHECK(scan.points[0].phi_deg() == Approx(180));
  CHECK(scan.points[0].f_per_sr == Approx(1 / std::cos(M_PI / 18)));
  CHECK(scan.points[1].f_per_sr == Approx(5 / std::cos(M_PI / 18)));
  CHECK(scan.points[2].theta_o_deg == Approx(30));
  CHECK(scan.points[4].phi_i_deg == 90);
  CHECK(std::abs(scan.points[4].phi_deg()) == Approx(180));
}

TEST_CASE("an Integra table in red, green and blue is weighed to one value; directions below the horizon are counted",
          "[fit][ddr]") {
  const Measurement scan = read_ddr(
      "TypeSym AxiSymmetrical TypeColorModel RGB TypeData Luminance Absolute sigma 1 60 phi 1 180 theta 2 0 40\n"
      "red def 1 0 enddef gre def 2 0 enddef blu def 3 0 enddef",
      "FILE");
  REQUIRE(scan.points.size() == 1);
  CHECK(scan.points[0].f_per_sr == Approx((0.2126 + 2 * 0.7152 + 3 * 0.0722) / M_PI));
  CHECK(scan.left_out.begin()->second == 1);
}

TEST_CASE("Integra tables cut short are refused wherever they end", "[fit][ddr][malformed]") {
  for (const std::string& text : {kPlane, kSpectral}) {
    const std::size_t last = text.find_last_of("f");  // of enddef
    for (std::size_t end = 0; end <= last; ++end) check_refusal("ddr", text.substr(0, end), "FILE:");
  }
}

TEST_CASE("broken Integra tables are refused at their line", "[fit][ddr][malformed]") {
  struct Change {
    const char *from, *to, *where, *words;
  };
  for (const Change& c : {Change{"TypeSym PlaneSymmetrical", "TypeSym Round", "FILE:3:", "TypeSym"},
                          {"TypeSym PlaneSymmetrical\n", "", "FILE:11:", "TypeSym is missing"},
                          {"TypeSym PlaneSymmetrical", "TypeSym ASymmetrical 4D", "FILE:", "psi is missing"},
                          {"BW", "XYZ", "FILE:4:", "TypeColorModel"},
                          {"BW", "BW TypeColorModel BW", "FILE:4:", "twice"},
                          {"TypeColorModel BW\n", "", "FILE:11:", "TypeColorModel is missing"},
                          {"TypeColorModel BW", "TypeColorModel spectral 0", "FILE:4:", "count"},
                          {"TypeColorModel BW", "TypeColorModel spectral 999999999", "FILE:4:", "room"},
                          {"Luminance", "Radiance", "FILE:5:", "TypeData"},
                          {"Absolute", "Absolutely", "FILE:5:", "Absolute or Relative"},
                          {"TypeData Luminance Absolute\n", "", "FILE:11:", "TypeData is missing"},
                          {"sigma 2", "sigma 99999999999999999999", "FILE:6:", "count"},
                          {"sigma 2", "sigma 4000000", "FILE:6:", "room"},
                          {"sigma 2", "sigma -2", "FILE:6:", "count"},
                          {"sigma 2", "sigma 2.5", "FILE:6:", "count"},
                          {"sigma 2", "sigma 3", "FILE:8:", "phi"},
                          {"sigma 2", "sigma 1", "FILE:7:", "keyword `30`"},
                          {"0 30\nphi", "30 0\nphi", "FILE:7:", "increasing"},
                          {"0 30\nphi", "0 0\nphi", "FILE:7:", "increasing"},
                          {"0 30\nphi", "0 91\nphi", "FILE:7:", "0 to 90"},
                          {"0 30\nphi", "-1 30\nphi", "FILE:7:", "0 to 90"},
                          {"0 30\nphi", "0 nan\nphi", "FILE:7:", "finite"},
                          {"0 90 180", "0 90 361", "FILE:9:", "0 to 360"},
                          {"0 45", "0 181", "FILE:11:", "0 to 180"},
                          {"theta 2\n 0 45\n", "", "FILE:10:", "theta is missing"},
                          {"phi 3\n 0 90 180\n", "", "FILE:10:", "phi is missing"},
                          {"sigma 2\n 0 30\n", "", "FILE:10:", "sigma is missing"},
                          {"phi 3", "psi 1 0 phi 3", "FILE:12:", "psi is given"},
                          {"Source", "sigmaT 0 30 Source", "FILE:2:", "keyword"},
                          {"Source", "\x01\x02 Source", "FILE:2:", "not text"},
                          {"bw\n", "red\n", "FILE:12:", "expected bw"},
                          {"kbdf\n 0.5 2", "kbdf\n 0.5", "FILE:15:", "kbdf is `def`"},
                          {"kbdf\n 0.5 2", "kbdf\n -0.5 2", "FILE:14:", "kbdf is -0.5"},
                          {"kbdf\n 0.5 2", "kbdf\n 0.5 2 3", "FILE:14:", "expected def"},
                          {" def", " fed", "FILE:15:", "expected def"},
                          {"9 10", "9", "FILE:24:", "a value is `enddef`"},
                          {"9 10", "9 10 10", "FILE:23:", "expected enddef"},
                          {"9 10", "9 nan", "FILE:22:", "finite"},
                          {"9 10", "9 inf", "FILE:22:", "finite"},
                          {"9 10", "9 1e999", "FILE:22:", "finite"},
                          {"9 10", "9 10,", "FILE:22:", "finite"},
                          {"enddef\n", "enddef\nbw", "FILE:25:", "the end of the file"},
                          {"enddef\n", "", "FILE:", "enddef"}}) {
    INFO(c.from << " -> " << c.to);
    check_refusal("ddr", with(kPlane, c.from, c.to), c.where, c.words);
  }
  check_refusal("ddr", with(kSpectral, "wl 650", "wl 440"), "FILE:", "increasing");
  check_refusal("ddr", with(kSpectral, "wl 650", "wl 0.65"), "FILE:", "100 to 100000");
  check_refusal("ddr", with(kSpectral, "spectral 2", "spectral 3"), "FILE:", "a channel");
  check_refusal("ddr", with(kSpectral, "spectral 2", "spectral 1"), "FILE:", "end of the file");
  check_refusal("ddr", std::string("TypeSym\0TypeData", 16), "FILE:1:", "not text");
  check_refusal("ddr", "", "FILE:1:");
}
