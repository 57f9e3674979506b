#pragma once
#include "base/special.h"

namespace gonio {

/// scale·base²·exp(-x), the exponential in two halves: exp(-x) alone leaves float's range at x = 87, while the scale of
/// a narrow lobe next to grazing (1e18) still brings it back to 1e-20; and a vanishing exponential times a base of 1e12
/// is 0, not ∞·0.
template <class T>
T scaled_exp(const T& scale, const T& x, const T& base) {
  const T half = base * fast_exp(T(T(-0.5) * x));
  return scale * half * half;
}
template <class T>
T scaled_exp(const T& scale, const T& x) {
  const T half = fast_exp(T(T(-0.5) * x));
  return scale * half * half;
}

}  // namespace gonio
