#include "fit/problem.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/parallel.h"
#include "fit/metric.h"

namespace gonio {
namespace {

template <class Enum, std::size_t N>
Enum enum_from(std::string_view name, const Enum (&all)[N], std::string_view what, std::string_view names) {
  for (const Enum one : all)
    if (name == name_of(one)) return one;
  throw input_error("{}: unknown {}; expected {}", name, what, names);
}

}  // namespace

std::string_view name_of(Metric metric) {
  switch (metric) {
    case Metric::log:
      return "log";
    case Metric::linear:
      return "linear";
    case Metric::cuberoot:
      return "cuberoot";
    case Metric::likelihood:
      return "likelihood";
  }
  return "";
}
std::string_view name_of(Weighting weighting) { return weighting == Weighting::none ? "none" : "cosine"; }
std::string_view name_of(Loss loss) { return loss == Loss::none ? "none" : loss == Loss::huber ? "huber" : "cauchy"; }

Metric metric_from(std::string_view name) {
  return enum_from(name, {Metric::log, Metric::linear, Metric::cuberoot, Metric::likelihood}, "metric",
                   "log, linear, cuberoot or likelihood");
}
Weighting weighting_from(std::string_view name) {
  return enum_from(name, {Weighting::none, Weighting::cosine}, "weighting", "none or cosine");
}
Loss loss_from(std::string_view name) {
  return enum_from(name, {Loss::none, Loss::huber, Loss::cauchy}, "loss", "none, huber or cauchy");
}

double seen(std::span<const Brdf<double>> lobes, const Directions<double>& centre, const Interface<double>& surface,
            double wavelength_um, std::span<const ApertureNode> aperture) {
  if (aperture.empty()) return evaluate(lobes, centre, surface, wavelength_um);
  double sum = 0, weights = 0;
  for (const ApertureNode& node : aperture) {
    double weight = 0;
    const Directions<double> w = through(node, centre, weight);
    sum += weight * evaluate(lobes, w, surface, wavelength_um), weights += weight;
  }
  return sum / weights;
}

std::vector<double> FitProblem::predict(std::span<const double> x, std::span<const FitPoint> at) const {
  const std::optional<Interface<double>> fitted = surface_at(x);
  std::vector<std::vector<Brdf<double>>> brdfs;
  for (const FitPoint& point : at)
    while (brdfs.size() <= point.group) brdfs.push_back(make_brdfs(model, values_at(x, brdfs.size())));
  std::vector<double> f(at.size());
  for_each_index(at.size(), [&](std::size_t i) {
    const FitPoint& point = at[i];
    f[i] = seen(brdfs[point.group], point.directions, fitted.value_or(point.surface), point.wavelength_um, aperture);
  });
  return f;
}

double FitProblem::compared(double f_per_sr, const FitPoint& point) const {
  return with_metric(
      metric, [&]<Metric kMetric>() { return compared_at<kMetric>(f_per_sr, point.weight, floor_per_sr).value; });
}

double FitProblem::compared_slope(double f_per_sr, const FitPoint& point) const {
  return with_metric(
      metric, [&]<Metric kMetric>() { return compared_at<kMetric>(f_per_sr, point.weight, floor_per_sr).slope; });
}

std::vector<double> FitProblem::values_at(std::span<const double> x, std::size_t group) const {
  std::vector<double> all = values;
  for (std::size_t i = 0; i < free.size(); ++i)
    if (!free[i].of_surface() && (free[i].group == FreeParameter::kShared || free[i].group == group))
      all[free[i].place] = std::exp(x[i]);
  return all;
}

std::optional<Interface<double>> FitProblem::surface_at(std::span<const double> x) const {
  std::optional<Interface<double>> fitted;
  for (std::size_t i = 0; i < free.size(); ++i)
    if (free[i].place == FreeParameter::kIndex) fitted = Interface<double>{std::exp(x[i]), 0.0, false};
  for (std::size_t i = 0; i < free.size(); ++i)
    if (free[i].place == FreeParameter::kAbsorption && fitted) fitted->k = std::exp(x[i]);
  return fitted;
}

}  // namespace gonio
