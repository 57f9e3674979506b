// Bounds, refused points and starts of the general least-squares entry; how exact it is: nist_test.cpp.
#include "fit/least_squares.h"

#include <cmath>

#include "catch.h"

using namespace gonio;

namespace {

/// Rosenbrock's valley: minimum 0 at (1, 1). Derivatives by hand, in double only.
ResidualFunction valley() {
  ResidualFunction function;
  function.residuals = function.parameters = 2;
  function.in_double = [](std::span<const double> x, double* residual, double* jacobian) {
    residual[0] = 10 * (x[1] - x[0] * x[0]), residual[1] = 1 - x[0];
    if (jacobian != nullptr) jacobian[0] = -20 * x[0], jacobian[1] = 10, jacobian[2] = -1, jacobian[3] = 0;
    return true;
  };
  return function;
}

/// ln x - 1, which has no value below 0.
ResidualFunction logarithm() {
  ResidualFunction function;
  function.residuals = function.parameters = 1;
  function.in_double = [](std::span<const double> x, double* residual, double* jacobian) {
    residual[0] = std::log(x[0]) - 1;
    if (jacobian != nullptr) jacobian[0] = 1 / x[0];
    return std::isfinite(residual[0]);
  };
  return function;
}

}  // namespace

TEST_CASE("a bent valley is followed to its end, or to the bound across it", "[fit][least_squares]") {
  for (const TrustRegion method : {TrustRegion::levenberg_marquardt, TrustRegion::dogleg}) {
    LeastSquaresOptions options;
    options.method = method;
    const LeastSquaresResult free = minimise(valley(), {-1.2, 1}, {}, options);
    CHECK(free.converged);
    CHECK(free.x[0] == Approx(1).epsilon(1e-12));
    CHECK(free.x[1] == Approx(1).epsilon(1e-12));
    CHECK(free.sum_of_squares < 1e-24);
    const std::vector<Range> box{{-2, 0.5}, {-2, 2}};
    const LeastSquaresResult bound = minimise(valley(), {-1.2, 1}, box, options);
    CHECK(bound.x[0] == Approx(0.5).epsilon(1e-9));
    CHECK(bound.x[0] <= 0.5);
    CHECK(bound.x[1] == Approx(0.25).epsilon(1e-6));
    CHECK(bound.sum_of_squares == Approx(0.25).epsilon(1e-9));
  }
}

TEST_CASE("what is not finite is refused and counted, not stepped to", "[fit][least_squares]") {
  const LeastSquaresResult far = minimise(logarithm(), {50}, {});  // the first full step goes to -95
  CHECK(far.converged);
  CHECK(far.x[0] == Approx(std::exp(1.0)).epsilon(1e-12));
  CHECK(far.rejected > 0);
  const LeastSquaresResult lost = minimise(logarithm(), {-1}, {});
  CHECK_FALSE(lost.converged);
  CHECK(lost.rejected == 1);
  CHECK(std::isinf(lost.sum_of_squares));
  const std::vector<Range> box{{-10, 10}};
  const LeastSquaresResult found = minimise_from_many(logarithm(), {-1}, box, 8);
  CHECK(found.x[0] == Approx(std::exp(1.0)).epsilon(1e-12));
  CHECK(found.starts == 8);
  CHECK(found.starts_at_this_minimum < 8);
}

TEST_CASE("starts fill the box and are the same every time", "[fit][least_squares]") {
  const std::vector<Range> box{{1e-3, 1e3}, {-1e3, -1e-3}, {-1, 3}};
  std::vector<int> quarter(12);
  for (int index = 0; index < 64; ++index) {
    const std::vector<double> x = sobol_start(box, index);
    CHECK(x == sobol_start(box, index));
    for (std::size_t j = 0; j < 3; ++j) REQUIRE((x[j] >= box[j].lo && x[j] <= box[j].hi));
    const double along[] = {(std::log10(x[0]) + 3) / 6, (std::log10(-x[1]) + 3) / 6, (x[2] + 1) / 4};
    for (std::size_t j = 0; j < 3; ++j) ++quarter[4 * j + static_cast<std::size_t>(std::min(3.0, 4 * along[j]))];
  }
  for (const int count : quarter) CHECK(std::abs(count - 16) <= 1);  // of 64, evenly on each parameter's own scale
}
