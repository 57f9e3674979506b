#include "spectrum/node_descent.h"

#include <Eigen/Cholesky>
#include <algorithm>

namespace gonio {
namespace {

using Index = Eigen::Index;

/// How far each node should move, in nm: the step of the linearised problem, damped.
Eigen::VectorXd step_of(const SceneProducts& products, const NodeWeights& at, double damping) {
  const Index n = static_cast<Index>(at.nodes_nm.size());
  std::vector<Index> rows;
  const double least = 1e-3 * at.importance.maxCoeff();
  for (Index i = 0; i < products.size(); ++i)
    if (at.importance[i] > least) rows.push_back(i);
  Eigen::MatrixXd radiance(rows.size(), 2 * n);  // at the nodes, then its slope there
  for (Index j = 0; j < n; ++j) {
    const double nm = at.nodes_nm[static_cast<std::size_t>(j)], lo = std::max(nm - 1, products.lo_nm()),
                 hi = std::min(nm + 1, products.hi_nm());
    radiance.col(j) = products.radiance(nm)(rows);
    radiance.col(n + j) = ((products.radiance(hi) - products.radiance(lo)) / (hi - lo))(rows);
  }
  const WeightProblem problem = weight_problem(radiance, products.target()(rows, Eigen::all),
                                               products.metric()(rows, Eigen::all), at.importance(rows));
  // Unknowns: the positive weights, then the shifts: d/d(shift of j) of component c is weight(j, c)·slope of j.
  Eigen::VectorXd now = Eigen::VectorXd::Zero(6 * n);
  Eigen::MatrixXd unknowns = Eigen::MatrixXd::Zero(6 * n, 4 * n);
  Index free = 0;
  for (Index c = 0; c < 3; ++c)
    for (Index j = 0; j < n; ++j) {
      now[2 * n * c + j] = at.weight(j, c);
      if (at.weight(j, c) > 0) unknowns(2 * n * c + j, free++) = 1;
    }
  for (Index j = 0; j < n; ++j)
    for (Index c = 0; c < 3; ++c) unknowns(2 * n * c + n + j, free + j) = at.weight(j, c);
  unknowns.conservativeResize(Eigen::NoChange, free + n);
  Eigen::MatrixXd gram = unknowns.transpose() * problem.gram * unknowns;
  const Eigen::VectorXd right = unknowns.transpose() * (problem.right - problem.gram * now);
  gram.diagonal().head(free) *= 1 + 1e-10;
  gram.diagonal().tail(n) *= 1 + damping;
  return gram.ldlt().solve(right).tail(n);
}

}  // namespace

bool nodes_allowed(const SceneProducts& products, const std::vector<double>& nodes_nm) {
  for (std::size_t i = 0; i < nodes_nm.size(); ++i) {
    if (!(nodes_nm[i] >= products.lo_nm() && nodes_nm[i] <= products.hi_nm()) || !products.is_lit(nodes_nm[i]))
      return false;
    if (i > 0 && nodes_nm[i] - nodes_nm[i - 1] < kLeastGap_nm) return false;
  }
  return true;
}

NodeWeights descend_nodes(const SceneProducts& products, NodeWeights best, int most_steps, int rounds) {
  double damping = 0.1;
  for (int step = 0, failures = 0; step < most_steps && failures < 4; ++step) {
    const Eigen::VectorXd move = step_of(products, best, damping);
    std::vector<double> nodes = best.nodes_nm;
    for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i] += std::clamp(move[static_cast<Index>(i)], -6.0, 6.0);
    NodeWeights trial = best;
    if (nodes_allowed(products, nodes)) trial = fit_weights(products, nodes, rounds, best.importance);
    if (trial.worst_e2000 < best.worst_e2000 * (1 - 1e-4)) {
      best = std::move(trial);
      damping = std::max(damping * 0.3, 1e-3), failures = 0;
    } else {
      damping *= 5, ++failures;
    }
  }
  return best;
}

}  // namespace gonio
