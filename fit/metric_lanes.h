#pragma once
#include "base/special.h"
#include "fit/problem.h"

namespace gonio {

/// ψ of the metric at f, and dψ/df (fit/problem.h).
struct Compared {
  DoubleLanes value, slope;
};
template <Metric kMetric>
Compared compared_in_lanes(const DoubleLanes& f, const DoubleLanes& weight, const DoubleLanes& floor_per_sr) {
  if constexpr (kMetric == Metric::log) {
    const DoubleLanes sum = f + floor_per_sr;
    return {fast_log(sum), DoubleLanes(1.0) / sum};
  } else if constexpr (kMetric == Metric::linear) {
    return {f * weight, weight};
  } else {
    const DoubleLanes seen = f * weight, root = xsimd::cbrt(seen);
    return {root, weight / (DoubleLanes(3.0) * larger_of(square(root), DoubleLanes(1e-200)))};
  }
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
