#pragma once
// fit: readers of measured formats, least-squares problems, uncertainty, and what is reported of a fit.
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gonio {

inline constexpr double kNotStated = std::numeric_limits<double>::quiet_NaN();

/// One row of a scan. i = towards the light, o = towards the eye; degrees as in the file, zenith angles below 90.
struct ScanPoint {
  double theta_i_deg = 0, phi_i_deg = 0, theta_o_deg = 0, phi_o_deg = 0;
  double wavelength_nm = kNotStated;
  double f_per_sr = 0;  ///< f_r in sr⁻¹, whatever quantity the file holds (for `relative` in units of its own)
  double f_std_per_sr = kNotStated;  ///< standard deviation stated by the measurement
  std::vector<double> mueller;  ///< normalised by m11, one for each of Measurement::mueller_names; NaN = empty cell
  std::size_t incidence = 0;    ///< index into Measurement::incidences_deg

  bool has_wavelength() const { return wavelength_nm == wavelength_nm; }
  double phi_deg() const { return phi_o_deg - phi_i_deg; }  ///< 180 = mirror side
};

/// A goniophotometric scan and what is known of it. Empty text and empty optionals are "not stated".
struct Measurement {
  std::string id;  ///< the folder's or file's own name
  std::string name, source, licence, instrument, uncertainty, sample;
  std::string quantity = "brdf";  ///< of the file: brdf, brdf_cos, reflectance_factor, relative
  std::optional<double> wavelength_nm, aperture_deg;
  std::optional<std::string> material;  ///< database id
  std::optional<double>
      material_wavelength_nm;  ///< where n and k are taken while wavelength_nm is not stated: an assumption

  std::vector<std::string> mueller_names;
  std::vector<ScanPoint> points;
  /// Incidence angles, increasing: each value that occurs, or, above kMostIncidences of them, the middles of 10° bins.
  std::vector<double> incidences_deg;
  bool incidences_binned = false;
  std::map<std::string, int> left_out;  ///< reason -> number of rows
  std::vector<std::string> notes;       ///< what the reader ignored
  std::vector<std::string> conventions;  ///< how a foreign file was read: quantity, units, azimuth's zero, absolute or relative

  static constexpr std::size_t kMostIncidences = 40;

  /// Wavelengths that occur, increasing; empty when none is stated.
  std::vector<double> wavelengths() const;
};

/// Reads a folder (scan.csv + measurement.yaml) or a bare CSV. InputError `file:line: …` for anything that is not a
/// scan.
Measurement read_measurement(const std::filesystem::path& path);

/// The two parts alone, from text (`file` names it in messages).
Measurement parse_scan(std::string_view csv, const std::string& file, Measurement known = {});
Measurement parse_measurement_yaml(const std::string& text, const std::string& file);

/// Sets incidences_deg and each point's incidence: each angle that occurs (to 1e-6°), or 10° bins where there are too many to be a series.
void group_by_incidence(Measurement& scan);

}  // namespace gonio
