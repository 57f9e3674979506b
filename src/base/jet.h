#pragma once
#include <ceres/jet.h>

#include "base/special.h"

namespace gonio {

/// A number with N derivatives (Ceres): the models' derivatives come from the models' own code.
template <int N>
using Jet = ceres::Jet<double, N>;

template <int N>
struct ValueOf<ceres::Jet<double, N>> {
  static double of(const ceres::Jet<double, N>& x) { return x.a; }
};

/// Special functions, their slopes in closed form (base/special.h).
template <int N>
struct Special<ceres::Jet<double, N>> {
  using J = ceres::Jet<double, N>;
  static J erfcx(const J& x) { return J(Special<double>::erfcx(x.a), -2 * Special<double>::erfcx_q(x.a) * x.v); }
  static J erfcx_q(const J& x) {
    const double q = Special<double>::erfcx_q(x.a);
    return J(q, (2 * x.a * q - Special<double>::erfcx(x.a)) * x.v);
  }
  static J smith_lambda_core(const J& s) {
    const double e = std::exp(-1 / (s.a * s.a));
    return J(Special<double>::smith_lambda_core(s.a, e), 0.5 / kSqrtPi<double> * e * s.v);
  }
  static Ratio<J, double> smith_visible(const J& s2) {
    const double inverse = 1 / std::max(s2.a, 1e-30),
                 slope = 0.5 / kSqrtPi<double> * std::exp(-inverse) * std::sqrt(inverse);
    return {J(Special<double>::smith_visible(s2.a).value(), slope * s2.v), 1.0};
  }
};

}  // namespace gonio
