#pragma once
#include "spectrum/weight_fit.h"

namespace gonio {

/// Candidate wavelengths with the least squares problem over the weights of all of them at once, and the search among
/// them that moves one node at a time (an exchange algorithm, as for optimal designs: V. V. Fedorov, Theory of Optimal
/// Experiments, 1972).
class Exchange {
 public:
  using Nodes = std::vector<Eigen::Index>;  ///< places among the candidates

  /// Candidates increasing, in nm; `importance` of each spectrum.
  Exchange(const SceneProducts& products, std::vector<double> candidates_nm, const Eigen::VectorXd& importance);

  /// Moves one node at a time to the candidate that lowers the sum of squares most, until none does.
  Nodes improved(Nodes nodes) const;

  const std::vector<double>& candidates_nm() const { return nm_; }
  std::vector<double> wavelengths(const Nodes& nodes) const;
  /// Places of the candidates nearest to these wavelengths, all different.
  Nodes nearest(const std::vector<double>& nm) const;

 private:
  std::vector<Eigen::Index> unknowns(const Nodes& nodes) const;
  Eigen::VectorXd weights_of(const Nodes& nodes) const;
  double objective(const Nodes& nodes, const Eigen::VectorXd& known) const;
  std::vector<Eigen::Index> promising(const Nodes& nodes, const Eigen::VectorXd& weight, Eigen::Index left_node) const;

  std::vector<double> nm_;
  Eigen::Index count_;
  WeightProblem problem_;
};

}  // namespace gonio
