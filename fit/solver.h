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

/// Relative decrease of the cost by a step below which a solve ends. Data that the model fits exactly are solved to the
/// last digit with either; data it does not fit converge linearly, and only the best start is worth kPolish.
inline constexpr double kSearch = 1e-10, kPolish = 1e-15;

/// Levenberg-Marquardt (Ceres, dense QR, bounds) from x.
Solution solve(const FitProblem& problem, std::vector<double> x, double tolerance = kPolish);

/// Residuals and Jacobian at x.
struct Linearised {
  Eigen::VectorXd residual;
  Eigen::MatrixXd jacobian;
  bool finite = false;
};
Linearised linearise(const FitProblem& problem, const std::vector<double>& x);

}  // namespace gonio
