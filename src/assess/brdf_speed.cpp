#include "assess/brdf_speed.h"

#include <cmath>

#include "assess/pair_arrays.h"
#include "assess/timing.h"

namespace gonio {
namespace {

constexpr std::size_t kPairs = PairArrays<double>::kPairs;

const Interface<double> kGold{0.21, 3.272};
constexpr double kUm = 0.55;

template <class Lanes>
double lanes_ns(const ModelSpec& spec, const std::vector<double>& values) {
  using S = scalar_t<Lanes>;
  PairArrays<S> arrays;
  const Brdf<Lanes> brdf = spread_brdf<Lanes>(spec, values);
  const Interface<Lanes> surface = spread<Lanes>(kGold);
  const auto run = [&] {
    evaluate_pairs<Lanes>(brdf, arrays.pairs(), surface, Lanes(S(kUm)), arrays.out);
    keep(arrays.out[0]);
  };
  return least_ns(run, 1, 5) / kPairs;
}

template <class S>
double scalar_ns(const ModelSpec& spec, const std::vector<double>& values) {
  PairArrays<S> arrays;
  const Brdf<S> brdf = make_brdf<S>(spec, std::vector<S>(values.begin(), values.end()));
  const Interface<S> surface{S(kGold.n), S(kGold.k)};
  const auto run = [&] {
    for (std::size_t p = 0; p < kPairs; ++p) arrays.out[p] = evaluate(brdf, arrays.reduced(p), surface, S(kUm));
    keep(arrays.out[0]);
  };
  return least_ns(run, 1, 5) / kPairs;
}

double plain_fresnel(double c, double n, double k) {
  const double s2 = (1 - c) * (1 + c), t = (n - 1) * (n + 1) - k * k + c * c, q = std::sqrt(t * t + 4 * n * n * k * k);
  const double larger = std::sqrt(0.5 * (q + std::abs(t))) + 1e-30, smaller = n * k / larger,
               a = t >= 0 ? larger : smaller;
  const double r_s = (q - 2 * a * c + c * c) / (q + 2 * a * c + c * c), p = q * c * c + s2 * s2, r = 2 * a * c * s2;
  return 0.5 * r_s * (1 + (p - r) / (p + r));
}

double plain_lambda(double c, double alpha) {
  const double a = c / (std::sqrt((1 - c) * (1 + c)) * alpha);
  return 0.5 * (std::exp(-a * a) / (a * kSqrtPi<double>)-std::erfc(a));
}

}  // namespace

double plain_beckmann(const UnitVector<double>& i, const UnitVector<double>& o, double alpha, double n, double k) {
  const double hx = i.x + o.x, hy = i.y + o.y, hz = i.z + o.z, c = 0.5 * std::sqrt(hx * hx + hy * hy + hz * hz);
  const double t = (hx * hx + hy * hy) / (hz * hz);
  const double d = std::exp(-t / (alpha * alpha)) * (1 + t) * (1 + t) / (kPi<double> * alpha * alpha);
  return d * plain_fresnel(c, n, k) / ((1 + plain_lambda(i.z, alpha) + plain_lambda(o.z, alpha)) * 4 * i.z * o.z);
}

double plain_loop_ns() {
  PairArrays<double> arrays;
  const auto run = [&] {
    for (std::size_t p = 0; p < kPairs; ++p)
      arrays.out[p] = plain_beckmann(arrays.i(p), arrays.o(p), 0.3, kGold.n, kGold.k);
    keep(arrays.out[0]);
  };
  return least_ns(run) / kPairs;
}

std::vector<double> middle_values(const ModelInfo& info) {
  std::vector<double> values;
  for (const ParameterInfo& p : info.parameters)
    values.push_back(p.name == "kd" && info.id != ModelId::lambert
                         ? 0
                         : p.fallback.value_or(p.fit_lo > 0 ? std::sqrt(p.fit_lo * p.fit_hi) : 0.5));
  return values;
}

EvaluationCost evaluation_cost(const ModelSpec& spec, const std::vector<double>& values) {
  return {lanes_ns<FloatLanes>(spec, values), lanes_ns<DoubleLanes>(spec, values), scalar_ns<float>(spec, values),
          scalar_ns<double>(spec, values)};
}

std::vector<DiffractionCost> diffraction_costs() {
  std::vector<DiffractionCost> costs;
  const ModelSpec spec{ModelId::beckmann_kirchhoff};
  for (const double g : {1e-8, 1e-4, 1e-2, 0.1, 1.0, 3.0, 10.0, 20.0, 30.0, 50.0, 100.0, 300.0, 1e3, 1e4, 1e5, 1e6}) {
    const double sigma_um = std::sqrt(g) * kUm / (4 * kPi<double>), correlation_um = std::max(10 * sigma_um, 2.0);
    const std::vector<double> values{sigma_um, correlation_um, 0, 1};
    costs.push_back({g, lanes_ns<FloatLanes>(spec, values), lanes_ns<DoubleLanes>(spec, values)});
  }
  return costs;
}

}  // namespace gonio
