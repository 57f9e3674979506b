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
  double t95 = 0;               ///< Student's quantile for a two-sided 95 % interval; NaN without degrees of freedom
  std::vector<std::string> warnings;  ///< names what is determined only in combination
};

Uncertainty uncertainty(const FitProblem& problem, const Solution& solution);

}  // namespace gonio
