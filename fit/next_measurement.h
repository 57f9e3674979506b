#pragma once
#include <optional>
#include <string>

#include "fit/problem.h"
#include "fit/solver.h"
#include "fit/uncertainty.h"

namespace gonio {

/// The further pair of directions that would tell most about the parameter that a fit knows least.
struct NextMeasurement {
  double theta_i_deg = 0, theta_o_deg = 0, phi_deg = 0;  ///< phi = phi_o - phi_i; 180 = mirror side
  std::string parameter;
  double error_before = 0, error_after = 0;  ///< standard error of ln(parameter), without and with one point there

  double factor() const { return error_before / error_after; }
};

struct NextMeasurementOptions {
  double step_deg = 5;      ///< of theta_i, theta_o and phi
  double last_deg = 85;     ///< largest zenith angle that the instrument reaches
  std::string parameter{};  ///< whose error is to fall; empty: the one whose logarithm has the largest standard error
};

/// Evaluates every pair of the grid (theta_i, theta_o <= last_deg; phi from 0 to 180) as one more point, of the same residual
/// variance s² as those of the fit, at the value that the model predicts there. With A = JᵀJ and j the predicted row, its covariance
/// is s²·(A + j jᵀ)⁻¹ = s²·(A⁻¹ - A⁻¹j jᵀA⁻¹/(1 + jᵀA⁻¹j)) (Sherman & Morrison 1950; the D- and c-optimal designs of Fedorov 1972,
/// Theory of Optimal Experiments, choose points by the same update). To stay regular where the points leave a direction open, the search
/// box enters as a prior: width/√12 is the standard deviation of the logarithm. Parameters at a bound are taken as known. The wavelength is that
/// of the parameter (kd, ks of one wavelength), else the first one's. Local: what the model says at the fitted values.
/// None without free parameters inside their boxes or without degrees of freedom. tests/fit/next_measurement_test.cpp.
std::optional<NextMeasurement> next_measurement(const FitProblem& problem, const Solution& solution,
                                                const NextMeasurementOptions& options = {});

/// "measuring at theta_i = 75, theta_o = 80, phi = 180 would make the standard error of sigma_um 3.1 times smaller"
std::string sentence(const NextMeasurement& next);

/// What a fit says by itself: none while the logarithm of every parameter is known to a tenth, or where no point would win a tenth.
std::optional<NextMeasurement> advice(const FitProblem& problem, const Solution& solution, const Uncertainty& errors);

}  // namespace gonio
