#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "fit/problem.h"
#include "fit/solver.h"

namespace gonio {

/// Below this share of the largest singular value of the column-scaled Jacobian a direction is not seen by the data.
inline constexpr double kIdentifiable = 1e-6;

/// What the data say of the free parameters, all in their logarithms.
struct Uncertainty {
  std::vector<double> standard_error;  ///< of ln(parameter); NaN where not identifiable or at a bound
  std::vector<bool> identifiable, at_bound;
  Eigen::MatrixXd correlation;  ///< 0 outside the diagonal where not identifiable
  double condition = 1;         ///< largest over smallest singular value
  double freedom = 0;           ///< points less parameters inside their boxes
  double t95 = 0;               ///< Student's quantile for a two-sided 95 % interval; NaN without degrees of freedom
  std::vector<std::string> warnings;  ///< names what is determined only in combination
};

/// Of a residual: mean squared one of the fit; where residuals are in standard deviations (Metric::likelihood) not less than 1, so that a
/// lucky sample does not narrow what is stated.
double residual_variance(const FitProblem& problem, const Solution& solution, double freedom);

Uncertainty uncertainty(const FitProblem& problem, const Solution& solution);

}  // namespace gonio
