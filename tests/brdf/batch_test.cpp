// Pairs of directions in batches, the series in lanes, and derivatives in lanes.
#include "brdf/batch.h"

#include <random>

#include "base/dual.h"
#include "base/jet.h"
#include "catch.h"
#include "oracles/fifty_digits.h"

using namespace gonio;

namespace {

struct Pairs {
  std::vector<double> v[6];
  explicit Pairs(std::size_t count) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (std::size_t p = 0; p < count; ++p)
      for (const int first : {0, 3}) {
        const double z = 0.02 + 0.98 * uniform(random), phi = 2 * kPi<double> * uniform(random),
                     r = std::sqrt(1 - z * z);
        v[first].push_back(r * std::cos(phi)), v[first + 1].push_back(r * std::sin(phi)), v[first + 2].push_back(z);
      }
  }
  DirectionPairs<double> spans() const { return {v[0], v[1], v[2], v[3], v[4], v[5]}; }
};

const Interface<double> kMetal{0.96, 6.7};

}  // namespace

TEST_CASE("Batches give what single evaluations give: every model, any length, turned back too", "[brdf][batch]") {
  const Pairs pairs(37);  // whole batches and a rest
  std::vector<double> f(37);
  for (const ModelInfo& info : models())
    for (const bool retro : {false, true}) {
      ModelSpec spec;
      spec.id = info.id, spec.retro = retro && info.id != ModelId::lambert;
      if (!info.shadowings.empty() &&
          std::find(info.shadowings.begin(), info.shadowings.end(), name_of(spec.shadowing)) == info.shadowings.end())
        set_shadowing(spec, info.shadowings.front());
      std::vector<double> values;
      for (const ParameterInfo& p : info.parameters)
        values.push_back(p.linear ? 0.4 : p.fit_lo > 0 ? std::sqrt(p.fit_lo * p.fit_hi) : 0.1);
      evaluate_pairs<DoubleLanes>(spread_brdf<DoubleLanes>(spec, values), pairs.spans(), spread<DoubleLanes>(kMetal),
                                  DoubleLanes(0.55), f);
      const Brdf<double> brdf = make_brdf<double>(spec, values);
      for (std::size_t p = 0; p < f.size(); ++p) {
        const auto& v = pairs.v;
        const double one = evaluate(brdf, reduce(v[0][p], v[1][p], v[2][p], v[3][p], v[4][p], v[5][p]), kMetal, 0.55);
        INFO(info.name << (retro ? " retro" : "") << " pair " << p << ": " << f[p] << " " << one);
        REQUIRE(std::abs(f[p] - one) <= (info.needs_wavelength ? 1e-10 : 3e-13) * one + 1e-300);
      }
    }
}

TEST_CASE("A batch leaves the processor's rounding of small numbers as it was", "[brdf][batch]") {
  const volatile double small = 1e-300;
  { const FlushToZero flush; }
  CHECK(small * 1e-15 > 0);
}

TEST_CASE("The series in lanes against the 50-digit sum, on both sides of its turn", "[brdf][batch]") {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  double worst_double = 0, worst_float = 0, faint = 0;
  for (int i = 0; i < 500; ++i) {
    const double g = i % 3 == 0 ? 10 + 40 * uniform(random) : std::pow(10, -6 + 10 * uniform(random));
    const double b = i % 4 == 0 ? 0.0 : i % 4 == 1 ? g * 10 * uniform(random) : 2500 * square(uniform(random));
    const auto gf = static_cast<float>(g), bf = static_cast<float>(b);
    const double exact = oracle::kirchhoff_sum(g, b).convert_to<double>(),
                 exact_f = oracle::kirchhoff_sum(double(gf), double(bf)).convert_to<double>();
    INFO("g " << g << " b " << b);
    if (exact > 1e-290)
      worst_double = std::max(
          worst_double,
          std::abs(value_of_series<DoubleLanes>({DoubleLanes(g), DoubleLanes(b), DoubleLanes(1.0)}).get(0) / exact -
                   1));
    const double f = value_of_series<FloatLanes>({FloatLanes(gf), FloatLanes(bf), FloatLanes(1.0F)}).get(0),
                 error = std::abs(f / exact_f - 1);
    if (exact_f > 1e-6 * oracle::kirchhoff_sum(double(gf), 0).convert_to<double>())
      worst_float = std::max(worst_float, error);
    else if (exact_f > 1e-30)
      faint = std::max(faint, error);
  }
  INFO("double " << worst_double << ", float " << worst_float << ", faint " << faint);
  CHECK(worst_double < 1e-10);
  CHECK(worst_float < 1e-5);
  CHECK(faint < 5e-5);
}

TEST_CASE("Below its least X the bell of the series loses what the terms keep", "[brdf][batch]") {
  const auto lost = [](double g) {
    const auto peak = series_peak(DoubleLanes(g), DoubleLanes(0.0));
    const double bell = sum_by_bell(DoubleLanes(g), DoubleLanes(0.0), peak).get(0) * 0x1p-90;
    return std::abs(bell / oracle::kirchhoff_sum(g, 0).convert_to<double>() - 1);
  };
  CHECK(lost(LaneSeries<double>::least) < 1e-10);
  CHECK(lost(0.6 * LaneSeries<double>::least) > 1e-8);
}

TEST_CASE("Many sums at a time are those of one at a time, whichever way each lane takes", "[brdf][batch]") {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto check = [&]<class Lanes>(Lanes, double bound) {
    using S = scalar_t<Lanes>;
    std::array<Lanes, 7> g, b, sum;
    int wrong = 0, terms = 0;
    for (int round = 0; round < 60; ++round) {
      const double least_log = round % 3 - 1, width = round % 4;
      for (std::size_t i = 0; i < g.size(); ++i) {
        alignas(64) std::array<S, Lanes::size> gs, bs;
        for (std::size_t lane = 0; lane < Lanes::size; ++lane)
          gs[lane] = S(std::pow(10, least_log + width * uniform(random))), bs[lane] = S(80 * uniform(random));
        g[i] = Lanes::load_aligned(gs.data()), b[i] = Lanes::load_aligned(bs.data());
      }
      poisson_lobe_sums(g, b, sum);
      for (std::size_t i = 0; i < g.size(); ++i)
        for (std::size_t lane = 0; lane < Lanes::size; ++lane) {
          const double one = poisson_lobe_sum_in_lanes(Lanes(g[i].get(lane)), Lanes(b[i].get(lane))).get(0);
          terms += g[i].get(lane) < S(5);
          wrong += !(std::abs(sum[i].get(lane) / one - 1) < bound);
        }
    }
    CHECK(terms > 1000);  // lanes of both kinds were there
    CHECK(wrong == 0);
  };
  check(DoubleLanes(), 1e-10);  // a lane may share more terms than it needs alone
  check(FloatLanes(), 1e-5);
}

TEST_CASE("A product of factors with their own variables has the derivatives of the whole", "[brdf][batch]") {
  using V = DoubleLanes;
  using All = Dual<V, 3>;
  for (const double theta : {1.0, 40.0, 85.0})
    for (const double alpha : {0.02, 0.3, 2.0}) {
      const Directions<V> w = spread<V>(directions_from_deg(theta, theta / 2, 150.0));
      const All whole = lobe_value<All>(TorranceSparrow<All>{All(V(alpha), 0)}, w,
                                        Interface<All>{All(V(0.21), 1), All(V(3.272), 2)}, All(0.55));
      const TorranceSparrow<Dual<V, 1>> lobe{Dual<V, 1>(V(alpha), 0)};
      const Interface<Dual<V, 2>> gold{Dual<V, 2>(V(0.21), 0), Dual<V, 2>(V(3.272), 1)};
      const All product = joint_product(lobe.shape_fraction(w), gold.reflectance_of_cos2(w.cos2_d()));
      INFO(theta << " " << alpha);
      if (whole.a.get(0) < 1e-200) continue;
      CHECK(product.a.get(0) == Approx(whole.a.get(0)).epsilon(1e-13));
      for (std::size_t i = 0; i < 3; ++i)
        CHECK(product.v[i].get(0) == Approx(whole.v[i].get(0)).epsilon(1e-11).margin(1e-14 * whole.a.get(0)));
    }
}

TEST_CASE("Derivatives in lanes equal ceres::Jet's, the series included", "[brdf][batch]") {
  using D = Dual<DoubleLanes, 4>;
  using J = Jet<4>;
  for (const ModelId id :
       {ModelId::torrance_sparrow, ModelId::beckmann_kirchhoff, ModelId::he_1991, ModelId::pseudo_realistic})
    for (const double theta : {0.0, 35.0, 75.0}) {
      std::vector<double> values;
      for (const ParameterInfo& p : model(id).parameters)
        values.push_back(p.linear ? 0.4 : std::sqrt(p.fit_lo * p.fit_hi));
      std::vector<D> duals;
      std::vector<J> jets;
      for (std::size_t p = 0; p < values.size(); ++p) {
        duals.emplace_back(DoubleLanes(values[p]), int(p));
        jets.emplace_back(values[p], int(p));
      }
      const Directions<double> w = directions_from_deg(theta, theta + 4, 170.0);
      const D f =
          evaluate(make_brdf<D>({id}, duals), spread<DoubleLanes>(w), Interface<D>{D(kMetal.n), D(kMetal.k)}, D(0.55));
      const J g = evaluate(make_brdf<J>({id}, jets), w, Interface<J>{J(kMetal.n), J(kMetal.k)}, J(0.55));
      INFO(model(id).name << " at " << theta);
      CHECK(f.a.get(0) == Approx(g.a).epsilon(1e-10));
      for (std::size_t p = 0; p < values.size(); ++p)
        CHECK(f.v[p].get(0) == Approx(g.v[int(p)]).epsilon(1e-8).margin(1e-12 * g.a / values[p]));
    }
}

TEST_CASE("Rival sums: cut series lose the lobe, the Gauss rule its tail", "[brdf]") {
  const auto relative = [](double sum, double g, double b) {
    return std::abs(sum / oracle::kirchhoff_sum(g, b).convert_to<double>() - 1);
  };
  CHECK(relative(poisson_lobe_fixed_terms(0.5, 1.0, 1.0, 10), 0.5, 1.0) < 1e-9);
  CHECK(relative(poisson_lobe_fixed_terms(8.0, 1.0, 1.0, 40), 8.0, 1.0) < 1e-12);
  CHECK(relative(poisson_lobe_fixed_terms(400.0, 0.0, 1.0, 40), 400.0, 0.0) > 0.999);
  CHECK(relative(poisson_lobe_gauss<12>(100.0, 0.0, 1.0), 100.0, 0.0) < 1e-12);  // PHYSICS: 12 nodes 1e-14 at 100
  CHECK(relative(poisson_lobe_gauss<12>(1000.0, 1000.0, 1.0), 1000.0, 1000.0) < 1e-9);
  CHECK(relative(poisson_lobe_gauss<12>(100.0, 20000.0, 1.0), 100.0, 20000.0) > 0.1);
}
