#pragma once
#include <functional>
#include <limits>
#include <span>
#include <vector>

namespace gonio {

/// Residuals r_k(x) and, unless `jacobian` is null, dr_k/dx_j (row-major, residuals × parameters), in the number type T.
/// false where any of them is not finite: such a point is refused, never stepped to.
template <class T>
using ResidualsIn = std::function<bool(std::span<const T> x, T* residual, T* jacobian)>;

/// What is minimised: ½ Σ r_k². fit/least_squares_jet.h makes one from residuals written once, without derivatives.
struct ResidualFunction {
  int residuals = 0, parameters = 0;
  ResidualsIn<double> in_double;
  ResidualsIn<long double> in_long_double;  ///< for polishing; may be empty
};

/// Range of a parameter. Where both ends have the same sign, starts are spread over it on a logarithmic scale.
struct Range {
  double lo = -std::numeric_limits<double>::infinity(), hi = std::numeric_limits<double>::infinity();
};

/// How the length of a step is limited (Nocedal and Wright, Numerical Optimization, 2006, chapters 4 and 10).
enum class TrustRegion { levenberg_marquardt, dogleg };

struct LeastSquaresOptions {
  TrustRegion method = TrustRegion::levenberg_marquardt;
  double tolerance = 1e-15;  ///< relative decrease of the sum of squares by a step below which the solve ends
  int most_iterations = 2000;
  int most_polishing_steps = 20;  ///< 0: none
};

/// Where a solve ended.
struct LeastSquaresResult {
  std::vector<double> x;
  double sum_of_squares = std::numeric_limits<double>::infinity();  ///< Σ r_k², without the half
  bool converged = false;
  int iterations = 0, polishing_steps = 0;
  int rejected = 0;                            ///< evaluations that were not finite and therefore refused
  int starts = 1, starts_at_this_minimum = 1;  ///< of minimise_from_many: sums of squares equal to 1e-9
};

/// From one start (brought inside the box first; an empty box is none). Ceres, dense QR, the columns of the Jacobian
/// scaled to equal length; then polished.
LeastSquaresResult minimise(const ResidualFunction& function, std::vector<double> start, std::span<const Range> box,
                            const LeastSquaresOptions& options = {});

/// From `start` and from `starts` - 1 more, Sobol points that fill the box (finite ranges); the best end is polished.
/// The starts depend on their number only, so the result is the same every time.
LeastSquaresResult minimise_from_many(const ResidualFunction& function, const std::vector<double>& start,
                                      std::span<const Range> box, int starts, const LeastSquaresOptions& options = {});

/// Point number `index` of the Sobol sequence over the box.
std::vector<double> sobol_start(std::span<const Range> box, int index);

/// Full Gauss-Newton steps by QR in long double, without damping, while each is shorter than the last, does not raise the
/// sum of squares and stays in the box: near a minimum they gain the last digits that damped steps in double leave.
/// Parameters that their ranges hold stay; the others reach their minimum, of which Ceres's projected steps can stop 1 %
/// short and call it converged.
void polish(const ResidualFunction& function, std::span<const Range> box, const LeastSquaresOptions& options,
            LeastSquaresResult& result);

}  // namespace gonio
