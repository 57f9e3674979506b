#pragma once
#include <Eigen/Core>

namespace gonio {

/// argmin over x >= 0 of ½·xᵀ·G·x - rᵀ·x: least squares with non-negative unknowns, G = AᵀA, r = Aᵀb (or their weighted
/// sums). C. L. Lawson & R. J. Hanson, Solving Least Squares Problems (1974), chapter 23, algorithm NNLS, on the normal
/// equations as in R. Bro & S. de Jong, J. Chemometrics 11, 393-401 (1997). G symmetric, positive semi-definite; it is
/// scaled to a unit diagonal inside, and unknowns that depend linearly on ones already taken stay 0.
/// The result meets the Karush-Kuhn-Tucker conditions: x >= 0, gradient G·x - r >= -tolerance, and 0 where x > 0
/// (tests/spectrum/nnls_test.cpp). A `start` >= 0 near the result (of a similar problem, say) saves steps.
Eigen::VectorXd nnls(const Eigen::MatrixXd& gram, const Eigen::VectorXd& right, const Eigen::VectorXd& start = {});

}  // namespace gonio
