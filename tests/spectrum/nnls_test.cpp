// Non-negative least squares against its optimality conditions, and against every choice of positive unknowns.
#include "spectrum/nnls.h"

#include <Eigen/Dense>
#include <random>

#include "catch.h"

using namespace gonio;

namespace {

Eigen::MatrixXd random_matrix(std::mt19937& random, int rows, int columns) {
  std::normal_distribution<double> normal;
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return normal(random); });
}

double objective(const Eigen::MatrixXd& a, const Eigen::VectorXd& b, const Eigen::VectorXd& x) {
  return (a * x - b).squaredNorm();
}

/// The least over all 2^n sets of unknowns that are allowed to differ from 0.
double least_of_all_sets(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  const int n = static_cast<int>(a.cols());
  double least = b.squaredNorm();
  for (int set = 1; set < 1 << n; ++set) {
    std::vector<int> members;
    for (int i = 0; i < n; ++i)
      if (set >> i & 1) members.push_back(i);
    const Eigen::VectorXd x = a(Eigen::all, members).colPivHouseholderQr().solve(b);
    if (x.minCoeff() >= 0) least = std::min(least, (a(Eigen::all, members) * x - b).squaredNorm());
  }
  return least;
}

void check_optimal(const Eigen::MatrixXd& gram, const Eigen::VectorXd& right, const Eigen::VectorXd& x) {
  const Eigen::VectorXd gradient = gram * x - right;
  const double scale = right.cwiseAbs().maxCoeff() + gram.cwiseAbs().maxCoeff() * x.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    CHECK(x[i] >= 0);
    CHECK(gradient[i] >= -1e-9 * scale);
    if (x[i] > 0) CHECK(std::abs(gradient[i]) <= 1e-9 * scale);
  }
}

}  // namespace

TEST_CASE("Non-negative least squares: the best of every set of positive unknowns", "[spectrum]") {
  std::mt19937 random(7);
  for (int problem = 0; problem < 60; ++problem) {
    const int n = 1 + problem % 8;
    const Eigen::MatrixXd a = random_matrix(random, n + problem % 5, n);
    const Eigen::VectorXd b = random_matrix(random, static_cast<int>(a.rows()), 1);
    const Eigen::VectorXd x = nnls(a.transpose() * a, a.transpose() * b);
    check_optimal(a.transpose() * a, a.transpose() * b, x);
    CHECK(objective(a, b, x) == Approx(least_of_all_sets(a, b)).epsilon(1e-8).margin(1e-12));
    const Eigen::VectorXd guess = random_matrix(random, n, 1).cwiseMax(0),
                          again = nnls(a.transpose() * a, a.transpose() * b, guess);
    CHECK((again - x).norm() <= 1e-7 * (1 + x.norm()));
  }
}

TEST_CASE("Non-negative least squares: badly scaled, dependent and empty columns", "[spectrum]") {
  std::mt19937 random(8);
  Eigen::MatrixXd a = random_matrix(random, 30, 12).cwiseAbs();
  a.col(3) *= 1e6, a.col(4) *= 1e-6;
  a.col(7) = a.col(6);                 // the same twice
  a.col(9) = a.col(1) + 2 * a.col(2);  // a sum of two
  a.col(11).setZero();
  const Eigen::VectorXd truth = Eigen::VectorXd::LinSpaced(12, 0.5, 2), b = a * truth;
  const Eigen::VectorXd x = nnls(a.transpose() * a, a.transpose() * b);
  CHECK(x.minCoeff() >= 0);
  CHECK(x.allFinite());
  CHECK((a * x - b).norm() <= 1e-6 * b.norm());
}

TEST_CASE("Non-negative least squares: nothing to gain leaves zeros", "[spectrum]") {
  const Eigen::MatrixXd gram = Eigen::MatrixXd::Identity(3, 3);
  CHECK(nnls(gram, Eigen::Vector3d(-1, -2, 0)).isZero());
  CHECK(nnls(gram, Eigen::Vector3d(1, -2, 3)) == Eigen::Vector3d(1, 0, 3));
}
