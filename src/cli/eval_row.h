#pragma once
// What `gonio eval` does with one row of its input.
#include "brdf/transmission.h"
#include "cli/subject.h"
#include "fit/csv.h"

namespace gonio::cli {

/// Unit vectors towards light and eye.
struct VectorPair {
  UnitVector<double> i, o;
};

/// One row of the input: angles in degrees, and the wavelength where a column gives it.
struct EvalRow {
  double theta_i_deg, theta_o_deg, phi_deg;
  std::optional<double> wavelength_nm;
  double phi_i_deg;  ///< from the grain; what anisotropic lobes look at
  const CsvRow* row;
  std::optional<VectorPair> vectors = std::nullopt;  ///< in place of the angles, where the columns are components

  bool transmitted() const { return theta_o_deg > 90; }
};

/// Rows of angles, or of unit vectors (columns ix,iy,iz,ox,oy,oz; z > 0). InputError for a missing column, an angle out of range; theta_o_deg above 90 only where the model `transmits`.
std::vector<EvalRow> eval_rows(const CsvTable& table, const std::string& file, bool transmits);

/// How to evaluate: the number type; with polarised light in, or the whole Mueller matrix out.
struct EvalRequest {
  std::string precision = "double";
  std::optional<LinearLight<double>> light;
  bool mueller = false;
};

/// "s", "p" or an angle in degrees from s towards p.
LinearLight<double> linear_light(const std::string& text);

/// `mueller` is 1/sr, empty unless asked for; f_r is of the light asked for (f_t for a transmitted row).
struct EvalResult {
  double f_r_per_sr = 0, coherent_energy = 0;
  std::optional<Mueller<double>> mueller;
};

/// The lobes of a sum are evaluated one by one and added. InputError where polarisation is asked of a row of vectors or of
/// a lobe that does not state it, or transmission of an opaque surface.
EvalResult evaluate_row(const Subject& subject, const EvalRow& row, double wavelength_nm, const EvalRequest& request);

}  // namespace gonio::cli
