#include "fit/formats/formats.h"

#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>

#include "base/error.h"
#include "base/files.h"
#include "catch.h"
#include "fit/formats/collect.h"
#include "fit/formats/compare.h"
#include "fit/formats/readers.h"
#include "fit/formats/writers.h"

using namespace gonio;
namespace fs = std::filesystem;

namespace {

constexpr double kTiny = 1e-12;

fs::path sample(const std::string& name) { return fs::path(GONIO_SOURCE_DIR) / "tests/fit/samples" / name; }

void check_point(const ScanPoint& p, double theta_i, double theta_o, double phi, double f) {
  INFO(fmt::format("{} {} {} {}", p.theta_i_deg, p.theta_o_deg, p.phi_deg(), p.f_per_sr));
  CHECK(p.theta_i_deg == Approx(theta_i).margin(kTiny));
  CHECK(p.theta_o_deg == Approx(theta_o).margin(kTiny));
  CHECK(std::abs(std::remainder(p.phi_deg() - phi, 360)) == Approx(0).margin(1e-9));
  CHECK(p.f_per_sr == f);
}

bool says(const Measurement& scan, std::string_view part) {
  for (const std::string& convention : scan.conventions)
    if (convention.find(part) != convention.npos) return true;
  return false;
}

/// Every number of a measurement, for equality to the last bit.
std::vector<double> numbers_of(const Measurement& scan) {
  std::vector<double> all;
  for (const ScanPoint& p : scan.points)
    for (const double x :
         {p.theta_i_deg, p.phi_i_deg, p.theta_o_deg, p.phi_o_deg, p.f_per_sr,
          p.has_wavelength() ? p.wavelength_nm : -1.0, p.f_std_per_sr == p.f_std_per_sr ? p.f_std_per_sr : -1.0})
      all.push_back(x);
  return all;
}

}  // namespace

TEST_CASE("ASTM: radians unless stated, wavelengths as columns, a rounded pi/2 is 90 degrees", "[fit][formats]") {
  const Measurement scan = read_any(sample("painted.astm"));
  CHECK(scan.id == "painted");
  CHECK(scan.name == "grey paint");
  REQUIRE(scan.points.size() == 9);
  CHECK(scan.wavelengths() == std::vector<double>{465, 525, 630});
  check_point(scan.points[0], 30, 15, 180, 0.125);
  check_point(scan.points[4], 30, 30, 180, 1.25);
  CHECK(scan.points[4].wavelength_nm == 525);
  check_point(scan.points[8], 60, 30, -90, 0.375);
  CHECK(scan.left_out.at("zenith angle of 90 degrees") == 3);
  CHECK(scan.incidences_deg == std::vector<double>{30, 60});
  CHECK(says(scan, "radians (not stated"));
  CHECK(scan.notes.size() == 1);  // APERTURE
}

TEST_CASE("ASTM: stated degrees and quantity; colours give the middle one", "[fit][formats]") {
  const std::string head = "NUM_POINTS 1\nANGLE_UNITS degrees\n";
  const Measurement cosine =
      read_astm(head + "QUANTITY brdf_cos\nVARS theta_i,phi_i,theta_r,phi_r,BRDF\n30 0 60 180 0.5\n", "a");
  check_point(cosine.points.at(0), 30, 60, 180, 0.5 * to_brdf("brdf_cos", 60));
  CHECK(cosine.points[0].f_per_sr == Approx(1.0).epsilon(1e-15));
  CHECK(says(cosine, "degrees (stated"));
  const Measurement colour = read_astm(head + "VARS phi_s,theta_s,phi_i,theta_i,R,G,B\n180,60,0,30,1,2,3\n", "a");
  check_point(colour.points.at(0), 30, 60, 180, 2);
  CHECK(says(colour, "G of R, G, B"));
}

TEST_CASE("Zemax: angles about the mirror direction become angles about the normal", "[fit][formats]") {
  const Measurement scan = read_any(sample("vinyl.bsdf"));
  // θ_i = 0: 0, three times 15 and 60; θ_i = 30: 0, three times 15, and 60 at 0, 90 and (at the horizon) 180.
  CHECK(scan.points.size() == 13);
  CHECK(scan.left_out.at("repeats a direction of the grid") == 4);
  CHECK(scan.left_out.at("at or below the horizon") == 1);
  check_point(scan.points[0], 0, 0, 0, 1.5);
  check_point(scan.points[1], 0, 15, 0, 0.5);
  check_point(scan.points[3], 0, 15, 90, 0.5);  // the side of a symmetrical file is a matter of its convention
  check_point(scan.points[5], 0, 15, 180, 0.5);
  check_point(scan.points[7], 30, 30, 180, 2.5);
  check_point(scan.points[8], 30, 15, 180, 0.75);   // 15 degrees from the mirror direction towards the normal
  check_point(scan.points[9], 30, 30, 0, 0.03125);  // 60 degrees: past the normal
  check_point(scan.points[12], 30, 45, 180, 0.5);   // 15 degrees away from the normal
  // Across: cos θ_o = cos 15° cos 30°.
  CHECK(scan.points[10].theta_o_deg ==
        Approx(std::acos(std::cos(0.2617993877991494) * std::cos(0.5235987755982988)) * 180 / 3.141592653589793));
  CHECK(says(scan, "symmetry"));
}

TEST_CASE("LightTools: the light comes from azimuth 90; the back side is left out", "[fit][formats]") {
  const Measurement scan = read_any(sample("coated.lighttools.bsdf"));
  REQUIRE(scan.points.size() == 5);
  check_point(scan.points[0], 30, 0, -90, 0.25);
  check_point(scan.points[2], 30, 45, 0, 0.125);
  check_point(scan.points[4], 30, 45, 180, 2.5);
  CHECK(scan.points[4].wavelength_nm == 550);
  CHECK(scan.left_out.at("back side or transmission") == 8);
  CHECK(scan.left_out.at("repeats a direction of the grid") == 3);
}

TEST_CASE("ALTA: parametrisations become two directions; the cosine is divided out", "[fit][formats]") {
  const Measurement scan = read_any(sample("retro.alta"));
  REQUIRE(scan.points.size() == 2);
  check_point(scan.points[0], 30, 60, 180, 0.5 * to_brdf("brdf_cos", scan.points[0].theta_o_deg));
  CHECK(scan.points[0].f_per_sr == Approx(1).epsilon(1e-14));
  CHECK(scan.points[1].phi_deg() == 0);
  CHECK(says(scan, "brdf_cos"));
  const auto one = [](const std::string& in, const std::string& n, const std::string& row) {
    return read_alta("#DIM " + n + " 1\n#PARAM_IN " + in + "\n#PARAM_OUT INV_STERADIAN\n" + row + " 0.5\n", "a.alta");
  };
  const std::string d10 = "0.17453292519943295", d20 = "0.3490658503988659", d180 = "3.141592653589793";
  check_point(one("SPHERICAL_TL_PL_TV_PV", "4", d10 + " 0 " + d20 + " " + d180).points.at(0), 10, 20, 180, 0.5);
  check_point(one("ISOTROPIC_TV_TL", "2", d10 + " " + d20).points.at(0), 20, 10, 180, 0.5);
  check_point(one("RUSIN_TH_TD_PD", "3", d10 + " " + d20 + " 0").points.at(0), 30, 10, 180, 0.5);
  check_point(one("RUSIN_TH_TD_PD", "3", d20 + " " + d10 + " 0").points.at(0), 30, 10, 0, 0.5);
  check_point(one("RUSIN_TH_PH_TD_PD", "4", d10 + " 1 " + d20 + " " + d180).points.at(0), 10, 30, 180, 0.5);
  check_point(one("CARTESIAN", "6", "0.6 0 0.8 -0.8 0 0.6").points.at(0),
              std::atan2(0.8, 0.6) * 180 / 3.141592653589793, std::atan2(0.6, 0.8) * 180 / 3.141592653589793, 180, 0.5);
}

TEST_CASE("SSDD: PARAM0 runs fastest, blocks other than brdf are checked and left out", "[fit][formats]") {
  const Measurement scan = read_any(sample("blue.ssdd"));
  CHECK(scan.name == "bluish");
  REQUIRE(scan.points.size() == 6);  // θ_o = 0 once each
  check_point(scan.points[0], 0, 0, 0, 0.25);
  check_point(scan.points[1], 30, 0, 0, 0.5);
  check_point(scan.points[2], 0, 45, 0, 0.125);
  check_point(scan.points[3], 30, 45, 0, 0.0625);
  check_point(scan.points[5], 30, 45, 180, 1.5);
  CHECK(scan.notes.size() == 1);
  CHECK(says(scan, "G of R, G, B"));
  const std::string head = "VERSION 0.2\nDATA_TYPE brdf\nCOLOR_MODEL spectrum\nWAVELENGTH_LIST 400 500\nPARAM_TYPE ";
  const std::string lists = "\nPARAM0_LIST 10\nPARAM2_LIST 20\nPARAM3_LIST 0\nDATA ascii\n0.25 0.5\n";
  const Measurement half = read_ssdd(head + "half_difference_coordinate_system" + lists, "a");
  check_point(half.points.at(1), 30, 10, 180, 0.5);
  CHECK(half.points[1].wavelength_nm == 500);
  check_point(read_ssdd(head + "specular_coordinate_system" + lists, "a").points.at(0), 10, 10, 0, 0.25);
}

TEST_CASE("A plain table is read as its comments say", "[fit][formats]") {
  const Measurement scan = read_any(sample("he.txt"));
  CHECK(scan.name == "rough aluminium");
  REQUIRE(scan.points.size() == 3);
  check_point(scan.points[0], 10, 30, 0, 0.25 * to_brdf("brdf_cos", 30));
  check_point(scan.points[1], 10, 0, 180, 0.5);
  check_point(scan.points[2], 10, 60, 180, 0.125 * to_brdf("brdf_cos", 60));
  CHECK(scan.points[2].f_std_per_sr == Approx(0.04).epsilon(1e-14));
  CHECK(scan.points[2].wavelength_nm == 550);
  CHECK(scan.left_out.at("zenith angle of 90 degrees") == 1);
  const Measurement other = read_angle_table(
      "% columns: theta_i, theta_o, skip, phi, value\n% angles: radians\n% quantity: relative\n% azimuth: 0 = mirror\n"
      "0.5235987755982988, 0, 9, 0, 0.5\n",
      "t.dat");
  check_point(other.points.at(0), 30, 0, 180, 0.5);
  CHECK(other.quantity == "relative");
}

namespace {

/// Something with every angle and channel in it.
double made_up(double theta_h, double theta_d, double phi_d, int channel) {
  return 0.01 * (1 + channel) + 1e-4 * theta_h + 1.2345e-6 * theta_d + 1.7e-9 * phi_d;
}

double stored(const std::string& bytes, std::size_t at) {
  double value;
  std::memcpy(&value, bytes.data() + 12 + 8 * at, 8);
  return value;
}

}  // namespace

TEST_CASE("MERL: cells, scale and thinning; what is written is read back to the bit", "[fit][formats]") {
  const std::string bytes = merl_bytes(made_up);
  const std::size_t cells = MerlGrid{}.cells();
  REQUIRE(bytes.size() == 12 + 24 * cells);
  // By hand: cell (θ_h, θ_d, φ_d) = (3, 10, 20) stands at 20 + 180·(10 + 90·3); its middle at 3.5²/90, 10.5, 20.5 degrees.
  const std::size_t at = 20 + 180 * (10 + 90 * 3);
  const double theta_h = 3.5 * 3.5 / 90;
  CHECK(stored(bytes, at) == Approx(1500 * made_up(theta_h, 10.5, 20.5, 0)).epsilon(1e-14));
  CHECK(stored(bytes, cells + at) == Approx(1500 / 1.15 * made_up(theta_h, 10.5, 20.5, 1)).epsilon(1e-14));
  CHECK(stored(bytes, 2 * cells + at) == Approx(1500 / 1.66 * made_up(theta_h, 10.5, 20.5, 2)).epsilon(1e-14));
  CHECK(stored(bytes, cells - 1) == -1);  // θ_h and θ_d near 90°
  const Measurement scan = read_merl(bytes, "a.binary");
  CHECK(scan.points.size() > 50000);
  CHECK(scan.points.size() <= 100000);
  CHECK(scan.incidences_binned);
  const auto& out = scan.left_out;
  CHECK(scan.points.size() + static_cast<std::size_t>(out.at("below the horizon") + out.at("thinned")) == cells);
  CHECK(says(scan, "green"));
  // Each point's value is that of its own half and difference angles: to the bit that of the cell.
  std::size_t next = 0, wrong = 0;
  for (std::size_t k = 0; k < cells && next < scan.points.size(); ++k) {
    const MerlAngles a = merl_angles_deg(k);
    if (scan.points[next].f_per_sr != stored(bytes, cells + k) * kMerlScale[1]) continue;
    bool below = false;
    const ScanPoint p = point_of(from_half_difference_deg(a.theta_h_deg, 0, a.theta_d_deg, a.phi_d_deg), below);
    wrong += below || p.theta_i_deg != scan.points[next].theta_i_deg || p.theta_o_deg != scan.points[next].theta_o_deg;
    ++next;
  }
  CHECK(next == scan.points.size());
  CHECK(wrong == 0);
  // Read (every cell of a small grid) and written again: the same bytes in the green channel.
  const MerlGrid small{4, 5, 6};
  const std::string first = merl_bytes(made_up, small);
  const Measurement all = read_merl_grid(first, "s.binary", small);
  std::size_t point = 0;
  const std::string again = merl_bytes(
      [&](double, double, double, int channel) { return channel == 1 ? all.points.at(point++).f_per_sr : 0.0; }, small);
  CHECK(point == all.points.size());
  double worst = 0;
  for (std::size_t k = 0; k < small.cells(); ++k)
    worst = std::max(worst, std::abs(stored(again, small.cells() + k) / stored(first, small.cells() + k) - 1));
  CHECK(worst < 3e-16);  // times and divided by 1.15/1500
}

TEST_CASE("half and difference angles: hand-made cases and the inverse", "[fit][formats]") {
  bool below = false;
  check_point(point_of(from_half_difference_deg(0, 0, 40, 70), below), 40, 40, 180, 0);
  // The mean of the two directions is h, and the angle between i and h is θ_d.
  for (const double phi_d : {10.0, 95.0, 170.0}) {
    const DirectionPair pair = from_half_difference_deg(25, 40, 35, phi_d);
    const double x = pair.i.x + pair.o.x, y = pair.i.y + pair.o.y, z = pair.i.z + pair.o.z;
    CHECK(std::atan2(std::hypot(x, y), z) == Approx(25 * 3.141592653589793 / 180));
    CHECK(std::atan2(y, x) == Approx(40 * 3.141592653589793 / 180));
    CHECK(std::sqrt(x * x + y * y + z * z) / 2 == Approx(std::cos(35 * 3.141592653589793 / 180)));
  }
}

TEST_CASE("written measurements read back to the same doubles", "[fit][formats]") {
  const fs::path folder = fs::temp_directory_path() / "gonio formats round trip";
  for (const std::string name :
       {"painted.astm", "vinyl.bsdf", "coated.lighttools.bsdf", "retro.alta", "blue.ssdd", "he.txt"}) {
    INFO(name);
    const Measurement scan = read_any(sample(name));
    write_measurement(scan, folder / "csv");
    const Measurement csv = read_any(folder / "csv");
    CHECK(numbers_of(csv) == numbers_of(scan));
    CHECK(csv.name == scan.name);
    CHECK(csv.incidences_deg == scan.incidences_deg);
    write_file(folder / "a.astm", astm_text(scan));
    Measurement plain = scan;
    for (ScanPoint& p : plain.points) p.f_std_per_sr = kNotStated;  // no place for it, and said so
    CHECK(not_in_astm(scan).empty() == (numbers_of(plain) == numbers_of(scan)));
    CHECK(numbers_of(read_any(folder / "a.astm")) == numbers_of(plain));
  }
  fs::remove_all(folder);
}

TEST_CASE("texts of a measurement survive in measurement.yaml; gaps in wavelengths do not pass to ASTM",
          "[fit][formats]") {
  Measurement scan = read_any(sample("painted.astm"));
  scan.source = "A \"quoted\" \\ text: with # marks\nand lines";
  scan.material = "Au";
  const Measurement known = parse_measurement_yaml(measurement_yaml(scan), "m.yaml");
  CHECK(known.source == "A \"quoted\" \\ text: with # marks and lines");
  CHECK(known.material.value() == "Au");
  scan.points.pop_back();
  CHECK_THROWS_AS(astm_text(scan), InputError);
}

TEST_CASE("comparing: the same measurement, a scaled one, shifted angles", "[fit][formats]") {
  const Measurement a = read_any(sample("vinyl.bsdf"));
  Measurement b = a;
  for (ScanPoint& p : b.points) p.f_per_sr *= 2, p.phi_o_deg += 360.2;
  const ScanComparison same = compare_scans(a, a, 0);
  CHECK(same.matched == a.points.size());
  CHECK(same.compared == a.points.size());
  CHECK(same.mean_ratio == 1);
  CHECK(same.rms_log10 == 0);
  CHECK(compare_scans(a, b, 0.1).matched == 7);  // where a direction is the normal, phi has no meaning
  const ScanComparison twice = compare_scans(a, b, 0.25);
  CHECK(twice.matched == a.points.size());
  CHECK(twice.mean_ratio == Approx(0.5));
  CHECK(twice.rms_log10 == Approx(std::log10(2.0)));
  CHECK(twice.largest_log10 == Approx(-std::log10(2.0)));
}

TEST_CASE("formats are known by their first bytes, and by name", "[fit][formats]") {
  CHECK(formats().size() >= 7);
  CHECK_THROWS_AS(format_named("tea"), InputError);
  CHECK_THROWS_AS(read_any(sample("vinyl.bsdf"), "lighttools"), InputError);
  CHECK(read_any(sample("vinyl.bsdf"), "zemax").points.size() == 13);
  CHECK_THROWS_AS(read_any(sample("none.astm")), InputError);
}
