#pragma once
#include <ceres/jet.h>

#include "base/number.h"

namespace gonio {

/// A number with N derivatives (Ceres): the models' derivatives come from the models' own code.
template <int N>
using Jet = ceres::Jet<double, N>;

template <int N>
struct ValueOf<ceres::Jet<double, N>> {
  static double of(const ceres::Jet<double, N>& x) { return x.a; }
};

}  // namespace gonio
