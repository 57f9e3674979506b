#pragma once
// energy: directional reflectance, conservation limits and tables.
#include <Eigen/Core>
#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <span>
#include <vector>

namespace gonio {

/// Keeps what lies inside (lo, hi), sorted, with the two ends.
inline std::vector<double> breakpoints(double lo, double hi, const std::vector<double>& inside) {
  std::vector<double> points{lo, hi};
  for (const double x : inside)
    if (x > lo && x < hi) points.push_back(x);
  std::sort(points.begin(), points.end());
  return points;
}

/// Several integrals at once (one a wavelength), with a bound on the error of the worst.
struct Integral {
  Eigen::ArrayXd value;
  double error = 0;
  bool converged = true;
};

/// Gauss-Kronrod 7-15 on one interval; the error is the difference of the two rules. f(x, out) sets out.
template <class F>
Integral kronrod_15(F& f, double a, double b, Eigen::Index size) {
  using Kronrod = boost::math::quadrature::gauss_kronrod<double, 15>;
  using Gauss = boost::math::quadrature::gauss<double, 7>;
  const double middle = 0.5 * (a + b), half = 0.5 * (b - a);
  Eigen::ArrayXd kronrod = Eigen::ArrayXd::Zero(size), gauss = kronrod, one(size);
  for (std::size_t node = 0; node < Kronrod::abscissa().size(); ++node) {
    const double x = Kronrod::abscissa()[node];
    for (const double side : {-1.0, 1.0}) {
      if (node == 0 && side > 0) break;
      f(middle + side * half * x, one);
      kronrod += Kronrod::weights()[node] * one;
      if (node % 2 == 0) gauss += Gauss::weights()[node / 2] * one;
    }
  }
  Integral result;
  result.value = half * kronrod;
  result.error = std::abs(half) * (kronrod - gauss).abs().maxCoeff();
  return result;
}

/// Adaptive integration over consecutive breakpoints: the interval of the largest error is halved until the sum of errors is
/// below tolerance (absolute). Breakpoints go where the integrand has kinks.
template <class F>
Integral integrate_adaptively(F&& f, std::span<const double> breakpoints, Eigen::Index size, double tolerance,
                              std::size_t most_pieces = 200) {
  struct Piece {
    double a, b;
    Integral integral;
  };
  std::vector<Piece> pieces;
  const auto add = [&](double a, double b) {
    if (b > a) pieces.push_back({a, b, kronrod_15(f, a, b, size)});
  };
  for (std::size_t i = 0; i + 1 < breakpoints.size(); ++i) add(breakpoints[i], breakpoints[i + 1]);
  Integral total;
  for (;;) {
    total.error = 0;
    std::size_t worst = 0;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      total.error += pieces[i].integral.error;
      if (pieces[i].integral.error > pieces[worst].integral.error) worst = i;
    }
    total.converged = total.error <= tolerance;
    if (total.converged || pieces.size() >= most_pieces) break;
    const double a = pieces[worst].a, b = pieces[worst].b, middle = 0.5 * (a + b);
    pieces[worst] = {a, middle, kronrod_15(f, a, middle, size)};
    add(middle, b);
  }
  total.value = Eigen::ArrayXd::Zero(size);
  for (const Piece& piece : pieces) total.value += piece.integral.value;
  return total;
}

}  // namespace gonio
