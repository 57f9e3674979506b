#include "spectrum/weight_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "spectrum/nnls.h"

namespace gonio {
namespace {

using Index = Eigen::Index;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Spectra whose error stays below this share of the worst are left out of a round: they do not decide it.
constexpr double kLeastError = 0.25;

/// ΔE_2000 of each spectrum by the quadratic form at its target.
Eigen::VectorXd linear_errors(const Eigen::MatrixXd& xyz, const Eigen::MatrixXd& target,
                              const Eigen::MatrixXd& metric) {
  const Eigen::ArrayXXd d = (xyz - target).array();
  const auto m = metric.array();
  const auto x = d.col(0), y = d.col(1), z = d.col(2);
  return (m.col(0) * x * x + m.col(3) * y * y + m.col(5) * z * z +
          2 * (m.col(1) * x * y + m.col(2) * x * z + m.col(4) * y * z))
      .max(0.0)
      .sqrt();
}

/// Some spectra of a scene, at the nodes.
struct Part {
  Eigen::MatrixXd radiance, target, metric;
  Eigen::VectorXd share;

  Part some(const std::vector<Index>& rows) const {
    return {radiance(rows, Eigen::all), target(rows, Eigen::all), metric(rows, Eigen::all), share(rows)};
  }
  Eigen::VectorXd errors(const Eigen::MatrixXd& weight) const {
    return linear_errors(radiance * weight, target, metric);
  }
};

struct Rounds {
  Eigen::MatrixXd weight;
  double worst = kInfinity;
  Eigen::VectorXd share;
};

/// Lawson's iteration over some spectra; the best of its rounds.
Rounds lawson(const Part& part, int rounds, Eigen::VectorXd start) {
  Rounds best;
  Eigen::VectorXd share = part.share / part.share.sum();
  for (int round = 0; round < rounds; ++round) {
    const WeightProblem problem = weight_problem(part.radiance, part.target, part.metric, share);
    start = nnls(problem.gram, problem.right, start);
    const Eigen::MatrixXd weight = start.reshaped(part.radiance.cols(), 3);
    const Eigen::VectorXd error = part.errors(weight);
    const double worst = error.maxCoeff();
    if (worst < best.worst) best = {weight, worst, share};
    share = share.cwiseProduct(error);
    const double total = share.sum();
    if (!(total > 0)) break;
    share /= total;
  }
  return best;
}

}  // namespace

WeightProblem weight_problem(const Eigen::MatrixXd& radiance, const Eigen::MatrixXd& target,
                             const Eigen::MatrixXd& metric, const Eigen::VectorXd& importance) {
  const Index n = radiance.cols();
  constexpr int kElement[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
  WeightProblem problem{Eigen::MatrixXd(3 * n, 3 * n), Eigen::VectorXd::Zero(3 * n)};
  for (int c = 0; c < 3; ++c)
    for (int d = c; d < 3; ++d) {
      const Eigen::VectorXd share = importance.cwiseProduct(metric.col(kElement[c][d]));
      const Eigen::MatrixXd block = radiance.transpose() * (share.asDiagonal() * radiance);
      problem.gram.block(c * n, d * n, n, n) = block;
      problem.gram.block(d * n, c * n, n, n) = block;  // symmetric in itself
      problem.right.segment(c * n, n) += radiance.transpose() * share.cwiseProduct(target.col(d));
      if (c != d) problem.right.segment(d * n, n) += radiance.transpose() * share.cwiseProduct(target.col(c));
    }
  return problem;
}

NodeWeights fit_weights(const SceneProducts& products, std::vector<double> nodes_nm, int rounds,
                        const Eigen::VectorXd& importance) {
  const Index n = static_cast<Index>(nodes_nm.size()), rows = products.size();
  const Eigen::VectorXd equal = Eigen::VectorXd::Constant(rows, 1.0 / static_cast<double>(rows));
  Part all{Eigen::MatrixXd(rows, n), products.target(), products.metric(),
           importance.size() == rows ? Eigen::VectorXd(0.9 * importance + 0.1 * equal) : equal};
  for (Index j = 0; j < n; ++j) all.radiance.col(j) = products.radiance(nodes_nm[static_cast<std::size_t>(j)]);

  Rounds best = lawson(all, 2, {});
  for (int done = 2; done < rounds;) {  // on the spectra that decide, then all again
    const Eigen::VectorXd error = all.errors(best.weight);
    const double worst = error.maxCoeff();
    std::vector<Index> deciding;
    for (Index i = 0; i < rows; ++i)
      if (error[i] >= kLeastError * worst) deciding.push_back(i);
    const int now = std::min(rounds - done, 10);
    const Rounds some = lawson(all.some(deciding), now, best.weight.reshaped());
    done += now;
    const double whole = all.errors(some.weight).maxCoeff();
    all.share *= 0.05;  // spectra left out keep a little, so that they may come back
    for (std::size_t i = 0; i < deciding.size(); ++i) all.share[deciding[i]] = some.share[static_cast<Index>(i)];
    if (whole < best.worst) best.weight = some.weight, best.worst = whole, best.share = all.share / all.share.sum();
  }
  const double worst = products.differences(all.radiance * best.weight).maxCoeff();
  return {std::move(nodes_nm), best.weight, worst, best.share};
}

Eigen::VectorXd node_differences(const SceneProducts& products, const NodeWeights& nodes) {
  Eigen::MatrixXd xyz = Eigen::MatrixXd::Zero(products.size(), 3);
  for (std::size_t j = 0; j < nodes.nodes_nm.size(); ++j)
    xyz += products.radiance(nodes.nodes_nm[j]) * nodes.weight.row(static_cast<Index>(j));
  return products.differences(xyz);
}

NodeWeights polished(const SceneProducts& products, NodeWeights fit) {
  const Index n = fit.weight.rows();
  std::vector<Index> deciding;
  Eigen::MatrixXd radiance(products.size(), n);
  for (Index j = 0; j < n; ++j) radiance.col(j) = products.radiance(fit.nodes_nm[static_cast<std::size_t>(j)]);
  const Eigen::VectorXd error = products.differences(radiance * fit.weight);
  for (Index i = 0; i < products.size(); ++i)
    if (error[i] >= kLeastError * fit.worst_e2000) deciding.push_back(i);
  const SceneProducts scene = products.some(deciding);
  Part part{radiance(deciding, Eigen::all), scene.target(), scene.metric(), fit.importance(deciding).array() + 1e-6};
  Eigen::MatrixXd weight = fit.weight;
  for (int outer = 0; outer < 8; ++outer) {
    const Eigen::VectorXd linear = linear_errors(part.radiance * weight, part.target, scene.metric()),
                          exact = scene.differences(part.radiance * weight);
    for (Index i = 0; i < scene.size(); ++i)
      part.metric.row(i) =
          scene.metric().row(i) * (linear[i] > 0 ? std::clamp(square(exact[i] / linear[i]), 0.5, 2.0) : 1.0);
    const Rounds rounds = lawson(part, 30, weight.reshaped());
    weight = rounds.weight, part.share = rounds.share;
    const double worst = products.differences(radiance * weight).maxCoeff();
    if (worst < fit.worst_e2000) {
      fit.worst_e2000 = worst, fit.weight = weight;
      fit.importance.setZero();
      for (std::size_t i = 0; i < deciding.size(); ++i)
        fit.importance[deciding[i]] = rounds.share[static_cast<Index>(i)];
    }
  }
  return fit;
}

}  // namespace gonio
