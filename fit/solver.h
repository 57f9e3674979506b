#pragma once
#include <Eigen/Core>
#include <vector>

#include "fit/problem.h"

namespace gonio {

/// Where one start ended.
struct Solution {
  std::vector<double> x;
  double cost = 0;  ///< ½ Σ residual²
  bool converged = false;
  int iterations = 0;
  int rejected = 0;  ///< evaluations that were not finite and therefore refused
};

/// Levenberg-Marquardt (Ceres, dense QR, bounds) from x until nothing improves in double precision.
Solution solve(const FitProblem& problem, std::vector<double> x);

/// Residuals and Jacobian at x.
struct Linearised {
  Eigen::VectorXd residual;
  Eigen::MatrixXd jacobian;
  bool finite = false;
};
Linearised linearise(const FitProblem& problem, const std::vector<double>& x);

}  // namespace gonio
