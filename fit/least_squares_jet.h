#pragma once
#include <ceres/jet.h>

#include <array>
#include <cmath>

#include "fit/least_squares.h"

namespace gonio {

/// Calls a residual template with numbers that carry their derivatives. `residuals` has the member
/// `template <class T> void operator()(const T* x, T* residual) const`.
template <class Number, int kParameters, class Residuals>
bool evaluate_with_jets(const Residuals& residuals, int count, std::span<const Number> x, Number* residual,
                        Number* jacobian) {
  using Jet = ceres::Jet<Number, kParameters>;
  std::array<Jet, kParameters> variable;
  for (int j = 0; j < kParameters; ++j) variable[j] = Jet(x[j], j);
  std::vector<Jet> value(count);
  residuals(variable.data(), value.data());
  bool finite = true;
  for (int k = 0; k < count; ++k) {
    residual[k] = value[k].a;
    finite = finite && std::isfinite(value[k].a) && value[k].v.array().isFinite().all();
    for (int j = 0; jacobian != nullptr && j < kParameters; ++j) jacobian[k * kParameters + j] = value[k].v[j];
  }
  return finite;
}

/// A ResidualFunction from residuals written once over their number type; `count` of them.
template <int kParameters, class Residuals>
ResidualFunction residual_function(Residuals residuals, int count) {
  ResidualFunction function;
  function.residuals = count, function.parameters = kParameters;
  function.in_double = [=](std::span<const double> x, double* residual, double* jacobian) {
    return evaluate_with_jets<double, kParameters>(residuals, count, x, residual, jacobian);
  };
  function.in_long_double = [=](std::span<const long double> x, long double* residual, long double* jacobian) {
    return evaluate_with_jets<long double, kParameters>(residuals, count, x, residual, jacobian);
  };
  return function;
}

}  // namespace gonio
