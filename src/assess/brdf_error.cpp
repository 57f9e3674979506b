#include "assess/brdf_error.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "reference/reference.h"

namespace gonio {
namespace {

template <class T>
T lanes_of(std::span<const BrdfPoint> points, const std::function<double(const BrdfPoint&)>& number) {
  using S = scalar_t<T>;
  if constexpr (is_lanes_v<T>) {
    alignas(64) std::array<S, T::size> all;
    for (std::size_t lane = 0; lane < T::size; ++lane) all[lane] = S(number(points[std::min(lane, points.size() - 1)]));
    return T::load_unaligned(all.data());
  } else {
    return S(number(points[0]));
  }
}

/// As many points as there are lanes, each with its own parameters.
template <class T>
void evaluate_block(const ModelSpec& spec, std::span<const BrdfPoint> points, double* f) {
  const auto number = [&](const std::function<double(const BrdfPoint&)>& of) { return lanes_of<T>(points, of); };
  std::vector<T> values;
  for (std::size_t p = 0; p < points[0].values.size(); ++p)
    values.push_back(number([p](const BrdfPoint& at) { return at.values[p]; }));
  const Directions<T> w =
      reduce(number([](const auto& at) { return at.i.x; }), number([](const auto& at) { return at.i.y; }),
             number([](const auto& at) { return at.i.z; }), number([](const auto& at) { return at.o.x; }),
             number([](const auto& at) { return at.o.y; }), number([](const auto& at) { return at.o.z; }));
  const Interface<T> surface{number([](const auto& at) { return at.surface.n; }),
                             number([](const auto& at) { return at.surface.k; }), points[0].surface.perfect};
  const T result =
      evaluate(make_brdf<T>(spec, values), w, surface, number([](const auto& at) { return at.wavelength_um; }));
  if constexpr (is_lanes_v<T>) {
    alignas(64) std::array<scalar_t<T>, T::size> all;
    result.store_unaligned(all.data());
    for (std::size_t lane = 0; lane < points.size(); ++lane) f[lane] = double(all[lane]);
  } else {
    *f = result;
  }
}

template <class T>
std::vector<double> evaluate_all(const ModelSpec& spec, std::span<const BrdfPoint> points) {
  std::size_t lanes = 1;
  if constexpr (is_lanes_v<T>) lanes = T::size;
  std::vector<double> f(points.size());
  // A block holds points of one kind of surface (`perfect` is no lane's own).
  for (std::size_t at = 0; at < points.size();) {
    std::size_t end = at + 1;
    while (end < points.size() && end - at < lanes && points[end].surface.perfect == points[at].surface.perfect) ++end;
    evaluate_block<T>(spec, points.subspan(at, end - at), &f[at]);
    at = end;
  }
  return f;
}

/// R near total reflection changes as the root of the distance to it: the input's own rounding is more than the bars
/// there.
bool next_to_critical(const BrdfPoint& point, double cos2_d, Precision precision) {
  const double n = point.surface.n, k = point.surface.k;
  if (point.surface.perfect || n >= 1) return false;
  const double t = (n - 1) * (n + 1) - k * k + cos2_d, q = std::sqrt(t * t + 4 * n * n * k * k);
  return q < (precision == Precision::single ? 0.03 : 1e-5) * cos2_d;
}

/// Schlick's D, a cube that falls to 0 at a finite angle: no rounded input fixes its relative value next to there.
bool next_to_edge(const ModelSpec& spec, const BrdfPoint& point, double cos_h, Precision precision) {
  if (spec.variant() != "schlick-d" && spec.variant() != "schlick") return false;
  const double left = 2 - (1 - cos_h) / (2 * square(point.values[0]));
  return left < (precision == Precision::single ? 0.4 : 0.01);
}

bool ill_conditioned(const ModelSpec& spec, const BrdfPoint& point, Precision precision) {
  const double turn = spec.retro ? -1 : 1, hz = point.i.z + point.o.z;
  const double h2 = square(turn * point.i.x + point.o.x) + square(turn * point.i.y + point.o.y) + square(hz);
  return next_to_critical(point, 0.25 * h2, precision) || next_to_edge(spec, point, hz / std::sqrt(h2), precision);
}

std::vector<BrdfPoint> exchanged(std::span<const BrdfPoint> points) {
  std::vector<BrdfPoint> back(points.begin(), points.end());
  for (BrdfPoint& point : back) std::swap(point.i, point.o);
  return back;
}

/// The largest f of each set.
std::vector<double> peaks(std::span<const BrdfPoint> points, std::span<const double> exact) {
  std::vector<double> peak;
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (points[p].set >= peak.size()) peak.resize(points[p].set + 1, 0.0);
    peak[points[p].set] = std::max(peak[points[p].set], exact[p]);
  }
  return peak;
}

}  // namespace

std::string_view name_of(NumberPath path) {
  switch (path) {
    case NumberPath::double_scalar:
      return "double";
    case NumberPath::double_lanes:
      return "double lanes";
    case NumberPath::float_lanes:
      return "float lanes";
  }
  return "";
}

Precision precision_of(NumberPath path) {
  return path == NumberPath::float_lanes ? Precision::single : Precision::twofold;
}

BrdfEvaluator own_evaluator(const ModelSpec& spec, NumberPath path) {
  return [spec, path](std::span<const BrdfPoint> points) {
    switch (path) {
      case NumberPath::double_lanes:
        return evaluate_all<DoubleLanes>(spec, points);
      case NumberPath::float_lanes:
        return evaluate_all<FloatLanes>(spec, points);
      default:
        return evaluate_all<double>(spec, points);
    }
  };
}

BrdfEvaluator pointwise(std::function<double(const BrdfPoint&)> f) {
  return [f = std::move(f)](std::span<const BrdfPoint> points) {
    std::vector<double> values(points.size());
    tbb::parallel_for(std::size_t(0), points.size(), [&](std::size_t p) { values[p] = f(points[p]); });
    return values;
  };
}

std::vector<double> reference_values(const ModelSpec& spec, std::span<const BrdfPoint> points) {
  return pointwise([&spec](const BrdfPoint& at) {
    return reference_value(spec, at.values, at.i, at.o, at.surface, at.wavelength_um);
  })(points);
}

ErrorBar error_bar(const ModelSpec& spec, Precision precision) {
  const bool series = spec.info().needs_wavelength;
  if (precision == Precision::twofold) return series ? ErrorBar{1e-10, 1e-10} : ErrorBar{1e-12, 1e-12};
  return series ? ErrorBar{2e-5, 5e-5} : ErrorBar{5e-6, 5e-5};
}

CaseError measure(const ModelSpec& spec, Precision precision, std::string path, const BrdfEvaluator& evaluator,
                  std::span<const BrdfPoint> points, std::span<const double> exact, const MeasureOptions& options) {
  CaseError result;
  result.name = case_name(spec), result.path = std::move(path), result.spec = spec;
  result.points = points.size();
  const std::vector<double> f = evaluator(points), peak = peaks(points, exact);
  const bool reciprocal = options.reciprocal && spec.reciprocal();
  const std::vector<double> back = reciprocal ? evaluator(exchanged(points)) : f;
  std::vector<double> errors;
  std::vector<PointError> ranked;
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (!std::isfinite(f[p])) ++result.not_finite, ranked.push_back({points[p], f[p], exact[p], INFINITY});
    if (f[p] < 0) ++result.negative, ranked.push_back({points[p], f[p], exact[p], INFINITY});
    if (!std::isfinite(f[p])) continue;
    if (ill_conditioned(spec, points[p], precision)) {
      ++result.ill_conditioned;
      if (peak[points[p].set] > 0)
        result.largest_ill = std::max(result.largest_ill, std::abs(f[p] - exact[p]) / peak[points[p].set]);
      continue;
    }
    const bool twofold = precision == Precision::twofold;
    const bool bright = exact[p] > (twofold ? 1e-290 : std::max(1e-30, 1e-6 * peak[points[p].set])),
               faint = !bright && !twofold && exact[p] > 1e-30;
    if (!bright && !faint) continue;
    const double error = std::abs(f[p] - exact[p]) / exact[p];
    result.reciprocity = std::max(result.reciprocity, std::abs(f[p] - back[p]) / exact[p]);
    if (faint) ++result.faint, result.largest_faint = std::max(result.largest_faint, error);
    if (bright) ++result.bright, errors.push_back(error), result.mean += error;
    const ErrorBar bar = error_bar(spec, precision);
    ranked.push_back({points[p], f[p], exact[p], bright ? error : error * bar.bright / bar.faint});
  }
  if (!errors.empty()) {
    std::sort(errors.begin(), errors.end());
    result.largest = errors.back();
    result.percentile_999 = errors[std::size_t(0.999 * double(errors.size() - 1))];
    result.mean /= double(errors.size());
  }
  const std::size_t kept = std::min(options.worst, ranked.size());
  std::partial_sort(ranked.begin(), ranked.begin() + std::ptrdiff_t(kept), ranked.end(),
                    [](const PointError& a, const PointError& b) { return a.relative > b.relative; });
  ranked.resize(kept);
  result.worst = std::move(ranked);
  for (PointError& worst : result.worst) worst.relative = std::abs(worst.f - worst.exact) / worst.exact;
  return result;
}

std::vector<CaseError> brdf_errors(const ErrorOptions& options) {
  std::vector<ModelSpec> cases = brdf_cases();
  if (options.wanted) std::erase_if(cases, [&](const ModelSpec& spec) { return !options.wanted(spec); });
  std::vector<std::array<CaseError, 3>> found(cases.size());
  tbb::parallel_for(std::size_t(0), cases.size(), [&](std::size_t c) {
    const ModelSpec& spec = cases[c];
    const auto one = [&](NumberPath path, const std::vector<BrdfPoint>& points, const std::vector<double>& exact) {
      return measure(spec, precision_of(path), std::string(name_of(path)), own_evaluator(spec, path), points, exact,
                     options.measure);
    };
    std::vector<BrdfPoint> points = brdf_points(spec, Precision::twofold, options.points);
    std::vector<double> exact = reference_values(spec, points);
    found[c][0] = one(NumberPath::double_scalar, points, exact);
    found[c][1] = one(NumberPath::double_lanes, points, exact);
    points = brdf_points(spec, Precision::single, options.points);
    exact = reference_values(spec, points);
    found[c][2] = one(NumberPath::float_lanes, points, exact);
  });
  std::vector<CaseError> all;
  for (auto& paths : found) all.insert(all.end(), paths.begin(), paths.end());
  return all;
}

}  // namespace gonio
