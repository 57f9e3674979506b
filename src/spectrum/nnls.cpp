#include "spectrum/nnls.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

namespace gonio {
namespace {

using Index = Eigen::Index;

/// Below this share of its own diagonal a pivot is rounding: the column depends on those before it.
constexpr double kLeastPivot = 1e-13;

/// The problem scaled to a unit diagonal, and the set of unknowns that may differ from 0.
class ActiveSet {
 public:
  ActiveSet(const Eigen::MatrixXd& gram, const Eigen::VectorXd& right) : x_(Eigen::VectorXd::Zero(right.size())) {
    scale_ = gram.diagonal().unaryExpr([](double d) { return d > 0 ? 1 / std::sqrt(d) : 0.0; });
    gram_ = scale_.asDiagonal() * gram * scale_.asDiagonal();
    right_ = scale_.cwiseProduct(right);
    free_.assign(static_cast<std::size_t>(right.size()), false);
    barred_.assign(static_cast<std::size_t>(right.size()), false);
  }

  /// The bound unknown that would lower the objective fastest; -1 when none does.
  Index steepest() const {
    const Eigen::VectorXd gradient = right_ - gram_ * x_;
    const double least = 1e-12 * (right_.cwiseAbs().maxCoeff() + 1e-300);
    Index best = -1;
    for (Index i = 0; i < x_.size(); ++i)
      if (!free_[at(i)] && !barred_[at(i)] && gradient[i] > least && (best < 0 || gradient[i] > gradient[best]))
        best = i;
    return best;
  }

  /// Frees one unknown and moves to the least squares of the free ones, binding those that would turn negative.
  void take(Index taken) {
    free_[at(taken)] = true;
    if (!solve() || target_[taken] <= 0) {  // it depends on the others, or rounding alone made its gradient positive
      free_[at(taken)] = false, barred_[at(taken)] = true;
      return;
    }
    settle();
    barred_.assign(barred_.size(), false);
  }

  /// Frees what is positive in a guess and settles there; from 0 when those depend on each other.
  void begin(const Eigen::VectorXd& guess) {
    for (Index i = 0; i < x_.size(); ++i)
      if (guess[i] > 0 && scale_[i] > 0) free_[at(i)] = true, x_[i] = guess[i] / scale_[i];
    if (solve()) return settle();
    free_.assign(free_.size(), false);
    x_.setZero();
  }

  Eigen::VectorXd solution() const { return scale_.cwiseProduct(x_); }

 private:
  /// To target_, or as far towards it as all stay >= 0, then on with fewer free unknowns.
  void settle() {
    while (!feasible()) {
      bind_first();
      solve();
    }
    x_ = target_;
  }

  static std::size_t at(Index i) { return static_cast<std::size_t>(i); }

  std::vector<Index> members() const {
    std::vector<Index> list;
    for (Index i = 0; i < x_.size(); ++i)
      if (free_[at(i)]) list.push_back(i);
    return list;
  }

  /// Least squares of the free unknowns into target_; false when they depend on each other.
  bool solve() {
    const std::vector<Index> list = members();
    target_ = Eigen::VectorXd::Zero(x_.size());
    if (list.empty()) return true;
    const Eigen::LLT<Eigen::MatrixXd> factor(gram_(list, list));
    if (factor.info() != Eigen::Success || factor.matrixLLT().diagonal().minCoeff() < std::sqrt(kLeastPivot))
      return false;
    const Eigen::VectorXd values = factor.solve(Eigen::VectorXd(right_(list)));
    for (std::size_t i = 0; i < list.size(); ++i) target_[list[i]] = values[static_cast<Index>(i)];
    return true;
  }

  bool feasible() const {
    for (Index i = 0; i < x_.size(); ++i)
      if (free_[at(i)] && target_[i] <= 0) return false;
    return true;
  }

  /// From x_ towards target_ as far as all stay >= 0; those that reach 0 are bound.
  void bind_first() {
    double step = 1;
    for (Index i = 0; i < x_.size(); ++i)
      if (free_[at(i)] && target_[i] <= 0) step = std::min(step, x_[i] / (x_[i] - target_[i]));
    for (Index i = 0; i < x_.size(); ++i) {
      if (!free_[at(i)]) continue;
      const bool stops = target_[i] <= 0 && x_[i] / (x_[i] - target_[i]) <= step;
      x_[i] += step * (target_[i] - x_[i]);
      if (stops) x_[i] = 0, free_[at(i)] = false;
    }
  }

  Eigen::MatrixXd gram_;
  Eigen::VectorXd scale_, right_, x_, target_;
  std::vector<bool> free_, barred_;
};

}  // namespace

Eigen::VectorXd nnls(const Eigen::MatrixXd& gram, const Eigen::VectorXd& right, const Eigen::VectorXd& start) {
  assert(gram.rows() == right.size() && gram.cols() == right.size());
  ActiveSet set(gram, right);
  if (start.size() == right.size()) set.begin(start);
  for (Index taken; (taken = set.steepest()) >= 0;) set.take(taken);
  return set.solution();
}

}  // namespace gonio
