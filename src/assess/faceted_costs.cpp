// The loops behind the ratios of torrance-sparrow.
#include "assess/brdf_speed.h"
#include "assess/derivative_loop.h"
#include "assess/pair_arrays.h"
#include "assess/timing.h"
#include "base/jet.h"

namespace gonio {
namespace {

constexpr std::size_t kPairs = PairArrays<double>::kPairs, kWavelengths = 16;
constexpr double kAlpha = 0.3, kN = 0.21, kK = 3.272;

template <class S>
using Array = typename PairArrays<S>::template Array<S>;

/// Metals of a spectrum: n and k at 16 wavelengths.
template <class T>
std::array<Interface<T>, kWavelengths> metals() {
  std::array<Interface<T>, kWavelengths> all;
  for (std::size_t w = 0; w < kWavelengths; ++w)
    all[w] = {T(scalar_t<T>(1.4 - 0.08 * static_cast<double>(w))), T(scalar_t<T>(1.9 + 0.12 * static_cast<double>(w)))};
  return all;
}

template <class Lanes>
TorranceSparrow<Lanes> lobe() {
  return {Lanes(scalar_t<Lanes>(kAlpha))};
}

/// One wavelength, pairs in lanes.
template <class Lanes>
double lanes_ns() {
  using S = scalar_t<Lanes>;
  PairArrays<S> pairs;
  const Brdf<Lanes> brdf{lobe<Lanes>(), Lanes(S(0)), Lanes(S(1))};
  const Interface<Lanes> surface{Lanes(S(kN)), Lanes(S(kK))};
  const auto run = [&] {
    evaluate_pairs<Lanes>(brdf, pairs.pairs(), surface, Lanes(S(0.55)), pairs.out);
    keep(pairs.out[0]);
  };
  return least_ns(run) / kPairs;
}

/// 16 wavelengths of each pair, pairs in lanes: the lobe's shape once, R 16 times.
template <class Lanes>
GONIO_ONE_LOOP void sixteen(const TorranceSparrow<Lanes> model,
                              const std::array<Interface<Lanes>, kWavelengths>& surfaces,
                              const PairArrays<scalar_t<Lanes>>& pairs, scalar_t<Lanes>* out) {
  for (std::size_t at = 0; at < kPairs; at += Lanes::size) {
    const Directions<Lanes> w = pairs.template lanes<Lanes>(at);
    const Lanes shape = model.shape(w), cos2_d = w.cos2_d();
    for (std::size_t c = 0; c < kWavelengths; ++c)
      (shape * surfaces[c].reflectance_of_cos2(cos2_d).value()).store_aligned(out + c * kPairs + at);
  }
}

template <class Lanes>
double sixteen_ns() {
  using S = scalar_t<Lanes>;
  const PairArrays<S> pairs;
  const auto surfaces = metals<Lanes>();
  Array<S> out(kPairs * kWavelengths);
  const FlushToZero flush;
  const auto run = [&] {
    sixteen<Lanes>(lobe<Lanes>(), surfaces, pairs, out.data());
    keep(out[0]);
  };
  return least_ns(run) / kPairs;
}

/// One pair after the other, in double; its wavelengths side by side.
double one_pair_ns() {
  PairArrays<double> pairs;
  const Brdf<double> brdf{TorranceSparrow<double>{kAlpha}, 0.0, 1.0};
  const Interface<double> surface{kN, kK};
  const auto run = [&] {
    for (std::size_t p = 0; p < kPairs; ++p) pairs.out[p] = evaluate(brdf, pairs.reduced(p), surface, 0.55);
    keep(pairs.out[0]);
  };
  return least_ns(run) / kPairs;
}

template <class Lanes>
double one_pair_sixteen_ns() {
  using S = scalar_t<Lanes>;
  constexpr std::size_t kBlocks = kWavelengths / Lanes::size + (kWavelengths % Lanes::size != 0);
  const PairArrays<double> pairs;
  std::array<Interface<Lanes>, kBlocks> surfaces;
  for (std::size_t b = 0; b < kBlocks; ++b) {
    alignas(64) std::array<S, Lanes::size> n, k;
    for (std::size_t lane = 0; lane < Lanes::size; ++lane) {
      const Interface<double> one = metals<double>()[std::min(b * Lanes::size + lane, kWavelengths - 1)];
      n[lane] = S(one.n), k[lane] = S(one.k);
    }
    surfaces[b] = {Lanes::load_aligned(n.data()), Lanes::load_aligned(k.data())};
  }
  Array<S> out(kPairs * kBlocks * Lanes::size);
  const TorranceSparrow<double> model{kAlpha};
  const auto run = [&] {
    for (std::size_t p = 0; p < kPairs; ++p) {
      const auto w = pairs.reduced(p);
      const Lanes shape = Lanes(S(model.shape(w))), cos2_d = Lanes(S(w.cos2_d()));
      for (std::size_t b = 0; b < kBlocks; ++b)
        (shape * surfaces[b].reflectance_of_cos2(cos2_d).value())
            .store_aligned(out.data() + (p * kBlocks + b) * Lanes::size);
    }
    keep(out[0]);
  };
  return least_ns(run) / kPairs;
}

/// f and its derivatives by alpha, n, k.
double jet_ns() {
  using J = Jet<3>;
  const PairArrays<double> pairs;
  std::vector<J> out(kPairs);
  const TorranceSparrow<J> model{J(kAlpha, 0)};
  const Interface<J> surface{J(kN, 1), J(kK, 2)};
  const auto run = [&] {
    for (std::size_t p = 0; p < kPairs; ++p) out[p] = lobe_value<J>(model, pairs.reduced(p), surface, J(0.55));
    keep(out[0]);
  };
  return least_ns(run) / kPairs;
}

double dual_ns() {
  const PairArrays<double> pairs;
  Array<double> out(4 * kPairs);
  const auto run = [&] {
    derivatives_in_lanes(kAlpha, kN, kK, pairs, out.data());
    keep(out[0]);
  };
  return least_ns(run) / kPairs;
}

/// Independent chains of fused multiply-adds, in numbers (lanes) a ns.
template <class Lanes>
GONIO_ONE_LOOP double ceiling() {
  using S = scalar_t<Lanes>;
  constexpr int kChains = 12, kSteps = 200;
  std::array<Lanes, kChains> x;
  x.fill(Lanes(S(1)));
  const Lanes factor(S(0.999)), shift(S(1e-3));
  const auto run = [&] {
    for (int step = 0; step < kSteps; ++step)
      for (Lanes& one : x) one = multiply_add(one, factor, shift);
    keep(x[0]);
  };
  return kChains * kSteps * static_cast<double>(Lanes::size) / least_ns(run);
}

OperationCount operations() {
  const auto of = [](double x) { return Counted(x); };
  const auto evaluate_one = [&] {
    const auto w = reduce(of(0.6), of(0), of(0.8), of(-0.36), of(0.48), of(0.8));
    keep(lobe_value<Counted>(TorranceSparrow<Counted>{of(kAlpha)}, w, Interface<Counted>{of(kN), of(kK)}, of(0.55)));
  };
  return operations_of(evaluate_one);
}

}  // namespace

FacetedCosts faceted_costs() {
  FacetedCosts c{};
  c.plain = plain_loop_ns();
  c.double_lanes = lanes_ns<DoubleLanes>();
  c.float_lanes = lanes_ns<FloatLanes>();
  c.jet = jet_ns();
  c.dual_lanes = dual_ns();
  c.one_pair = one_pair_ns();
  c.one_pair_16 = one_pair_sixteen_ns<DoubleLanes>();
  c.one_pair_16f = one_pair_sixteen_ns<FloatLanes>();
  c.lanes_16 = sixteen_ns<DoubleLanes>();
  c.float_lanes_16 = sixteen_ns<FloatLanes>();
  c.fma_per_ns_double = ceiling<DoubleLanes>();
  c.fma_per_ns_float = ceiling<FloatLanes>();
  c.plain = std::min(c.plain, plain_loop_ns());
  c.operations = operations();
  return c;
}

}  // namespace gonio
