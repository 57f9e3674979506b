#include "fit/next_measurement.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace gonio {
namespace {

constexpr double kSmallestVariance = 1e-12;  // of the largest JᵀJ: data without errors keep a regular matrix

constexpr double kWellKnown = 0.1;    // standard error of a logarithm
constexpr double kWorthSaying = 1.1;  // factor by which it falls

struct Candidate {
  double theta_i_deg, theta_o_deg, phi_deg;
};

/// The grid; at normal incidence or observation one azimuth stands for all.
std::vector<Candidate> candidates(const NextMeasurementOptions& options) {
  std::vector<Candidate> all;
  const auto count = [&](double last) { return static_cast<int>(std::floor(last / options.step_deg + 1e-9)); };
  for (int i = 0; i <= count(options.last_deg); ++i)
    for (int o = 0; o <= count(options.last_deg); ++o)
      for (int phi = 0; phi <= (i == 0 || o == 0 ? 0 : count(180)); ++phi)
        all.push_back({i * options.step_deg, o * options.step_deg, phi * options.step_deg});
  return all;
}

/// The fit's problem with the candidates as its points, at the values that the model predicts.
FitProblem candidate_problem(const FitProblem& problem, const std::vector<double>& x, std::size_t group,
                             const std::vector<Candidate>& all) {
  const auto like =
      std::find_if(problem.points.begin(), problem.points.end(), [&](const FitPoint& p) { return p.group == group; });
  const FitPoint& model_point = like == problem.points.end() ? problem.points.front() : *like;
  const bool cosine = std::any_of(problem.points.begin(), problem.points.end(), [](auto& p) { return p.weight != 1; });
  FitProblem there = problem;
  there.points.clear();
  for (const Candidate& c : all) {
    FitPoint point = model_point;
    point.directions = directions_from_deg(c.theta_i_deg, c.theta_o_deg, c.phi_deg);
    point.weight = cosine ? point.directions.cos_o : 1;
    there.points.push_back(point);
  }
  const std::vector<double> predicted = there.predict(x);
  for (std::size_t i = 0; i < predicted.size(); ++i) there.points[i].f_per_sr = predicted[i];
  return there;
}

/// Which of the free parameters vary inside their boxes.
std::vector<Eigen::Index> varying(const Uncertainty& errors) {
  std::vector<Eigen::Index> places;
  for (std::size_t i = 0; i < errors.at_bound.size(); ++i)
    if (!errors.at_bound[i]) places.push_back(static_cast<Eigen::Index>(i));
  return places;
}

/// (JᵀJ/s² + prior)⁻¹ of the varying parameters' logarithms.
Eigen::MatrixXd covariance(const FitProblem& problem, const Eigen::MatrixXd& jacobian,
                           const std::vector<Eigen::Index>& places, double variance) {
  const Eigen::MatrixXd columns = jacobian(Eigen::all, places);
  Eigen::MatrixXd precision = columns.transpose() * columns / variance;
  for (std::size_t j = 0; j < places.size(); ++j) {
    const FreeParameter& box = problem.free[static_cast<std::size_t>(places[j])];
    const auto at = static_cast<Eigen::Index>(j);
    const double width = std::log(box.hi / box.lo);
    precision(at, at) += 12 / (width * width);
  }
  return precision.ldlt().solve(Eigen::MatrixXd::Identity(precision.rows(), precision.cols()));
}

/// Position among `places` of the parameter asked for, or of the least known one.
std::optional<Eigen::Index> chosen(const FitProblem& problem, const std::vector<Eigen::Index>& places,
                                   const Eigen::MatrixXd& c, const std::string& name) {
  Eigen::Index least_known = 0;
  if (name.empty()) {
    c.diagonal().maxCoeff(&least_known);
    return least_known;
  }
  for (std::size_t j = 0; j < places.size(); ++j)
    if (problem.free[static_cast<std::size_t>(places[j])].name == name) return static_cast<Eigen::Index>(j);
  return std::nullopt;
}

}  // namespace

std::optional<NextMeasurement> next_measurement(const FitProblem& problem, const Solution& solution,
                                                const NextMeasurementOptions& options) {
  const std::vector<Eigen::Index> places = varying(uncertainty(problem, solution));
  const double freedom = static_cast<double>(problem.points.size()) - static_cast<double>(places.size());
  const Linearised here = linearise(problem, solution.x);
  if (places.empty() || !(freedom > 0) || !here.finite) return std::nullopt;
  const double largest = here.jacobian.colwise().squaredNorm().maxCoeff();
  const double variance = std::max(residual_variance(problem, solution, freedom), kSmallestVariance * largest);
  const Eigen::MatrixXd c = covariance(problem, here.jacobian, places, variance);
  const auto column = chosen(problem, places, c, options.parameter);
  if (!column) return std::nullopt;

  const FreeParameter& parameter = problem.free[static_cast<std::size_t>(places[static_cast<std::size_t>(*column)])];
  const std::vector<Candidate> all = candidates(options);
  const std::size_t group = parameter.group == FreeParameter::kShared ? problem.points.front().group : parameter.group;
  const Eigen::MatrixXd jacobian = linearise(candidate_problem(problem, solution.x, group, all), solution.x).jacobian;
  double most = 0;
  std::size_t best = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Eigen::VectorXd row = jacobian(static_cast<Eigen::Index>(i), places).transpose(), moved = c * row;
    const double won = moved[*column] * moved[*column] / (variance + row.dot(moved));
    if (std::isfinite(won) && won > most) most = won, best = i;
  }
  const double before = c(*column, *column);
  return NextMeasurement{all[best].theta_i_deg, all[best].theta_o_deg, all[best].phi_deg,
                         parameter.name,        std::sqrt(before),     std::sqrt(std::max(before - most, 0.0))};
}

std::string sentence(const NextMeasurement& next) {
  return fmt::format(
      "measuring at theta_i = {:g}, theta_o = {:g}, phi = {:g} would make the standard error of {} {:.2g} times "
      "smaller",
      next.theta_i_deg, next.theta_o_deg, next.phi_deg, next.parameter, next.factor());
}

std::optional<NextMeasurement> advice(const FitProblem& problem, const Solution& solution, const Uncertainty& errors) {
  bool known = true;
  for (std::size_t i = 0; i < problem.free.size(); ++i)
    known = known && (errors.at_bound[i] || errors.standard_error[i] <= kWellKnown);
  if (known) return std::nullopt;
  const auto next = next_measurement(problem, solution);
  return next && next->error_before > kWellKnown && next->factor() > kWorthSaying ? next : std::nullopt;
}

}  // namespace gonio
