#pragma once
#include "base/number.h"

namespace gonio {

/// A unit vector in a surface's frame, z = its normal; z < 0 is the far side.
template <class T>
struct UnitVector {
  T x, y, z;
};

template <class T>
T dot(const UnitVector<T>& a, const UnitVector<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
UnitVector<T> normalised(const T& x, const T& y, const T& z) {
  using std::sqrt;
  const T scale = T(1) / sqrt(square(x) + square(y) + square(z));
  return {x * scale, y * scale, z * scale};
}

}  // namespace gonio
