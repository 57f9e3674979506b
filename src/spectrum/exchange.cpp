#include "spectrum/exchange.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>

#include "spectrum/nnls.h"

namespace gonio {
namespace {

using Index = Eigen::Index;

constexpr std::size_t kPromising = 5;  ///< candidates of each move that are tried with their true, non-negative weights

}  // namespace

Exchange::Exchange(const SceneProducts& products, std::vector<double> candidates_nm, const Eigen::VectorXd& importance)
    : nm_(std::move(candidates_nm)), count_(static_cast<Index>(nm_.size())) {
  Eigen::MatrixXd radiance(products.size(), count_);
  for (Index j = 0; j < count_; ++j) radiance.col(j) = products.radiance(nm_[static_cast<std::size_t>(j)]);
  problem_ = weight_problem(radiance, products.target(), products.metric(), importance);
}

Exchange::Nodes Exchange::improved(Nodes nodes) const {
  double best = objective(nodes, {});
  for (bool moved = true; moved;) {
    moved = false;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      Nodes others = nodes;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
      const Eigen::VectorXd weight = weights_of(others);
      for (const Index candidate : promising(others, weight, nodes[i])) {
        Nodes trial = others;
        trial.push_back(candidate);
        const double value = objective(trial, weight);
        if (value < best - 1e-9 * std::abs(best)) {
          best = value, nodes[i] = candidate, moved = true;
          break;
        }
      }
    }
  }
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

std::vector<double> Exchange::wavelengths(const Nodes& nodes) const {
  std::vector<double> list;
  for (const Index j : nodes) list.push_back(nm_[static_cast<std::size_t>(j)]);
  return list;
}

Exchange::Nodes Exchange::nearest(const std::vector<double>& nm) const {
  assert(nm.size() <= nm_.size());
  Nodes nodes;
  for (const double wanted : nm) {
    const auto off = [&](Index j) { return std::abs(nm_[static_cast<std::size_t>(j)] - wanted); };
    Index best = -1;
    for (Index j = 0; j < count_; ++j)
      if (std::find(nodes.begin(), nodes.end(), j) == nodes.end() && (best < 0 || off(j) < off(best))) best = j;
    nodes.push_back(best);
  }
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

std::vector<Index> Exchange::unknowns(const Nodes& nodes) const {
  std::vector<Index> list;
  for (Index c = 0; c < 3; ++c)
    for (const Index j : nodes) list.push_back(c * count_ + j);
  return list;
}

Eigen::VectorXd Exchange::weights_of(const Nodes& nodes) const {
  const std::vector<Index> list = unknowns(nodes);
  return nnls(problem_.gram(list, list), problem_.right(list));
}

/// The least of the quadratic problem over non-negative weights of these nodes: -½·rᵀx at the solution. `known`: the
/// weights of all but the last node without it, where the solution is then sought.
double Exchange::objective(const Nodes& nodes, const Eigen::VectorXd& known) const {
  const std::vector<Index> list = unknowns(nodes);
  const Eigen::VectorXd right = problem_.right(list);
  Eigen::VectorXd start;
  if (const Index n = static_cast<Index>(nodes.size()); known.size() == 3 * (n - 1)) {
    start.setZero(3 * n);
    for (Index c = 0; c < 3; ++c) start.segment(c * n, n - 1) = known.segment(c * (n - 1), n - 1);
  }
  return -0.5 * right.dot(nnls(problem_.gram(list, list), right, start));
}

/// The few candidates that promise most beside some nodes, in place of `left_node`: by the squares that each one's
/// three weights would take off, given that the nodes' positive weights follow (a Schur complement), signs left aside.
std::vector<Index> Exchange::promising(const Nodes& nodes, const Eigen::VectorXd& weight, Index left_node) const {
  const std::vector<Index> list = unknowns(nodes);
  std::vector<Index> free;
  for (std::size_t u = 0; u < list.size(); ++u)
    if (weight[static_cast<Index>(u)] > 0) free.push_back(list[u]);
  const Eigen::LLT<Eigen::MatrixXd> factor(problem_.gram(free, free));
  const Eigen::MatrixXd cross = factor.matrixL().solve(problem_.gram(free, Eigen::all));
  const Eigen::VectorXd known = factor.matrixL().solve(Eigen::VectorXd(problem_.right(free)));
  std::vector<std::pair<double, Index>> gains;
  for (Index j = 0; j < count_; ++j) {
    if (j == left_node || std::find(nodes.begin(), nodes.end(), j) != nodes.end()) continue;
    const std::vector<Index> own = unknowns({j});
    const Eigen::MatrixXd part = cross(Eigen::all, own);
    Eigen::Matrix3d left = problem_.gram(own, own);
    left.diagonal() *= 1 + 1e-9;
    left -= part.transpose() * part;
    const Eigen::Vector3d right = Eigen::Vector3d(problem_.right(own)) - part.transpose() * known;
    gains.emplace_back(right.dot(left.ldlt().solve(right)), j);
  }
  const std::size_t few = std::min(gains.size(), kPromising);
  std::partial_sort(gains.begin(), gains.begin() + static_cast<std::ptrdiff_t>(few), gains.end(), std::greater<>());
  std::vector<Index> best;
  for (std::size_t g = 0; g < few; ++g) best.push_back(gains[g].second);
  return best;
}

}  // namespace gonio
