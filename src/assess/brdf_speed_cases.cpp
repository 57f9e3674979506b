#include "assess/brdf_speed_cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "assess/timing.h"

namespace gonio {
namespace {

struct Path {
  const char* name;
  Precision precision;
  std::optional<NumberPath> own;
  double EvaluationCost::*ns;
};
const Path kPaths[] = {{"float lanes", Precision::single, NumberPath::float_lanes, &EvaluationCost::float_lanes},
                       {"double lanes", Precision::twofold, NumberPath::double_lanes, &EvaluationCost::double_lanes},
                       {"float", Precision::single, std::nullopt, &EvaluationCost::float_scalar},
                       {"double", Precision::twofold, NumberPath::double_scalar, &EvaluationCost::double_scalar}};

/// One point in plain float.
double in_float(const ModelSpec& spec, const BrdfPoint& at) {
  const auto f = [](double x) { return static_cast<float>(x); };
  const std::vector<float> values(at.values.begin(), at.values.end());
  const Directions<float> w = reduce(f(at.i.x), f(at.i.y), f(at.i.z), f(at.o.x), f(at.o.y), f(at.o.z));
  return evaluate(make_brdf<float>(spec, values), w,
                  Interface<float>{f(at.surface.n), f(at.surface.k), at.surface.perfect}, f(at.wavelength_um));
}

template <class T, class F>
double density_ns(F&& density) {
  constexpr std::size_t kCount = 512;
  alignas(64) static std::array<scalar_t<T>, kCount> tan2, out;
  for (std::size_t j = 0; j < kCount; ++j)
    tan2[j] = scalar_t<T>(0.3 * square((static_cast<double>((j * 37) % kCount) + 0.5) / kCount));
  const auto run = [&] {
    if constexpr (is_lanes_v<T>)
      for (std::size_t j = 0; j < kCount; j += T::size) density(T::load_aligned(&tan2[j])).store_aligned(&out[j]);
    else
      for (std::size_t j = 0; j < kCount; ++j) out[j] = density(tan2[j]);
    keep(out[0]);
  };
  return least_ns(run) / kCount;
}

}  // namespace

std::string SpeedRow::name() const {
  const std::string_view variant = spec.variant();
  return variant == "exact" ? std::string(spec.info().name) : fmt::format("{} {}", spec.info().name, variant);
}

ModelSpec exact_form(const ModelSpec& spec) {
  const bool own_formula = spec.variant() == "nieto-vesperinas-1982";
  ModelSpec exact = spec;
  if ((spec.id == ModelId::torrance_sparrow || spec.id == ModelId::beckmann_kirchhoff) && !own_formula) exact.form = 0;
  return exact;
}

std::vector<SpeedRow> speed_rows(const std::function<void(const std::string&)>& progress) {
  std::vector<SpeedRow> rows;
  for (const ModelInfo& info : models()) {
    if (info.id == ModelId::mirror || info.id == ModelId::lambert) continue;  // nothing to evaluate
    progress(std::string(info.name));
    for (std::size_t form = 0; form < info.variants.size(); ++form) {
      ModelSpec spec;
      spec.id = info.id, spec.form = form;
      if (!info.shadowings.empty() &&
          std::find(info.shadowings.begin(), info.shadowings.end(), name_of(spec.shadowing)) == info.shadowings.end())
        set_shadowing(spec, info.shadowings.front());
      const ModelSpec exact = exact_form(spec);
      std::vector<double> values = middle_values(info);
      if (spec.variant() == "schlick-d" || spec.variant() == "schlick") values[0] = std::min(values[0], 0.5);
      const EvaluationCost cost = evaluation_cost(spec, values);
      const VisibleError visible = visible_error(spec, exact, values);
      PointOptions options;
      options.sets = info.needs_wavelength ? 6 : 16;
      options.fit_box = true;
      for (const Path& path : kPaths) {
        const std::vector<BrdfPoint> points = brdf_points(spec, path.precision, options);
        const std::vector<double> judge = reference_values(exact, points);
        const BrdfEvaluator evaluator = path.own
                                            ? own_evaluator(spec, *path.own)
                                            : pointwise([spec](const BrdfPoint& at) { return in_float(spec, at); });
        const CaseError e = measure(spec, path.precision, path.name, evaluator, points, judge, {1, false});
        rows.push_back({spec, path.name, cost.*path.ns, e.largest, e.percentile_999, e.mean, visible});
      }
    }
  }
  return rows;
}

std::vector<SpeedRow> pareto_front(std::vector<SpeedRow> rows) {
  std::sort(rows.begin(), rows.end(), [](const SpeedRow& a, const SpeedRow& b) { return a.ns < b.ns; });
  std::vector<SpeedRow> front;
  for (const SpeedRow& row : rows)
    if (front.empty() || row.largest < 0.999 * front.back().largest) front.push_back(row);
  return front;
}

SchlickClaim schlick_claim() {
  SchlickClaim claim{};
  double squares = 0;
  int count = 0, relative = 0, zeros = 0;
  for (double alpha = 0.05; alpha <= 0.7001; alpha += 0.05)
    for (double theta_deg = 0.25; theta_deg < 90; theta_deg += 0.5) {
      const double t = square(std::tan(theta_deg * kPi<double> / 180)), peak = beckmann_d(0.0, alpha);
      const double truth = beckmann_d(t, alpha), rational = schlick_d(t, alpha),
                   error = std::abs(rational - truth) / peak;
      claim.mean += error, squares += square(error), ++count;
      claim.largest = std::max(claim.largest, error);
      if (truth < 1e-3 * peak) continue;
      ++relative, zeros += rational == 0;
      claim.relative_mean += std::abs(rational / truth - 1);
      claim.relative_largest = std::max(claim.relative_largest, std::abs(rational / truth - 1));
    }
  claim.mean /= count, claim.relative_mean /= relative, claim.share_of_zeros = double(zeros) / relative;
  claim.deviation = std::sqrt(squares / count - square(claim.mean));
  const double alpha = 0.3;
  claim.speed_scalar = density_ns<double>([&](double t) {
                         return std::exp(-t / (alpha * alpha)) * square(1 + t) / (kPi<double> * alpha * alpha);
                       }) /
                       density_ns<double>([&](double t) { return schlick_d(t, alpha); });
  claim.speed_lanes = density_ns<FloatLanes>([](const FloatLanes& t) { return beckmann_d(t, FloatLanes(0.3f)); }) /
                      density_ns<FloatLanes>([](const FloatLanes& t) { return schlick_d(t, FloatLanes(0.3f)); });
  return claim;
}

}  // namespace gonio
