#pragma once
#include "base/special.h"

namespace gonio {

/// scale·exp(-x), the exponential in two halves: exp(-x) alone leaves float's range at x = 87, while the scale of a narrow lobe next
/// to grazing (1e18) still brings it back to 1e-20. `scale` may be as large as 1e30.
template <class T>
T scaled_exp(const T& scale, const T& x) {
  const T half = fast_exp(T(T(-0.5) * x));
  return scale * half * half;
}

/// scale²·exp(-x), as (scale·exp(-x/2))²: a scale of 1e20 and a vanishing exponential make 0, not ∞·0.
template <class T>
T scaled_exp_squared(const T& scale, const T& x) {
  return square(T(scale * fast_exp(T(T(-0.5) * x))));
}

}  // namespace gonio
