// Interpolation variants against closed forms and the conditions that define each.
#include "spectrum/interpolation.h"

#include <cmath>

#include "base/error.h"
#include "catch.h"

using namespace gonio;

namespace {

std::vector<double> steps(double lo, double hi, int count) {
  std::vector<double> x;
  for (int i = 0; i < count; ++i) x.push_back(lo + (hi - lo) * i / (count - 1));
  return x;
}

template <class F>
std::vector<double> values(const std::vector<double>& x, F f) {
  std::vector<double> y;
  for (const double at : x) y.push_back(f(at));
  return y;
}

template <class F>
double worst(Interpolation variant, const std::vector<double>& x, F f, double lo, double hi) {
  const Interpolator table(variant, x, values(x, f));
  double error = 0;
  for (int i = 0; i <= 1000; ++i) {
    const double at = lo + (hi - lo) * i / 1000;
    error = std::max(error, std::abs(table.at(at) - f(at)));
  }
  return error;
}

}  // namespace

TEST_CASE("Interpolation: every variant gives its points back and a straight line everywhere", "[spectrum]") {
  const std::vector<double> even = steps(380, 780, 81), uneven{188, 192, 200, 231, 260, 300, 301, 420, 700, 1000};
  for (const Interpolation variant : kInterpolations)
    for (const auto& x : {even, uneven}) {
      if (variant == Interpolation::sprague && !is_equidistant(x)) continue;
      INFO(name_of(variant) << ", " << x.size() << " points");
      const auto wild = [](double at) { return std::sin(at * at) + at / 100; };
      const Interpolator table(variant, x, values(x, wild));
      for (const double at : x) CHECK(table.at(at) == wild(at));
      CHECK(worst(
                variant, x, [](double at) { return 3 - 0.25 * at; }, x.front(), x.back()) < 1e-9);
      CHECK(interpolation_named(name_of(variant)) == variant);
    }
  CHECK(!interpolation_named("spline"));
}

TEST_CASE("Interpolation: orders of convergence on a smooth function", "[spectrum]") {
  // Halving the step divides the error by 2^order: linear 2, pchip and akima at least about 2 (at extrema), natural
  // cubic 4 and Sprague 6 away from the ends, Floater-Hormann of order 3: 4.
  const auto f = [](double x) { return std::sin(x) + 0.3 * std::cos(2 * x); };
  const auto order = [&](Interpolation variant) {
    return std::log2(worst(variant, steps(0, 12, 121), f, 4, 8) / worst(variant, steps(0, 12, 241), f, 4, 8));
  };
  CHECK(order(Interpolation::linear) == Approx(2).margin(0.1));
  CHECK(order(Interpolation::pchip) > 1.4);
  CHECK(order(Interpolation::akima) > 1.9);
  CHECK(order(Interpolation::natural_cubic) == Approx(4).margin(0.2));
  CHECK(order(Interpolation::barycentric_rational) > 3.5);
  CHECK(order(Interpolation::sprague) > 4.7);
}

TEST_CASE("Interpolation: Sprague meets CIE 167's conditions", "[spectrum]") {
  // Its derivatives at the points are the five-point formulas', from both sides; polynomials of degree 4 are exact.
  const std::vector<double> x = steps(400, 700, 31);
  const auto f = [](double at) { return std::sin(at / 20) + std::exp((at - 600) / 40); };
  const std::vector<double> y = values(x, f);
  const Interpolator table(Interpolation::sprague, x, y);
  const double h = 10, d = 1e-3;
  for (std::size_t i = 3; i + 3 < x.size(); ++i) {
    const double slope = (y[i - 2] - 8 * y[i - 1] + 8 * y[i + 1] - y[i + 2]) / (12 * h);
    const double bend = (-y[i - 2] + 16 * y[i - 1] - 30 * y[i] + 16 * y[i + 1] - y[i + 2]) / (12 * h * h);
    for (const double side : {-d, d}) {
      const double one = table.at(x[i] + side), two = table.at(x[i] + 2 * side);
      CHECK((-3 * y[i] + 4 * one - two) / (2 * side) == Approx(slope).margin(1e-6));
      CHECK((y[i] - 2 * one + two) / (side * side) == Approx(bend).margin(1e-4));
    }
  }
  const auto quartic = [](double at) { return std::pow((at - 500) / 100, 4) - 2 * std::pow((at - 450) / 100, 3); };
  CHECK(worst(Interpolation::sprague, x, quartic, 420, 680) < 1e-12);
  CHECK_THROWS_AS(Interpolator(Interpolation::sprague, {1, 2, 3, 4, 5, 6.001}, {0, 0, 0, 0, 0, 0}), InputError);
  CHECK_THROWS_AS(Interpolator(Interpolation::sprague, {1, 2, 3, 4, 5}, {0, 0, 0, 0, 0}), InputError);
}

TEST_CASE("Interpolation: the natural cubic has no curvature at its ends, one curvature at each point", "[spectrum]") {
  const std::vector<double> x{0, 1, 1.5, 4, 5, 7}, y{1, -1, 2, 0, 3, 3};
  const Interpolator table(Interpolation::natural_cubic, x, y);
  const double d = 1e-4;
  const auto bend = [&](double at, double side) {  // one-sided, second order
    return (2 * table.at(at) - 5 * table.at(at + side) + 4 * table.at(at + 2 * side) - table.at(at + 3 * side)) /
           (side * side);
  };
  CHECK(bend(0, d) == Approx(0).margin(1e-4));
  CHECK(bend(7, -d) == Approx(0).margin(1e-4));
  for (std::size_t i = 1; i + 1 < x.size(); ++i) CHECK(bend(x[i], d) == Approx(bend(x[i], -d)).margin(1e-4));
}

TEST_CASE("Interpolation: pchip stays between its points, the others overshoot a step", "[spectrum]") {
  const std::vector<double> x = steps(0, 9, 10);
  const auto step = [](double at) { return at < 4.5 ? 0.0 : 1.0; };
  const auto overshoot = [&](Interpolation variant) {
    const Interpolator table(variant, x, values(x, step));
    double over = 0;
    for (double at = 0; at <= 9; at += 0.01) over = std::max({over, table.at(at) - 1, -table.at(at)});
    return over;
  };
  CHECK(overshoot(Interpolation::linear) == 0);
  CHECK(overshoot(Interpolation::pchip) <= 1e-15);
  CHECK(overshoot(Interpolation::natural_cubic) > 0.05);
  CHECK(overshoot(Interpolation::sprague) > 0.05);
}

TEST_CASE("Interpolation: beyond the table only when asked, and marked", "[spectrum]") {
  const Interpolator table(Interpolation::pchip, {400, 500, 600, 700}, {1, 2, 4, 3});
  CHECK_THROWS_AS(table.at(399.9), InputError);
  CHECK_THROWS_AS(table.at(700.1), InputError);
  CHECK_THROWS_AS(table.at(std::nan("")), InputError);
  CHECK_THROWS_AS(table.at(std::nan(""), Extension::nearest), InputError);
  CHECK(table.at(700, Extension::nearest).extrapolated == false);
  CHECK(table.at(800, Extension::nearest).extrapolated);
  CHECK(table.at(800, Extension::nearest).value == 3);
  CHECK(table.at(800, Extension::linear).value == Approx(2));
  CHECK(table.at(300, Extension::linear).value == Approx(0).margin(1e-12));
  CHECK_THROWS_AS(Interpolator(Interpolation::linear, {1, 1}, {0, 1}), InputError);
  CHECK_THROWS_AS(Interpolator(Interpolation::linear, {1, 2}, {0, std::nan("")}), InputError);
}
