#include "fit/uncertainty.h"

#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "base/error.h"

namespace gonio {
namespace {

constexpr double kAtBound = 1e-9;      // of the box's logarithmic width
constexpr double kUndetermined = 1.0;  // standard error of a logarithm from which on a factor e is within the error
constexpr double kOnePoint = 1.5;      // points an incidence up to which a parameter is not to be trusted
constexpr std::size_t kSeries = 5;     // points an incidence from which on it is a series
constexpr double kValley = 1e-3;       // share of the largest singular value below which a bound may end a valley
constexpr double kSameDirection =
    0.02;  // how far from a ratio of small whole numbers a direction may be to be named so

bool on_bound(const FreeParameter& box, double x) {
  const double lo = std::log(box.lo), hi = std::log(box.hi), near = kAtBound * (hi - lo);
  return x - lo <= near || hi - x <= near;
}

/// One free parameter that moves along a direction in logarithms.
struct Moving {
  const FreeParameter& box;
  double x, change;
};

/// p^a q^b that the data do determine when (p, q) moving by their changes is what they do not: a·dp + b·dq = 0, with
/// small whole exponents where those fit; and its value.
std::string combination(const Moving& p, const Moving& q) {
  double a = 1, b = -p.change / q.change;
  for (int i = 4; i >= 1; --i)
    for (int j = 4; j >= 1; --j)
      if (std::abs(i * std::abs(p.change) - j * std::abs(q.change)) < kSameDirection * j * std::abs(q.change))
        a = i, b = p.change * q.change > 0 ? -j : j;
  const auto power = [](const std::string& name, double n) {
    return n == 1 ? name : fmt::format("{}^{:.3g}", name, n);
  };
  return fmt::format("{}{}{} = {:.6g}", power(p.box.name, a), b < 0 ? "/" : "*", power(q.box.name, std::abs(b)),
                     std::exp(a * p.x + b * q.x));
}

/// A direction of the free parameters' logarithms that the data do not determine, in words.
std::string describe(const std::vector<Moving>& moving, const std::string& why) {
  if (moving.size() == 1) return fmt::format("{} is not determined by these data ({})", moving[0].box.name, why);
  if (moving.size() == 2)
    return fmt::format("{} and {} cannot be told apart: only {} is determined by these data ({})", moving[0].box.name,
                       moving[1].box.name, combination(moving[0], moving[1]), why);
  std::string names;
  for (const Moving& m : moving) names += fmt::format("{}{}", names.empty() ? "" : ", ", m.box.name);
  return fmt::format("{} are determined only in combination ({})", names, why);
}

bool takes_part(const Eigen::VectorXd& direction, Eigen::Index i) {
  return std::abs(direction[i]) > 0.05 * direction.cwiseAbs().maxCoeff();
}

/// Marks the free parameters that take part in such a direction and says so.
void refuse(const FitProblem& problem, const Solution& solution, const Eigen::VectorXd& direction,
            const std::string& why, Uncertainty& result) {
  std::vector<Moving> moving;
  for (Eigen::Index i = 0; i < direction.size(); ++i) {
    if (!takes_part(direction, i)) continue;
    const auto place = static_cast<std::size_t>(i);
    result.identifiable[place] = false;
    moving.push_back({problem.free[place], solution.x[place], direction[i]});
  }
  result.warnings.push_back(describe(moving, why));
}

/// The triangle of a tall matrix's QR factors, which has its singular values and directions: block by block, each under the triangle of
/// those before it.
Eigen::MatrixXd triangle_of(const Eigen::MatrixXd& tall) {
  constexpr Eigen::Index kRows = 512;
  const Eigen::Index columns = tall.cols();
  Eigen::MatrixXd triangle = Eigen::MatrixXd::Zero(columns, columns), stacked;
  for (Eigen::Index from = 0; from < tall.rows(); from += kRows) {
    const Eigen::Index rows = std::min(kRows, tall.rows() - from);
    stacked.resize(columns + rows, columns);
    stacked << triangle, tall.middleRows(from, rows);
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(stacked);
    triangle = qr.matrixQR().topRows(columns).triangularView<Eigen::Upper>();
  }
  return triangle;
}

/// Singular directions of the Jacobian's columns (all, or those of the parameters not at a bound), scaled to length 1.
struct Spectrum {
  std::vector<Eigen::Index> places;
  Eigen::VectorXd scale, singular;
  Eigen::MatrixXd v;
  Eigen::Index parameters = 0;

  Spectrum(const Eigen::MatrixXd& jacobian, const std::vector<bool>& left_out) : parameters(jacobian.cols()) {
    for (Eigen::Index i = 0; i < jacobian.cols(); ++i)
      if (!left_out[static_cast<std::size_t>(i)]) places.push_back(i);
    const auto count = static_cast<Eigen::Index>(places.size());
    Eigen::MatrixXd scaled(jacobian.rows(), count);
    scale.resize(count);
    for (Eigen::Index j = 0; j < count; ++j) {
      scaled.col(j) = jacobian.col(places[static_cast<std::size_t>(j)]);
      scale[j] = scaled.col(j).norm();
      if (scale[j] > 0) scaled.col(j) /= scale[j];
    }
    if (count == 0) return;
    scaled = triangle_of(scaled);
    const Eigen::JacobiSVD<Eigen::MatrixXd, Eigen::NoQRPreconditioner> svd(scaled, Eigen::ComputeFullV);
    singular = svd.singularValues();
    v = svd.matrixV();
  }

  double share(Eigen::Index k) const { return singular[0] > 0 ? singular[k] / singular[0] : 0; }
  bool seen(Eigen::Index k) const { return share(k) > kIdentifiable; }
  /// Direction k as changes of all the parameters' logarithms.
  Eigen::VectorXd direction(Eigen::Index k) const {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(parameters);
    for (std::size_t j = 0; j < places.size(); ++j) {
      const auto column = static_cast<Eigen::Index>(j);
      all[places[j]] = v(column, k) / (scale[column] > 0 ? scale[column] : 1.0);
    }
    return all;
  }
};

/// Directions that the data do not see, and valleys so flat that the solution ran along them into a bound.
void find_unseen(const FitProblem& problem, const Solution& solution, const Spectrum& all, Uncertainty& result) {
  for (Eigen::Index k = 0; k < all.singular.size(); ++k) {
    const Eigen::VectorXd change = all.direction(k);
    const std::string share = fmt::format("singular value {:.1e} of the largest", all.share(k));
    if (!all.seen(k)) {
      refuse(problem, solution, change, share, result);
      continue;
    }
    if (all.share(k) > kValley) continue;
    for (Eigen::Index i = 0; i < change.size(); ++i)
      if (result.at_bound[static_cast<std::size_t>(i)] && takes_part(change, i)) {
        refuse(problem, solution, change,
               fmt::format("{}, and {} is at its bound", share, problem.free[static_cast<std::size_t>(i)].name),
               result);
        break;
      }
  }
}

/// Parameters that one point an incidence speaks for: the number of points that carry a column there, (Σ j²)²/Σ j⁴, is 1; its mean, each
/// incidence by its share of Σ j². A peak on one sample of a scan fits any width. Scans of few points an incidence (random
/// directions) are not judged.
void find_thin(const FitProblem& problem, const Eigen::MatrixXd& jacobian, Uncertainty& result) {
  std::map<double, std::vector<Eigen::Index>> incidences;
  for (std::size_t p = 0; p < problem.points.size(); ++p)
    incidences[problem.points[p].directions.tan2_i].push_back(static_cast<Eigen::Index>(p));
  if (problem.points.size() < kSeries * incidences.size()) return;
  for (Eigen::Index i = 0; i < jacobian.cols(); ++i) {
    double all = 0, weighted = 0;
    for (const auto& [tan2_i, points] : incidences) {
      double squares = 0, fourth = 0;
      for (const Eigen::Index p : points) squares += square(jacobian(p, i)), fourth += square(square(jacobian(p, i)));
      all += squares;
      if (fourth > 0) weighted += squares * square(squares) / fourth;
    }
    const double carrying = all > 0 ? weighted / all : 0;
    if (carrying > kOnePoint || !result.identifiable[static_cast<std::size_t>(i)]) continue;
    result.warnings.push_back(fmt::format(
        "{} rests on {:.2g} points an incidence: the scan is too coarse for so narrow a lobe, and neither the "
        "value nor its interval is to be trusted",
        problem.free[static_cast<std::size_t>(i)].name, carrying));
  }
}

/// Covariance of the logarithms over the directions that are seen; those that are seen but lost in the noise are
/// refused.
Eigen::MatrixXd covariance_of(const FitProblem& problem, const Solution& solution, const Spectrum& varying,
                              double variance, Uncertainty& result) {
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(varying.parameters, varying.parameters);
  for (Eigen::Index k = 0; k < varying.singular.size(); ++k) {
    if (!varying.seen(k)) continue;
    const Eigen::VectorXd change = varying.direction(k) / varying.singular[k];
    covariance += variance * change * change.transpose();
    const double error = std::sqrt(variance) * change.cwiseAbs().maxCoeff();
    if (error > kUndetermined)
      refuse(problem, solution, change, fmt::format("standard error of the logarithm {:.2g}", error), result);
  }
  return covariance;
}

}  // namespace

double residual_variance(const FitProblem& problem, const Solution& solution, double freedom) {
  const double seen = std::max(2 * solution.cost / freedom, std::numeric_limits<double>::min());
  return problem.metric == Metric::likelihood ? std::max(seen, 1.0) : seen;
}

Uncertainty uncertainty(const FitProblem& problem, const Solution& solution) {
  const std::size_t count = problem.free.size();
  const auto size = static_cast<Eigen::Index>(count);
  Uncertainty result;
  result.standard_error.assign(count, kNotStated);
  result.identifiable.assign(count, true);
  result.correlation = Eigen::MatrixXd::Identity(size, size);
  for (std::size_t i = 0; i < count; ++i) result.at_bound.push_back(on_bound(problem.free[i], solution.x[i]));
  const Linearised at = linearise(problem, solution.x);
  if (count == 0 || !at.finite) return result;

  const Spectrum all(at.jacobian, std::vector<bool>(count, false)), varying(at.jacobian, result.at_bound);
  const double smallest = all.singular.minCoeff();
  result.condition = smallest > 0 ? all.singular[0] / smallest : std::numeric_limits<double>::infinity();
  find_unseen(problem, solution, all, result);
  find_thin(problem, at.jacobian, result);
  const double freedom = static_cast<double>(problem.points.size()) - static_cast<double>(varying.places.size());
  result.freedom = freedom;
  if (!(freedom > 0) || varying.places.empty()) return result;
  result.t95 = boost::math::quantile(boost::math::students_t(freedom), 0.975);
  // Correlations do not depend on the size of the errors: data without any still have them.
  const double variance = residual_variance(problem, solution, freedom);
  const Eigen::MatrixXd covariance = covariance_of(problem, solution, varying, variance, result);
  for (const Eigen::Index i : varying.places) {
    if (result.identifiable[static_cast<std::size_t>(i)])
      result.standard_error[static_cast<std::size_t>(i)] = std::sqrt(covariance(i, i));
    for (const Eigen::Index j : varying.places) {
      const double norm = std::sqrt(covariance(i, i)) * std::sqrt(covariance(j, j));
      if (i != j && norm > 0) result.correlation(i, j) = covariance(i, j) / norm;
    }
  }
  return result;
}

}  // namespace gonio
