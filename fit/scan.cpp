#include "fit/scan.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/error.h"
#include "base/files.h"
#include "brdf/directions.h"
#include "fit/csv.h"

namespace gonio {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

/// Where each column stands; kNone = absent.
struct Columns {
  std::size_t theta_i = kNone, phi_i = kNone, theta_o = kNone, phi_o = kNone, f = kNone, f_std = kNone,
              wavelength = kNone;
  std::vector<std::size_t> mueller;
};

bool is_mueller(std::string_view name) {
  return name.size() == 3 && name[0] == 'm' && name[1] >= '1' && name[1] <= '4' && name[2] >= '1' && name[2] <= '4' &&
         name != "m11";
}

Columns find_columns(const CsvTable& table, const std::string& file, Measurement& scan) {
  Columns columns;
  const auto take = [&](std::size_t& place, std::size_t at) {
    if (place != kNone)
      throw input_error("{}:{}: columns `{}` and `{}` are the same angle; expected one of them", file,
                        table.header_line, table.header[place], table.header[at]);
    place = at;
  };
  for (std::size_t at = 0; at < table.header.size(); ++at) {
    const std::string_view name = table.header[at];
    if (name == "theta_i_deg")
      take(columns.theta_i, at);
    else if (name == "phi_i_deg")
      take(columns.phi_i, at);
    else if (name == "theta_r_deg" || name == "theta_o_deg")
      take(columns.theta_o, at);
    else if (name == "phi_r_deg" || name == "phi_o_deg")
      take(columns.phi_o, at);
    else if (name == "brdf_per_sr")
      take(columns.f, at);
    else if (name == "brdf_std_per_sr")
      take(columns.f_std, at);
    else if (name == "wavelength_nm")
      take(columns.wavelength, at);
    else if (is_mueller(name)) {
      columns.mueller.push_back(at);
      scan.mueller_names.emplace_back(name);
    } else {
      std::string shown(name.substr(0, 40));
      for (char& c : shown)
        if (static_cast<unsigned char>(c) < 32 || static_cast<unsigned char>(c) > 126) c = '?';
      scan.notes.push_back(fmt::format("column `{}` is ignored", shown));
    }
  }
  const auto require = [&](std::size_t place, std::string_view name) {
    if (place == kNone)
      throw input_error(
          "{}:{}: column {} is missing; expected theta_i_deg, phi_i_deg, theta_r_deg, phi_r_deg, brdf_per_sr", file,
          table.header_line, name);
  };
  require(columns.theta_i, "theta_i_deg");
  require(columns.phi_i, "phi_i_deg");
  require(columns.theta_o, "theta_r_deg (or theta_o_deg)");
  require(columns.phi_o, "phi_r_deg (or phi_o_deg)");
  require(columns.f, "brdf_per_sr");
  return columns;
}

double wavelength_in_range(double nm, const std::string& file, int line) {
  if (!(nm >= 100 && nm <= 1e5))
    throw input_error("{}:{}: wavelength_nm is {}; expected 100 to 100000 nm", file, line, nm);
  return nm;
}

/// Reads the cells of one row.
struct RowReader {
  const CsvTable& table;
  const CsvRow& row;
  const std::string& file;

  double number(std::size_t column) const {
    return csv_number(row.cells[column], table.header[column], file, row.line);
  }
  double optional_number(std::size_t column) const {
    return column == kNone || row.cells[column].empty() ? kNotStated : number(column);
  }
  double zenith(std::size_t column) const {
    const double theta_deg = number(column);
    if (!(theta_deg >= 0 && theta_deg <= 90))
      throw input_error("{}:{}: {} is {}; expected 0 to 90", file, row.line, table.header[column], theta_deg);
    return theta_deg;
  }
};

/// What a value of the file's quantity is multiplied by to give f_r.
double to_brdf(const std::string& quantity, double theta_o_deg) {
  if (quantity == "brdf_cos") return 1 / cos_deg(theta_o_deg);
  if (quantity == "reflectance_factor") return 1 / kPi<double>;
  return 1;
}

/// false when the row is at 90° and therefore left out (every one of its cells has been checked).
bool read_row(const RowReader& cell, const Columns& columns, const Measurement& scan, ScanPoint& point) {
  point.theta_i_deg = cell.zenith(columns.theta_i);
  point.theta_o_deg = cell.zenith(columns.theta_o);
  point.phi_i_deg = cell.number(columns.phi_i);
  point.phi_o_deg = cell.number(columns.phi_o);
  point.wavelength_nm = cell.optional_number(columns.wavelength);
  if (point.has_wavelength())
    wavelength_in_range(point.wavelength_nm, cell.file, cell.row.line);
  else if (scan.wavelength_nm)
    point.wavelength_nm = *scan.wavelength_nm;
  const double scale = to_brdf(scan.quantity, point.theta_o_deg);
  point.f_per_sr = cell.number(columns.f) * scale;
  point.f_std_per_sr = cell.optional_number(columns.f_std) * scale;
  if (point.f_std_per_sr < 0)
    throw input_error("{}:{}: brdf_std_per_sr is negative; expected 0 or more", cell.file, cell.row.line);
  for (const std::size_t at : columns.mueller) point.mueller.push_back(cell.optional_number(at));
  if (point.theta_i_deg == 90 || point.theta_o_deg == 90) return false;
  if (!std::isfinite(point.f_per_sr))
    throw input_error("{}:{}: brdf_per_sr is {}; expected a value that stays finite as a BRDF", cell.file,
                      cell.row.line, cell.row.cells[columns.f]);
  return true;
}

}  // namespace

void group_by_incidence(Measurement& scan) {
  const auto rounded = [](const ScanPoint& p) { return std::round(p.theta_i_deg * 1e6) / 1e6; };
  std::set<double> distinct;
  for (const ScanPoint& point : scan.points) distinct.insert(rounded(point));
  scan.incidences_binned = distinct.size() > Measurement::kMostIncidences;
  const auto group = [&](const ScanPoint& p) {
    return scan.incidences_binned ? 10 * std::min(8.0, std::floor(rounded(p) / 10)) + 5 : rounded(p);
  };
  std::set<double> groups;
  for (const ScanPoint& point : scan.points) groups.insert(group(point));
  scan.incidences_deg.assign(groups.begin(), groups.end());
  for (ScanPoint& point : scan.points)
    point.incidence = static_cast<std::size_t>(
        std::lower_bound(scan.incidences_deg.begin(), scan.incidences_deg.end(), group(point)) -
        scan.incidences_deg.begin());
}

std::vector<double> Measurement::wavelengths() const {
  std::set<double> distinct;
  for (const ScanPoint& point : points)
    if (point.has_wavelength()) distinct.insert(point.wavelength_nm);
  return {distinct.begin(), distinct.end()};
}

Measurement parse_scan(std::string_view csv, const std::string& file, Measurement known) {
  Measurement scan = std::move(known);
  const CsvTable table = read_csv(csv, file);
  const Columns columns = find_columns(table, file, scan);
  for (const CsvRow& row : table.rows) {
    ScanPoint point;
    if (read_row({table, row, file}, columns, scan, point))
      scan.points.push_back(std::move(point));
    else
      ++scan.left_out["zenith angle of 90 degrees"];
  }
  if (scan.points.empty())
    throw input_error("{}:{}: no usable row; expected at least one with zenith angles below 90", file,
                      table.header_line);
  const auto stated = std::count_if(scan.points.begin(), scan.points.end(), [](auto& p) { return p.has_wavelength(); });
  if (stated != 0 && stated != std::ssize(scan.points))
    throw input_error("{}:{}: the wavelength is stated for {} of {} rows; expected all or none", file,
                      table.header_line, stated, scan.points.size());
  if (stated != 0 && scan.material_wavelength_nm)
    throw input_error("{}:{}: the wavelength is stated; expected no material_wavelength_nm beside it", file,
                      table.header_line);
  group_by_incidence(scan);
  return scan;
}

Measurement read_measurement(const fs::path& path) {
  std::error_code error;
  const bool folder = fs::is_directory(path, error);
  const fs::path csv = folder ? path / "scan.csv" : path, yaml = path / "measurement.yaml";
  Measurement known;
  if (folder && fs::exists(yaml, error)) known = parse_measurement_yaml(read_file(yaml), yaml.string());
  Measurement scan = parse_scan(read_file(csv), csv.string(), std::move(known));
  const fs::path whole = fs::absolute(path, error).lexically_normal();
  scan.id = folder ? (whole.has_filename() ? whole : whole.parent_path()).filename().string() : path.stem().string();
  return scan;
}

}  // namespace gonio
