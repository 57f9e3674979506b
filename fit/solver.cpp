#include "fit/solver.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace gonio {
namespace {

/// All residuals in one block: the derivatives come from the models themselves, as Jets.
class AllResiduals final : public ceres::CostFunction {
 public:
  AllResiduals(const FitProblem& problem, int& rejected) : problem_(problem), rejected_(rejected) {
    set_num_residuals(static_cast<int>(problem.points.size()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(problem.free.size()));
  }
  bool Evaluate(const double* const* x, double* residuals, double** jacobians) const override {
    const bool finite = problem_.residuals({x[0], problem_.free.size()}, residuals, jacobians ? jacobians[0] : nullptr);
    if (!finite) ++rejected_;
    return finite;
  }

 private:
  const FitProblem& problem_;
  int& rejected_;
};

ceres::Solver::Options options(double tolerance) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.jacobi_scaling = true;
  options.num_threads = 1;
  options.max_num_iterations = 400;
  options.max_trust_region_radius = 1e32;  // ill-conditioned problems need almost undamped last steps
  options.min_trust_region_radius = 1e-10;
  options.function_tolerance = tolerance;
  options.gradient_tolerance = 1e-20;
  options.parameter_tolerance = 1e-15;
  options.logging_type = ceres::SILENT;
  return options;
}

}  // namespace

Solution solve(const FitProblem& problem, std::vector<double> x, double tolerance) {
  Solution solution;
  const std::size_t count = problem.free.size();
  if (count == 0) {
    std::vector<double> residual(problem.points.size());
    solution.converged = problem.residuals(x, residual.data(), nullptr);
    for (const double r : residual) solution.cost += 0.5 * r * r;
    return solution;
  }
  ceres::Problem ceres_problem;
  for (std::size_t i = 0; i < count; ++i)
    x[i] = std::clamp(x[i], std::log(problem.free[i].lo), std::log(problem.free[i].hi));
  ceres_problem.AddResidualBlock(new AllResiduals(problem, solution.rejected), nullptr, x.data());
  for (std::size_t i = 0; i < count; ++i) {
    ceres_problem.SetParameterLowerBound(x.data(), static_cast<int>(i), std::log(problem.free[i].lo));
    ceres_problem.SetParameterUpperBound(x.data(), static_cast<int>(i), std::log(problem.free[i].hi));
  }
  ceres::Solver::Summary summary;
  ceres::Solve(options(tolerance), &ceres_problem, &summary);
  solution.x = std::move(x);
  solution.cost = summary.final_cost;
  solution.converged = summary.termination_type == ceres::CONVERGENCE;
  solution.iterations = static_cast<int>(summary.iterations.size());
  return solution;
}

Linearised linearise(const FitProblem& problem, const std::vector<double>& x) {
  const auto rows = static_cast<Eigen::Index>(problem.points.size()),
             columns = static_cast<Eigen::Index>(problem.free.size());
  Linearised at;
  at.residual.resize(rows);
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> jacobian(rows, columns);
  at.finite = problem.residuals(x, at.residual.data(), columns > 0 ? jacobian.data() : nullptr);
  at.jacobian = jacobian;
  return at;
}

}  // namespace gonio
