#pragma once
// How values are compared, written once: for a number alone and for lanes of them.
#include "base/special.h"
#include "fit/problem.h"

namespace gonio {

/// ψ of the metric at f, and dψ/df (fit/problem.h).
template <class T>
struct Compared {
  T value, slope;
};
template <Metric kMetric, class T>
Compared<T> compared_at(const T& f, const T& weight, const T& floor_per_sr) {
  if constexpr (kMetric == Metric::log) {
    const T sum = f + floor_per_sr;  // positive, which the choice of points ensures
    return {fast_log(sum), T(1.0) / sum};
  } else if constexpr (kMetric == Metric::linear) {  // and likelihood, whose deviation is the point's confidence
    return {f * weight, weight};
  } else {
    using std::cbrt;
    const T seen = f * weight, root = cbrt(seen);
    return {root, weight / (T(3.0) * larger_of(T(square(root)), T(1e-200)))};
  }
}

/// run<metric>() for the metric at hand.
template <class Run>
auto with_metric(Metric metric, Run&& run) {
  if (metric == Metric::log) return run.template operator()<Metric::log>();
  if (metric == Metric::linear || metric == Metric::likelihood) return run.template operator()<Metric::linear>();
  return run.template operator()<Metric::cuberoot>();
}

/// ρ of a robust loss (of half the squared residual, c its width) and the weight ρ' of a point:
///   none    r²/2                     huber   r²/2 up to |r| = c, then c|r| - c²/2      cauchy  c²/2·ln(1 + r²/c²)
struct Robust {
  DoubleLanes cost, weight;
};
template <Loss kLoss>
Robust robust_in_lanes(const DoubleLanes& r, double width) {
  const DoubleLanes half(0.5), r2 = square(r), c(width);
  if constexpr (kLoss == Loss::none) {
    return {half * r2, DoubleLanes(1.0)};
  } else if constexpr (kLoss == Loss::huber) {
    const DoubleLanes size = xsimd::abs(r);
    const auto far = size > c;
    return {select(far, c * size - half * square(c), half * r2), select(far, c / larger_of(size, c), DoubleLanes(1.0))};
  } else {
    const DoubleLanes share = r2 / square(c);
    return {half * square(c) * fast_log1p(share), DoubleLanes(1.0) / (DoubleLanes(1.0) + share)};
  }
}

}  // namespace gonio
