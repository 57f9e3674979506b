#pragma once
#include <Eigen/Core>
#include <vector>

#include "spectrum/scene_products.h"

namespace gonio {

/// Weights of a few wavelengths: XYZ = Σ weight(node, ·)·radiance(node).
struct NodeWeights {
  std::vector<double> nodes_nm;  ///< increasing
  Eigen::MatrixXd weight;        ///< nodes × 3, >= 0
  double worst_e2000 = 0;      ///< over every spectrum of the scene, against the 1 nm sum (SceneProducts::differences)
  Eigen::VectorXd importance;  ///< of each spectrum in the least squares: where the worst ones lie; sums to 1
};

/// The quadratic problem of all weights at once: ½·wᵀ·gram·w - rightᵀ·w is half the sum of importance·ΔE² (linearised),
/// but for a constant. Unknown c·n + j is component c (X, Y, Z) of column j of `radiance` (spectra × n).
struct WeightProblem {
  Eigen::MatrixXd gram;
  Eigen::VectorXd right;
};
WeightProblem weight_problem(const Eigen::MatrixXd& radiance, const Eigen::MatrixXd& target,
                             const Eigen::MatrixXd& metric, const Eigen::VectorXd& importance);

/// Non-negative weights that make the worst ΔE_2000 small: least squares whose importances grow with each spectrum's
/// error (C. L. Lawson's algorithm for the minimax problem), `rounds` of it; the best round is returned, judged by
/// ΔE_2000 itself. `importance` to start from may be empty (all equal).
NodeWeights fit_weights(const SceneProducts& products, std::vector<double> nodes_nm, int rounds,
                        const Eigen::VectorXd& importance = {});

/// ΔE_2000 of each spectrum between its weighted sum and the 1 nm sum.
Eigen::VectorXd node_differences(const SceneProducts& products, const NodeWeights& nodes);

/// The same nodes with weights brought to the minimax itself: more rounds, on ΔE_2000 in place of its quadratic form.
NodeWeights polished(const SceneProducts& products, NodeWeights fit);

}  // namespace gonio
