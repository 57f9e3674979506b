// Ceres on the residuals of a FitProblem, as a user of Ceres would write it: what the solver in lanes is compared with.
#include <ceres/autodiff_cost_function.h>
#include <ceres/numeric_diff_cost_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include "assess/fit_speed.h"
#include "base/error.h"
#include "base/jet.h"
#include "brdf/brdf.h"

namespace gonio {
namespace {

/// The lobe of three models without kd, ks; values in the model's order.
template <class T>
T lobe_of(ModelId id, const T* values, const FitPoint& point, const Interface<T>& surface) {
  const T wavelength_um(point.wavelength_um);
  if (id == ModelId::torrance_sparrow)
    return lobe_value<T>(TorranceSparrow<T>{kSqrt2<T> * values[0]}, point.directions, surface, wavelength_um);
  if (id == ModelId::ggx) return lobe_value<T>(Ggx<T>{values[0], values[1]}, point.directions, surface, wavelength_um);
  return lobe_value<T>(BeckmannKirchhoff<T>{values[0], values[1]}, point.directions, surface, wavelength_um);
}

/// ψ of the metric in the number type.
template <class T>
T compared(const FitProblem& problem, const T& f, const FitPoint& point) {
  using std::cbrt;
  using std::log;
  if (problem.metric == Metric::log) return log(f + problem.floor_per_sr);
  return problem.metric == Metric::linear ? f * point.weight : cbrt(f * point.weight);
}

/// One point's residual; all of the model's parameters are free, kd and ks last.
template <int kParameters>
struct PointResidual {
  const FitProblem* problem;
  const FitPoint* point;
  double measured;  ///< ψ of it

  template <class T>
  bool operator()(const T* x, T* residual) const {
    using std::exp;
    T values[kParameters];
    for (int i = 0; i < kParameters; ++i) values[i] = exp(x[i]);
    const Interface<T> surface{T(point->surface.n), T(point->surface.k), point->surface.perfect};
    const T f = values[kParameters - 2] / kPi<double> +
                values[kParameters - 1] * lobe_of<T>(problem->model.first().id, values, *point, surface);
    residual[0] = (compared(*problem, f, *point) - measured) * point->confidence;
    return true;
  }
};

template <int kParameters>
ceres::CostFunction* cost_of(const FitProblem& problem, const FitPoint& point, Derivatives derivatives) {
  using Residual = PointResidual<kParameters>;
  auto* residual = new Residual{&problem, &point, problem.compared(point.f_per_sr, point)};
  if (derivatives == Derivatives::jet) return new ceres::AutoDiffCostFunction<Residual, 1, kParameters>(residual);
  return new ceres::NumericDiffCostFunction<Residual, ceres::CENTRAL, 1, kParameters>(residual);
}

ceres::CostFunction* cost_of(const FitProblem& problem, const FitPoint& point, Derivatives derivatives) {
  return problem.free.size() == 3 ? cost_of<3>(problem, point, derivatives) : cost_of<4>(problem, point, derivatives);
}

void refuse_others(const FitProblem& problem) {
  const ModelId id = problem.model.first().id;
  const bool known = id == ModelId::torrance_sparrow || id == ModelId::ggx || id == ModelId::beckmann_kirchhoff;
  if (!known || problem.free.size() != problem.model.parameters().size() || problem.loss != Loss::none)
    throw input_error(
        "{}: not compared with Ceres; expected torrance-sparrow, ggx or beckmann-kirchhoff, every "
        "parameter free and shared",
        problem.model.name());
}

}  // namespace

Solution solve_with_ceres(const FitProblem& problem, std::span<const std::size_t> points, std::vector<double> x,
                          Derivatives derivatives, double tolerance) {
  refuse_others(problem);
  ceres::Problem sum;
  for (const std::size_t p : points)
    sum.AddResidualBlock(cost_of(problem, problem.points[p], derivatives), nullptr, x.data());
  for (std::size_t i = 0; i < x.size(); ++i) {
    sum.SetParameterLowerBound(x.data(), int(i), std::log(problem.free[i].lo));
    sum.SetParameterUpperBound(x.data(), int(i), std::log(problem.free[i].hi));
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.function_tolerance = tolerance, options.parameter_tolerance = 1e-15, options.gradient_tolerance = 1e-300;
  options.max_num_iterations = 300, options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &sum, &summary);
  Solution solution;
  solution.x = std::move(x), solution.cost = summary.final_cost;
  solution.converged = summary.termination_type == ceres::CONVERGENCE;
  solution.iterations = int(summary.iterations.size());
  return solution;
}

Linearised linearise_with_ceres(const FitProblem& problem, const std::vector<double>& x, Derivatives derivatives) {
  refuse_others(problem);
  const auto count = Eigen::Index(problem.points.size()), columns = Eigen::Index(x.size());
  Linearised result{Eigen::VectorXd(count), Eigen::MatrixXd(count, columns), true};
  Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor> row(columns);
  const double* at = x.data();
  double* slopes = row.data();
  for (Eigen::Index p = 0; p < count; ++p) {
    const std::unique_ptr<ceres::CostFunction> cost(cost_of(problem, problem.points[std::size_t(p)], derivatives));
    result.finite &= cost->Evaluate(&at, &result.residual[p], &slopes);
    result.jacobian.row(p) = row;
  }
  result.finite &= result.residual.allFinite() && result.jacobian.allFinite();
  return result;
}

}  // namespace gonio
