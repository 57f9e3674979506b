#pragma once
// Writers of measured formats; what they write, the readers here read back.
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "fit/formats/merl.h"
#include "fit/scan.h"

namespace gonio {

/// scan.csv and measurement.yaml of a measurement: every number in the shortest decimal that reads back to the same
/// double; values as BRDF (or relative), whatever quantity was read. How it was read stands in the YAML's comments.
std::string scan_csv(const Measurement& scan);
std::string measurement_yaml(const Measurement& scan);

/// The folder of the two; each file appears whole.
void write_measurement(const Measurement& scan, const std::filesystem::path& folder);

/// ASTM E1392 text in degrees, with gonio's keys ANGLE_UNITS and QUANTITY, a column a wavelength. InputError where not
/// every pair of directions has each wavelength once.
std::string astm_text(const Measurement& scan);
/// What of this measurement has no place in such a file.
std::vector<std::string> not_in_astm(const Measurement& scan);

/// f_r in sr⁻¹ by half and difference angles in degrees; channel 0, 1, 2 = red, green, blue. Negative: no value.
using MerlFunction = std::function<double(double theta_h_deg, double theta_d_deg, double phi_d_deg, int channel)>;

/// The bytes of a MERL file: f at the middles of the cells, divided by the channel's scale; -1 for cells with a direction
/// below the horizon.
std::string merl_bytes(const MerlFunction& f, const MerlGrid& grid = {});

}  // namespace gonio
