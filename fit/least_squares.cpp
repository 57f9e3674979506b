#include "fit/least_squares.h"

#include <ceres/ceres.h>

#include <Eigen/QR>
#include <algorithm>
#include <boost/random/sobol.hpp>
#include <cassert>
#include <cmath>

namespace gonio {
namespace {

using LongVector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Relative rise of the sum of squares that a polishing step may cause, by rounding of values up to 10⁴ times larger than
/// their residuals. At a minimum the sum is flat and tells parameters apart only to the root of this; that the steps get
/// shorter tells them apart to the end.
constexpr long double kFlat = 1e-14L;

/// All residuals in one block.
class OneBlock final : public ceres::CostFunction {
 public:
  OneBlock(const ResidualFunction& function, int& rejected) : function_(function), rejected_(rejected) {
    set_num_residuals(function.residuals);
    mutable_parameter_block_sizes()->push_back(function.parameters);
  }
  bool Evaluate(const double* const* x, double* residuals, double** jacobians) const override {
    const std::span<const double> at(x[0], static_cast<std::size_t>(function_.parameters));
    const bool finite = function_.in_double(at, residuals, jacobians != nullptr ? jacobians[0] : nullptr);
    if (!finite) ++rejected_;
    return finite;
  }

 private:
  const ResidualFunction& function_;
  int& rejected_;
};

ceres::Solver::Options ceres_options(const LeastSquaresOptions& options) {
  ceres::Solver::Options to;
  to.trust_region_strategy_type = options.method == TrustRegion::dogleg ? ceres::DOGLEG : ceres::LEVENBERG_MARQUARDT;
  to.linear_solver_type = ceres::DENSE_QR;
  to.jacobi_scaling = true;
  to.num_threads = 1;
  to.max_num_iterations = options.most_iterations;
  to.max_num_consecutive_invalid_steps = 100;  // a step into the not finite halves the region; that is no failure
  to.max_trust_region_radius = 1e32;           // ill-conditioned problems need almost undamped last steps
  to.min_trust_region_radius = 1e-20;
  to.function_tolerance = options.tolerance;
  to.gradient_tolerance = 1e-20;
  to.parameter_tolerance = 1e-15;
  to.logging_type = ceres::SILENT;
  return to;
}

void set_bounds(ceres::Problem& problem, std::span<const Range> box, std::vector<double>& x) {
  for (std::size_t j = 0; j < box.size(); ++j) {
    const int at = static_cast<int>(j);
    if (std::isfinite(box[j].lo)) problem.SetParameterLowerBound(x.data(), at, box[j].lo);
    if (std::isfinite(box[j].hi)) problem.SetParameterUpperBound(x.data(), at, box[j].hi);
  }
}

bool finite_at(const ResidualFunction& function, const std::vector<double>& x) {
  std::vector<double> residual(function.residuals), jacobian(residual.size() * x.size());
  return function.in_double(x, residual.data(), jacobian.data());
}

LeastSquaresResult minimise_roughly(const ResidualFunction& function, std::vector<double> x, std::span<const Range> box,
                                    const LeastSquaresOptions& options) {
  assert(std::ssize(x) == function.parameters && (box.empty() || box.size() == x.size()));
  for (std::size_t j = 0; j < box.size(); ++j) x[j] = std::clamp(x[j], box[j].lo, box[j].hi);
  LeastSquaresResult result;
  if (!finite_at(function, x)) {
    result.x = std::move(x), result.rejected = 1;
    return result;
  }
  ceres::Problem problem;
  problem.AddResidualBlock(new OneBlock(function, result.rejected), nullptr, x.data());
  set_bounds(problem, box, x);
  ceres::Solver::Summary summary;
  ceres::Solve(ceres_options(options), &problem, &summary);
  result.x = std::move(x);
  if (summary.IsSolutionUsable()) result.sum_of_squares = 2 * summary.final_cost;
  result.converged = summary.termination_type == ceres::CONVERGENCE;
  result.iterations = static_cast<int>(summary.iterations.size());
  return result;
}

/// Residuals and Jacobian in long double; from those in double where the function offers no others.
struct LongLinearised {
  LongVector residual;
  LongMatrix jacobian;
  bool finite = false;

  long double sum_of_squares() const { return residual.squaredNorm(); }
};

LongLinearised linearise_long(const ResidualFunction& function, const LongVector& x) {
  const Eigen::Index rows = function.residuals, columns = function.parameters;
  LongLinearised at{LongVector(rows), LongMatrix(rows, columns)};
  if (function.in_long_double) {
    const std::span<const long double> values(x.data(), static_cast<std::size_t>(columns));
    at.finite = function.in_long_double(values, at.residual.data(), at.jacobian.data());
    return at;
  }
  const Eigen::VectorXd rounded = x.cast<double>();
  Eigen::VectorXd residual(rows);
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> jacobian(rows, columns);
  at.finite = function.in_double({rounded.data(), static_cast<std::size_t>(columns)}, residual.data(), jacobian.data());
  at.residual = residual.cast<long double>(), at.jacobian = jacobian.cast<long double>();
  return at;
}

/// Whether a parameter lies on an end of its range and the sum of squares falls beyond that end.
bool held_by_range(const Range& range, long double x, long double gradient) {
  return (x <= range.lo && gradient > 0) || (x >= range.hi && gradient < 0);
}

/// Takes the parameters that their ranges hold out of the Jacobian.
void hold(std::span<const Range> box, const LongVector& x, LongLinearised& at) {
  const LongVector gradient = at.jacobian.transpose() * at.residual;
  for (std::size_t j = 0; j < box.size(); ++j) {
    const auto column = static_cast<Eigen::Index>(j);
    if (held_by_range(box[j], x[column], gradient[column])) at.jacobian.col(column).setZero();
  }
}

/// The step -J⁺r, with the columns of J scaled to length 1 before they are decomposed; 0 along columns of zeros.
LongVector gauss_newton_step(const LongLinearised& at) {
  LongVector length = at.jacobian.colwise().norm().transpose();
  for (long double& l : length) l = l > 0 ? l : 1;
  const Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic> scaled =
      at.jacobian * length.cwiseInverse().asDiagonal();
  return -scaled.colPivHouseholderQr().solve(at.residual).cwiseQuotient(length);
}

bool inside(std::span<const Range> box, const LongVector& x) {
  for (std::size_t j = 0; j < box.size(); ++j)
    if (!(x[static_cast<Eigen::Index>(j)] >= box[j].lo && x[static_cast<Eigen::Index>(j)] <= box[j].hi)) return false;
  return true;
}

}  // namespace

void polish(const ResidualFunction& function, std::span<const Range> box, const LeastSquaresOptions& options,
            LeastSquaresResult& result) {
  LongVector x = Eigen::Map<const Eigen::VectorXd>(result.x.data(), std::ssize(result.x)).cast<long double>();
  LongLinearised at = linearise_long(function, x);
  if (!at.finite) return;
  long double last = std::numeric_limits<long double>::infinity();
  for (int count = 0; count < options.most_polishing_steps; ++count) {
    hold(box, x, at);
    const LongVector step = gauss_newton_step(at), next = x + step;
    const long double length = (at.jacobian * step).norm();
    if (!(length < last) || !inside(box, next)) break;
    LongLinearised there = linearise_long(function, next);
    if (!there.finite || !(there.sum_of_squares() <= (1 + kFlat) * at.sum_of_squares())) break;
    x = next, at = std::move(there), last = length;
    ++result.polishing_steps;
  }
  result.sum_of_squares = static_cast<double>(at.sum_of_squares());
  for (std::size_t j = 0; j < result.x.size(); ++j) result.x[j] = static_cast<double>(x[static_cast<Eigen::Index>(j)]);
}

LeastSquaresResult minimise(const ResidualFunction& function, std::vector<double> start, std::span<const Range> box,
                            const LeastSquaresOptions& options) {
  LeastSquaresResult result = minimise_roughly(function, std::move(start), box, options);
  polish(function, box, options, result);
  return result;
}

std::vector<double> sobol_start(std::span<const Range> box, int index) {
  boost::random::sobol engine(box.size());
  engine.discard((1 + static_cast<std::uint64_t>(index)) * box.size());
  std::vector<double> x;
  for (const Range& range : box) {
    assert(std::isfinite(range.lo) && std::isfinite(range.hi) && range.lo <= range.hi);
    const double u = static_cast<double>(engine()) / static_cast<double>(engine.max());
    const double sign = range.hi < 0 ? -1 : 1, ratio = range.hi / range.lo;
    x.push_back(range.lo * range.hi > 0 ? sign * std::abs(range.lo) * std::pow(ratio, u)
                                        : range.lo + u * (range.hi - range.lo));
  }
  return x;
}

LeastSquaresResult minimise_from_many(const ResidualFunction& function, const std::vector<double>& start,
                                      std::span<const Range> box, int starts, const LeastSquaresOptions& options) {
  std::vector<LeastSquaresResult> ends;
  for (int s = 0; s < starts; ++s)
    ends.push_back(minimise_roughly(function, s == 0 ? start : sobol_start(box, s - 1), box, options));
  LeastSquaresResult best = *std::min_element(
      ends.begin(), ends.end(), [](const auto& a, const auto& b) { return a.sum_of_squares < b.sum_of_squares; });
  best.starts = starts;
  best.starts_at_this_minimum = static_cast<int>(std::count_if(ends.begin(), ends.end(), [&](const auto& end) {
    return end.sum_of_squares <= best.sum_of_squares * (1 + 1e-9);
  }));
  polish(function, box, options, best);
  return best;
}

}  // namespace gonio
