#include "fit/formats/writers.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <map>
#include <tuple>

#include "base/error.h"
#include "base/files.h"
#include "fit/formats/collect.h"

namespace gonio {
namespace {

std::string one_line(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 32 || c == 127) c = ' ';
  return text;
}

/// A YAML text in double quotes.
std::string quoted(const std::string& text) {
  std::string yaml = "\"";
  for (const char c : one_line(text)) {
    if (c == '"' || c == '\\') yaml += '\\';
    yaml += c;
  }
  return yaml + '"';
}

std::string cell(double value) { return value == value ? fmt::format("{}", value) : std::string(); }

bool has_deviations(const Measurement& scan) {
  return std::any_of(scan.points.begin(), scan.points.end(),
                     [](const ScanPoint& p) { return p.f_std_per_sr == p.f_std_per_sr; });
}

/// The quantity of the values in the points.
std::string quantity_of(const Measurement& scan) { return scan.quantity == "relative" ? "relative" : "brdf"; }

/// A column, unless the YAML's one wavelength says it all.
bool has_wavelength_column(const Measurement& scan) {
  return !scan.wavelengths().empty() &&
         !(scan.wavelength_nm && scan.wavelengths() == std::vector<double>{*scan.wavelength_nm});
}

std::string astm_angles(const ScanPoint& p) {
  return fmt::format("{},{},{},{}", p.theta_i_deg, p.phi_i_deg, p.theta_o_deg, p.phi_o_deg);
}

/// One row a pair of directions, in the order they first appear.
std::vector<std::string> astm_rows(const Measurement& scan, const std::vector<double>& wavelengths_nm) {
  std::vector<std::string> rows;
  if (wavelengths_nm.size() <= 1) {
    for (const ScanPoint& p : scan.points) rows.push_back(fmt::format("{},{}", astm_angles(p), p.f_per_sr));
    return rows;
  }
  std::map<std::tuple<double, double, double, double>, std::size_t> place;
  std::vector<std::map<double, double>> values;
  for (const ScanPoint& p : scan.points) {
    const auto [at, is_new] = place.try_emplace({p.theta_i_deg, p.phi_i_deg, p.theta_o_deg, p.phi_o_deg}, rows.size());
    if (is_new) rows.push_back(astm_angles(p)), values.emplace_back();
    if (!values[at->second].emplace(p.wavelength_nm, p.f_per_sr).second)
      throw input_error("astm: a pair of directions has a wavelength twice ({} nm); expected once", p.wavelength_nm);
  }
  for (std::size_t r = 0; r < rows.size(); ++r) {
    if (values[r].size() != wavelengths_nm.size())
      throw input_error("astm: directions {} have {} of {} wavelengths; expected all", rows[r], values[r].size(),
                        wavelengths_nm.size());
    for (const auto& [nm, value] : values[r]) rows[r] += fmt::format(",{}", value);
  }
  return rows;
}

}  // namespace

std::string scan_csv(const Measurement& scan) {
  const bool deviations = has_deviations(scan), wavelengths = has_wavelength_column(scan);
  std::string csv = "theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg,brdf_per_sr";
  if (wavelengths) csv += ",wavelength_nm";
  if (deviations) csv += ",brdf_std_per_sr";
  for (const std::string& name : scan.mueller_names) csv += "," + name;
  csv += '\n';
  for (const ScanPoint& p : scan.points) {
    csv += fmt::format("{},{},{},{},{}", p.theta_i_deg, p.phi_i_deg, p.theta_o_deg, p.phi_o_deg, p.f_per_sr);
    if (wavelengths) csv += "," + cell(p.wavelength_nm);
    if (deviations) csv += "," + cell(p.f_std_per_sr);
    for (const double m : p.mueller) csv += "," + cell(m);
    csv += '\n';
  }
  return csv;
}

std::string measurement_yaml(const Measurement& scan) {
  std::string yaml;
  for (const std::string& convention : scan.conventions) yaml += "# read as: " + one_line(convention) + "\n";
  for (const auto& [reason, count] : scan.left_out)
    yaml += fmt::format("# left out: {} ({})\n", count, one_line(reason));
  const auto text = [&](const char* key, const std::string& value) {
    if (!value.empty()) yaml += fmt::format("{}: {}\n", key, quoted(value));
  };
  text("name", scan.name), text("source", scan.source), text("licence", scan.licence);
  yaml += fmt::format("quantity: {}\n", quantity_of(scan));
  const auto number = [&](const char* key, const std::optional<double>& value) {
    if (value) yaml += fmt::format("{}: {}\n", key, *value);
  };
  number("wavelength_nm", scan.wavelength_nm);
  text("material", scan.material.value_or(""));
  number("material_wavelength_nm", scan.material_wavelength_nm);
  text("instrument", scan.instrument);
  number("aperture_deg", scan.aperture_deg);
  text("uncertainty", scan.uncertainty), text("sample", scan.sample);
  return yaml;
}

void write_measurement(const Measurement& scan, const std::filesystem::path& folder) {
  make_folder(folder);
  write_file(folder / "measurement.yaml", measurement_yaml(scan));
  write_file(folder / "scan.csv", scan_csv(scan));
}

std::string astm_text(const Measurement& scan) {
  const std::vector<double> wavelengths_nm = scan.wavelengths();
  const std::vector<std::string> rows = astm_rows(scan, wavelengths_nm);
  std::string astm;
  const auto text = [&](const char* key, const std::string& value) {
    if (!value.empty()) astm += fmt::format("{} \"{}\"\n", key, one_line(value));
  };
  text("LAB_NAME", scan.source), text("SYSTEM_NAME", scan.instrument), text("SAMPLE_NAME", scan.name);
  astm +=
      fmt::format("MEAS_NAME BRDF\nANGLE_UNITS degrees\nQUANTITY {}\nNUM_POINTS {}\n", quantity_of(scan), rows.size());
  astm += "VARS theta_i,phi_i,theta_s,phi_s";
  for (const double nm : wavelengths_nm) astm += fmt::format(",{}nm", nm);
  astm += wavelengths_nm.empty() ? ",BRDF\n" : "\n";
  for (const std::string& row : rows) astm += row + '\n';
  return astm;
}

std::vector<std::string> not_in_astm(const Measurement& scan) {
  std::vector<std::string> lost;
  if (has_deviations(scan)) lost.push_back("standard deviations");
  if (!scan.mueller_names.empty()) lost.push_back("Mueller elements");
  const auto text = [&](const std::string& value, const char* name) {
    if (!value.empty()) lost.push_back(name);
  };
  text(scan.licence, "licence"), text(scan.uncertainty, "uncertainty");
  if (scan.sample != scan.name) text(scan.sample, "sample");
  if (scan.material) lost.push_back("material");
  if (scan.aperture_deg) lost.push_back("aperture");
  return lost;
}

std::string merl_bytes(const MerlFunction& f, const MerlGrid& grid) {
  const std::int32_t dims[3] = {grid.theta_h, grid.theta_d, grid.phi_d};
  const std::size_t cells = grid.cells();
  std::string bytes(sizeof dims + 3 * cells * sizeof(double), '\0');
  std::memcpy(bytes.data(), dims, sizeof dims);
  for (std::size_t at = 0; at < cells; ++at) {
    const MerlAngles a = merl_angles_deg(at, grid);
    bool below = false;
    point_of(from_half_difference_deg(a.theta_h_deg, 0, a.theta_d_deg, a.phi_d_deg), below);
    for (std::size_t c = 0; c < 3; ++c) {
      const double value = below ? -1 : f(a.theta_h_deg, a.theta_d_deg, a.phi_d_deg, static_cast<int>(c));
      const double stored = value < 0 ? -1 : value / kMerlScale[c];
      std::memcpy(bytes.data() + sizeof dims + (c * cells + at) * sizeof stored, &stored, sizeof stored);
    }
  }
  return bytes;
}

}  // namespace gonio
