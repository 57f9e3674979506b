#include "fit/problem.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "base/jet.h"

namespace gonio {
namespace {

constexpr int kLanes = 4;  // derivatives carried side by side; more parameters take another pass
using FitJet = Jet<kLanes>;
constexpr std::size_t kMostParameters = 16;

/// The model at x in number type T: parameters, and n where it is free.
template <class T>
struct Candidate {
  Brdf<T> brdf;
  std::optional<T> n;

  T at(const FitPoint& point) const {
    const Interface<T> surface =
        n ? Interface<T>{*n, T(0), false} : Interface<T>{T(point.surface.n), T(point.surface.k), point.surface.perfect};
    return evaluate(brdf, point.directions, surface, T(point.wavelength_um));
  }
};

template <class T>
Candidate<T> candidate(const FitProblem& problem, std::span<const T> x) {
  using std::exp;
  std::array<T, kMostParameters> values;
  std::transform(problem.values.begin(), problem.values.end(), values.begin(), [](double v) { return T(v); });
  std::optional<T> n;
  for (std::size_t i = 0; i < problem.free.size(); ++i) {
    const T value = exp(x[i]);
    if (problem.free[i].place == FreeParameter::kIndex)
      n = value;
    else
      values[problem.free[i].place] = value;
  }
  return {make_brdf<T>(problem.model, std::span<const T>(values.data(), problem.values.size())), n};
}

/// ψ; f and y under the logarithm are positive, which the choice of points ensures.
template <class T>
T psi(Metric metric, const T& f, double weight, double floor_per_sr) {
  using std::cbrt, std::log;
  switch (metric) {
    case Metric::log:
      return log(f + T(floor_per_sr));
    case Metric::linear:
      return f * T(weight);
    case Metric::cuberoot:
      return cbrt(f * T(weight));
  }
  return f;
}

}  // namespace

std::string_view name_of(Metric metric) {
  return metric == Metric::log ? "log" : metric == Metric::linear ? "linear" : "cuberoot";
}
std::string_view name_of(Weighting weighting) { return weighting == Weighting::none ? "none" : "cosine"; }

Metric metric_from(std::string_view name) {
  for (const Metric metric : {Metric::log, Metric::linear, Metric::cuberoot})
    if (name == name_of(metric)) return metric;
  throw input_error("{}: unknown metric; expected log, linear or cuberoot", name);
}
Weighting weighting_from(std::string_view name) {
  for (const Weighting weighting : {Weighting::none, Weighting::cosine})
    if (name == name_of(weighting)) return weighting;
  throw input_error("{}: unknown weighting; expected none or cosine", name);
}

std::vector<double> FitProblem::predict(std::span<const double> x, std::span<const FitPoint> at) const {
  const Candidate<double> model_at = candidate<double>(*this, x);
  std::vector<double> f(at.size());
  std::transform(at.begin(), at.end(), f.begin(), [&](const FitPoint& point) { return model_at.at(point); });
  return f;
}

double FitProblem::compared(double f_per_sr, const FitPoint& point) const {
  return psi(metric, f_per_sr, point.weight, floor_per_sr);
}

double FitProblem::compared_slope(double f_per_sr, const FitPoint& point) const {
  return psi(metric, Jet<1>(f_per_sr, 0), point.weight, floor_per_sr).v[0];
}

bool FitProblem::residuals(std::span<const double> x, double* residual, double* jacobian) const {
  const std::size_t count = free.size();
  bool finite = true;
  if (jacobian == nullptr || count == 0) {
    const Candidate<double> model_at = candidate<double>(*this, x);
    for (std::size_t p = 0; p < points.size(); ++p) {
      residual[p] = compared(model_at.at(points[p]), points[p]) - compared(points[p].f_per_sr, points[p]);
      finite = finite && std::isfinite(residual[p]);
    }
    return finite;
  }
  for (std::size_t first = 0; first < count; first += kLanes) {
    std::array<FitJet, kMostParameters> seeded;
    for (std::size_t i = 0; i < count; ++i) {
      seeded[i] = FitJet(x[i]);
      if (i >= first && i < first + kLanes) seeded[i].v[static_cast<int>(i - first)] = 1;
    }
    const auto model_at = candidate<FitJet>(*this, std::span<const FitJet>(seeded.data(), count));
    for (std::size_t p = 0; p < points.size(); ++p) {
      const FitJet value = psi(metric, model_at.at(points[p]), points[p].weight, floor_per_sr);
      residual[p] = value.a - compared(points[p].f_per_sr, points[p]);
      finite = finite && std::isfinite(residual[p]) && value.v.allFinite();
      for (std::size_t i = first; i < std::min(count, first + kLanes); ++i)
        jacobian[p * count + i] = value.v[static_cast<int>(i - first)];
    }
  }
  return finite;
}

std::vector<double> FitProblem::values_at(std::span<const double> x) const {
  std::vector<double> all = values;
  for (std::size_t i = 0; i < free.size(); ++i)
    if (free[i].place != FreeParameter::kIndex) all[free[i].place] = std::exp(x[i]);
  return all;
}

std::optional<double> FitProblem::index_at(std::span<const double> x) const {
  for (std::size_t i = 0; i < free.size(); ++i)
    if (free[i].place == FreeParameter::kIndex) return std::exp(x[i]);
  return std::nullopt;
}

}  // namespace gonio
