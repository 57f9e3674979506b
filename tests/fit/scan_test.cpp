#include "fit/scan.h"

#include <cmath>
#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "base/files.h"
#include "catch.h"

using namespace gonio;

namespace {

const std::string kHeader = "theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg,brdf_per_sr\n";

/// The one line an unreadable scan is refused with.
std::string refusal(const std::string& csv, const std::string& yaml = "") {
  try {
    parse_scan(csv, "scan.csv", yaml.empty() ? Measurement{} : parse_measurement_yaml(yaml, "measurement.yaml"));
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

void check_refused(const std::string& csv, const std::string& start, const std::string& part) {
  const std::string message = refusal(csv);
  INFO(message);
  CHECK(message.starts_with(start));
  CHECK(message.find(part) != message.npos);
  CHECK(message.find("expected") != message.npos);
  CHECK(message.find('\n') == message.npos);
}

}  // namespace

TEST_CASE("a scan is read by column name, in any order, in both spellings", "[fit][scan]") {
  const Measurement a = parse_scan(kHeader + "30,10,45,190,0.5\n", "a.csv");
  const Measurement b = parse_scan(
      "\xEF\xBB\xBF# a comment\r\nphi_o_deg,brdf_per_sr,theta_o_deg,theta_i_deg,phi_i_deg\r\n190,0.5,45,30,10\r\n\r\n",
      "b.csv");
  for (const Measurement* scan : {&a, &b}) {
    REQUIRE(scan->points.size() == 1);
    const ScanPoint& p = scan->points[0];
    CHECK(p.theta_i_deg == 30);
    CHECK(p.theta_o_deg == 45);
    CHECK(p.phi_deg() == 180);
    CHECK(p.f_per_sr == 0.5);
    CHECK_FALSE(p.has_wavelength());
    CHECK(std::isnan(p.f_std_per_sr));
  }
}

TEST_CASE("optional columns and ignored ones", "[fit][scan]") {
  const Measurement scan = parse_scan(
      "theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg,brdf_per_sr,wavelength_nm,brdf_std_per_sr,m12,note\n"
      "30,0,30,180,0.5,532,0.01,-0.2,fine\n60,0,30,180,0.25,633,,,text\n",
      "scan.csv");
  CHECK(scan.wavelengths() == std::vector<double>{532, 633});
  CHECK(scan.points[0].f_std_per_sr == 0.01);
  CHECK(std::isnan(scan.points[1].f_std_per_sr));
  CHECK(scan.mueller_names == std::vector<std::string>{"m12"});
  CHECK(scan.points[0].mueller.at(0) == -0.2);
  CHECK(std::isnan(scan.points[1].mueller.at(0)));
  REQUIRE(scan.notes.size() == 1);
  CHECK(scan.notes[0].find("note") != std::string::npos);
  CHECK(scan.incidences_deg == std::vector<double>{30, 60});
}

TEST_CASE("quantities become a BRDF in 1/sr", "[fit][scan]") {
  const auto value = [](const std::string& quantity) {
    return parse_scan(kHeader + "0,0,60,180,0.5\n", "scan.csv",
                      parse_measurement_yaml("quantity: " + quantity, "m.yaml"))
        .points[0]
        .f_per_sr;
  };
  CHECK(value("brdf") == 0.5);
  CHECK(value("relative") == 0.5);
  CHECK(value("brdf_cos") == Approx(1.0).epsilon(1e-15));                            // cos 60° = 1/2
  CHECK(value("reflectance_factor") == Approx(0.15915494309189535).epsilon(1e-15));  // 1/(2π)
}

TEST_CASE("rows at 90 degrees are left out and counted, 89.999 are not", "[fit][scan]") {
  const Measurement scan = parse_scan(kHeader + "30,0,90,180,0.5\n90,0,30,180,0.5\n30,0,89.999,180,0.5\n", "scan.csv");
  CHECK(scan.points.size() == 1);
  CHECK(scan.left_out.at("zenith angle of 90 degrees") == 2);
}

TEST_CASE("what is no scan is refused with file, line and expectation", "[fit][scan]") {
  check_refused("", "scan.csv:1: ", "is empty");
  check_refused("\n\n", "scan.csv:1: ", "is empty");
  check_refused(kHeader, "scan.csv:1: ", "no usable row");
  check_refused(kHeader + "30,0,90,180,0.5\n", "scan.csv:1: ", "no usable row");
  check_refused("theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg\n30,0,30,180\n", "scan.csv:1: ", "brdf_per_sr is missing");
  check_refused("phi_i_deg,theta_r_deg,phi_r_deg,brdf_per_sr\n0,30,180,1\n", "scan.csv:1: ", "theta_i_deg is missing");
  check_refused(kHeader + "30,0,30,180,nan\n", "scan.csv:2: ", "brdf_per_sr is `nan`");
  check_refused(kHeader + "30,0,30,180,inf\n", "scan.csv:2: ", "brdf_per_sr is `inf`");
  check_refused(kHeader + "30,0,30,180,1e999\n", "scan.csv:2: ", "finite");
  check_refused(kHeader + "30,0,30,180,0.5\n30,0,abc,180,0.5\n", "scan.csv:3: ", "theta_r_deg is `abc`");
  check_refused(kHeader + "30,0,30,180,0.5x\n", "scan.csv:2: ", "`0.5x`");
  check_refused(kHeader + "30,0,30,180,\n", "scan.csv:2: ", "brdf_per_sr is ``");
  check_refused(kHeader + "90.001,0,30,180,0.5\n", "scan.csv:2: ", "theta_i_deg is 90.001");
  check_refused(kHeader + "30,0,-1,180,0.5\n", "scan.csv:2: ", "theta_r_deg is -1");
  check_refused(kHeader + "30,0,30,180,0.5\n30,0,30\n", "scan.csv:3: ", "row has 3 cells");
  check_refused(kHeader + "30,0,30,180,0.5,7\n", "scan.csv:2: ", "row has 6 cells");
  check_refused(std::string("\x89PNG\r\n\x1a\n\0\0\0", 11), "scan.csv:", "is not text");
  check_refused("theta_i_deg,phi_i_deg,theta_r_deg,theta_o_deg,phi_r_deg,brdf_per_sr\n1,1,1,1,1,1\n",
                "scan.csv:1: ", "same angle");
  check_refused("theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg,brdf_per_sr,brdf_per_sr\n1,1,1,1,1,1\n",
                "scan.csv:1: ", "twice");
  const std::string with_wavelength = "theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg,brdf_per_sr,wavelength_nm\n";
  check_refused(with_wavelength + "30,0,30,180,0.5,0.55\n", "scan.csv:2: ", "wavelength_nm is 0.55");
  check_refused(with_wavelength + "30,0,30,180,0.5,550\n30,0,30,180,0.5,\n", "scan.csv:1: ", "1 of 2 rows");
  check_refused("theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg,brdf_per_sr,brdf_std_per_sr\n30,0,30,180,0.5,-1\n",
                "scan.csv:2: ", "negative");
}

TEST_CASE("measurement.yaml is read strictly", "[fit][scan]") {
  const Measurement known = parse_measurement_yaml(
      "# a comment\nname: A\nsource: \"B: c\"\nquantity: brdf_cos\nwavelength_nm: 632.8\nmaterial: Au\naperture_deg: "
      "1.5\nsample:\n",
      "m.yaml");
  CHECK(known.source == "B: c");
  CHECK(known.wavelength_nm.value() == 632.8);
  CHECK(known.material.value() == "Au");
  CHECK(known.sample.empty());
  const auto refused = [](const std::string& yaml) { return refusal(kHeader + "30,0,30,180,0.5\n", yaml); };
  CHECK(refused("name: a\nwave_length: 5\n").starts_with("measurement.yaml:2: unknown key `wave_length`"));
  CHECK(refused("quantity: brightness\n").starts_with("measurement.yaml:1: quantity is `brightness`; expected brdf"));
  CHECK(refused("name: a\nname: b\n").starts_with("measurement.yaml:2: `name` appears twice"));
  CHECK(refused("name: [a\n").starts_with("measurement.yaml:"));
  CHECK(refused("wavelength_nm: green\n").starts_with("measurement.yaml:1: wavelength_nm is `green`"));
  CHECK(refused("wavelength_nm: .nan\n").starts_with("measurement.yaml:1: wavelength_nm"));
  CHECK(refused("just text\n").starts_with("measurement.yaml:1: "));
  CHECK(refused("wavelength_nm: 550\nmaterial_wavelength_nm: 550\n").find("material_wavelength_nm") !=
        std::string::npos);
}

TEST_CASE("the bundled measurements are what their notes say", "[fit][scan]") {
  const auto bundled = [](const std::string& name) { return read_measurement(data_folder("measurements") / name); };
  const Measurement ptfe = bundled("ptfe-sintered-nist-532nm");
  CHECK(ptfe.id == "ptfe-sintered-nist-532nm");
  CHECK(ptfe.points.size() == 1824);
  CHECK(ptfe.incidences_deg == std::vector<double>{0, 15, 30, 45, 60, 75});
  CHECK(ptfe.wavelengths() == std::vector<double>{532});
  CHECK(ptfe.mueller_names.size() == 15);
  double sum = 0;  // Germer's data: π·f is about 0.994 on average at normal incidence
  int count = 0;
  for (const ScanPoint& p : ptfe.points)
    if (p.incidence == 0) sum += p.f_per_sr, ++count;
  CHECK(3.141592653589793 * sum / count == Approx(0.994).margin(0.03));

  const Measurement random = bundled("ptfe-sintered-nist-532nm-random");
  CHECK(random.points.size() == 1760);
  CHECK(random.incidences_binned);
  CHECK(random.incidences_deg == std::vector<double>{5, 15, 25, 35, 45, 55, 65, 75});

  const Measurement aluminium = bundled("aluminium-merl");
  CHECK(aluminium.points.size() == 1785);
  CHECK(aluminium.incidences_deg.size() == 7);
  CHECK(aluminium.wavelengths().empty());
  CHECK(aluminium.material.value() == "Al_Rakic");
  CHECK(aluminium.material_wavelength_nm.value() == 550);
  CHECK(aluminium.licence.find("CC BY-SA 4.0") != std::string::npos);
}

TEST_CASE("a bare CSV says nothing of its measurement; a missing path is refused", "[fit][scan]") {
  const auto path = std::filesystem::temp_directory_path() / "gonio bare scan.csv";
  write_file(path, kHeader + "30,0,30,180,0.5\n");
  const Measurement scan = read_measurement(path);
  CHECK(scan.id == "gonio bare scan");
  CHECK(scan.licence.empty());
  CHECK_FALSE(scan.material.has_value());
  std::filesystem::remove(path);
  CHECK_THROWS_AS(read_measurement(path), InputError);
}
