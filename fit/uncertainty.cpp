#include "fit/uncertainty.h"

#include <Eigen/SVD>
#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>

#include "base/error.h"

namespace gonio {
namespace {

constexpr double kAtBound = 1e-9;      // of the box's logarithmic width
constexpr double kUndetermined = 1.0;  // standard error of a logarithm from which on a factor e is within the error
constexpr double kSameDirection =
    0.02;  // how far from a ratio of small whole numbers a direction may be to be named so

bool on_bound(const FreeParameter& box, double x) {
  const double lo = std::log(box.lo), hi = std::log(box.hi), near = kAtBound * (hi - lo);
  return x - lo <= near || hi - x <= near;
}

/// The exponents by which two parameters p^a q^b combine into what the data do determine, when (du, dv) is the
/// direction in logarithms that they do not: a·du + b·dv = 0, as small whole numbers or as they are.
std::string combination(const std::string& p, double du, const std::string& q, double dv) {
  for (int b = 1; b <= 4; ++b)
    for (int a = 1; a <= 4; ++a)
      if (std::abs(std::abs(a * du) - std::abs(b * dv)) < kSameDirection * std::abs(b * dv)) {
        const auto power = [](const std::string& name, int n) { return n == 1 ? name : fmt::format("{}^{}", name, n); };
        return fmt::format("{}{}{}", power(p, a), du * dv > 0 ? "/" : "*", power(q, b));
      }
  return fmt::format("{}*{}^{:.3g}", p, q, -du / dv);
}

/// A direction of the free parameters' logarithms that the data do not determine, in words.
std::string describe(const FitProblem& problem, const std::vector<std::size_t>& moving,
                     const Eigen::VectorXd& direction, const std::string& why) {
  if (moving.size() == 1)
    return fmt::format("{} is not determined by these data ({})", problem.free[moving[0]].name, why);
  if (moving.size() == 2) {
    const std::string &p = problem.free[moving[0]].name, &q = problem.free[moving[1]].name;
    return fmt::format("{} and {} cannot be told apart: only {} is determined by these data ({})", p, q,
                       combination(p, direction[moving[0]], q, direction[moving[1]]), why);
  }
  std::string names;
  for (const std::size_t i : moving) names += fmt::format("{}{}", names.empty() ? "" : ", ", problem.free[i].name);
  return fmt::format("{} are determined only in combination ({})", names, why);
}

/// Free parameters that take part in a direction, given by changes of their logarithms.
std::vector<std::size_t> taking_part(const Eigen::VectorXd& direction) {
  std::vector<std::size_t> moving;
  for (Eigen::Index i = 0; i < direction.size(); ++i)
    if (std::abs(direction[i]) > 0.05 * direction.cwiseAbs().maxCoeff()) moving.push_back(static_cast<std::size_t>(i));
  return moving;
}

/// Parameters at a bound do not vary: their columns leave the Jacobian.
struct Varying {
  std::vector<Eigen::Index> places;
  Eigen::MatrixXd jacobian;  ///< columns scaled to length 1
  Eigen::VectorXd scale;     ///< their lengths
};

Varying varying(const Eigen::MatrixXd& jacobian, const std::vector<bool>& at_bound) {
  Varying v;
  for (Eigen::Index i = 0; i < jacobian.cols(); ++i)
    if (!at_bound[static_cast<std::size_t>(i)]) v.places.push_back(i);
  const auto count = static_cast<Eigen::Index>(v.places.size());
  v.jacobian.resize(jacobian.rows(), count);
  v.scale.resize(count);
  for (Eigen::Index j = 0; j < count; ++j) {
    v.scale[j] = jacobian.col(v.places[static_cast<std::size_t>(j)]).norm();
    v.jacobian.col(j) = jacobian.col(v.places[static_cast<std::size_t>(j)]) / (v.scale[j] > 0 ? v.scale[j] : 1.0);
  }
  return v;
}

}  // namespace

Uncertainty uncertainty(const FitProblem& problem, const Solution& solution) {
  const std::size_t count = problem.free.size();
  Uncertainty result;
  result.standard_error.assign(count, kNotStated);
  result.identifiable.assign(count, true);
  result.at_bound.assign(count, false);
  result.correlation = Eigen::MatrixXd::Identity(static_cast<Eigen::Index>(count), static_cast<Eigen::Index>(count));
  for (std::size_t i = 0; i < count; ++i) result.at_bound[i] = on_bound(problem.free[i], solution.x[i]);
  const Linearised at = linearise(problem, solution.x);
  const Varying v = varying(at.jacobian, result.at_bound);
  const auto n = static_cast<Eigen::Index>(v.places.size());
  const double freedom = static_cast<double>(problem.points.size()) - static_cast<double>(n);
  result.t95 = freedom > 0 ? boost::math::quantile(boost::math::students_t(freedom), 0.975) : kNotStated;
  if (n == 0 || !at.finite) return result;

  const Eigen::BDCSVD<Eigen::MatrixXd> svd(v.jacobian, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::VectorXd& singular = svd.singularValues();
  const auto seen = [&](Eigen::Index k) { return k < singular.size() && singular[k] > kIdentifiable * singular[0]; };
  result.condition = singular.size() == n && singular[n - 1] > 0 ? singular[0] / singular[n - 1]
                                                                 : std::numeric_limits<double>::infinity();
  const double variance = freedom > 0 ? 2 * solution.cost / freedom : kNotStated;
  // Rows of V/scale turn singular directions into changes of the logarithms.
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(n, n);
  const auto direction = [&](Eigen::Index k) {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(count));
    for (Eigen::Index j = 0; j < n; ++j)
      all[v.places[static_cast<std::size_t>(j)]] =
          v.scale[j] > 0 ? svd.matrixV()(j, k) / v.scale[j] : svd.matrixV()(j, k);
    return all;
  };
  for (Eigen::Index k = 0; k < singular.size(); ++k) {
    const Eigen::VectorXd change = direction(k);
    if (!seen(k)) {
      const std::vector<std::size_t> moving = taking_part(change);
      for (const std::size_t i : moving) result.identifiable[i] = false;
      result.warnings.push_back(describe(
          problem, moving, change, fmt::format("singular value {:.1e} of the largest", singular[k] / singular[0])));
      continue;
    }
    Eigen::VectorXd part(n);
    for (Eigen::Index j = 0; j < n; ++j) part[j] = change[v.places[static_cast<std::size_t>(j)]];
    covariance += part * part.transpose() / (singular[k] * singular[k]);
    // A direction may be seen by noise-free data and still be lost in the noise of these.
    const double error = std::sqrt(std::max(0.0, variance)) * part.cwiseAbs().maxCoeff() / singular[k];
    if (error > kUndetermined) {
      const std::vector<std::size_t> moving = taking_part(change);
      for (const std::size_t i : moving) result.identifiable[i] = false;
      result.warnings.push_back(
          describe(problem, moving, change, fmt::format("standard error of the logarithm {:.2g}", error)));
    }
  }
  for (Eigen::Index a = 0; a < n; ++a) {
    const auto i = v.places[static_cast<std::size_t>(a)];
    if (result.identifiable[static_cast<std::size_t>(i)])
      result.standard_error[static_cast<std::size_t>(i)] = std::sqrt(variance * covariance(a, a));
    for (Eigen::Index b = 0; b < n; ++b) {
      const double norm = std::sqrt(covariance(a, a) * covariance(b, b));
      if (a != b && norm > 0) result.correlation(i, v.places[static_cast<std::size_t>(b)]) = covariance(a, b) / norm;
    }
  }
  return result;
}

}  // namespace gonio
