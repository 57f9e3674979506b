// Every model's sampler: its density integrated in coordinates that no sampler uses, its empty samples, its histogram, the mean of its weights.
#include "brdf/sampling.h"

#include <fmt/ranges.h>

#include <boost/math/distributions/binomial.hpp>
#include <map>

#include "brdf/hemisphere_quadrature.h"
#include "brdf/sampling_cases.h"
#include "catch.h"
#include "energy/adaptive.h"
#include "energy/directional_reflectance.h"
#include "render/random.h"
#include "render/statistics.h"

using namespace gonio;
using namespace gonio::test;

namespace {

constexpr std::uint64_t kSeed = 2026;
constexpr double kFalseAlarmOfAll = 0.01;  ///< of each kind of comparison, over all cases together (Šidák)

using Lanes = DoubleLanes;
using V = UnitVector<double>;

/// What one case draws from, in double and in lanes, and where its directions gather.
struct Drawn {
  Brdf<double> brdf;
  Brdf<Lanes> lanes_brdf;
  LobeMixture<double> mixture;
  LobeMixture<Lanes> lanes;
  V o;
  UnitVector<Lanes> lanes_o;
  V center;
  double width;

  explicit Drawn(const SamplingCase& one)
      : brdf(one.brdf()),
        lanes_brdf(spread_brdf<Lanes>(one.spec, one.values)),
        mixture(lobe_mixture(brdf, kMetal.r0(), kUm)),
        lanes(lobe_mixture(lanes_brdf, Lanes(kMetal.r0()), Lanes(kUm))),
        o(one.eye()),
        lanes_o(spread<Lanes>(o)),
        center{-o.x, -o.y, o.z},
        width(0.3 * slope_extent(brdf.lobe, kUm).narrowest) {
    if (const auto* axis = std::get_if<AxisSampler<double>>(&mixture.lobe)) center = axis->axis(o);
    if (brdf.retro) center = {-center.x, -center.y, center.z};
  }

  Lanes pdf(const UnitVector<Lanes>& i) const { return lanes.pdf(i, lanes_o); }
  Lanes f_cos(const UnitVector<Lanes>& i) const {
    const auto w = reduce(i.x, i.y, i.z, lanes_o.x, lanes_o.y, lanes_o.z);
    return evaluate(lanes_brdf, w, gonio::spread<Lanes>(kMetal), Lanes(kUm)) * i.z;
  }
};

/// Share of u2 in (0, 1) for which the height is negative, from its sign at places (closer towards both ends), its roots by bisection, and its
/// extremes between places by golden sections (they may cross 0 and come back).
template <class F>
double share_below(F&& height) {
  static const std::vector<double> kPlaces = [] {
    std::vector<double> u{1e-12};
    for (double x = 1e-7; x < 0.025; x *= 3) u.push_back(x);
    for (int k = 1; k < 16; ++k) u.push_back(k / 32.0);
    for (std::size_t k = u.size(); k-- > 0;) u.push_back(1 - u[k]);
    return u;
  }();
  std::vector<std::pair<double, double>> points;  // u2, height
  for (const double u : kPlaces) points.push_back({u, height(u)});
  std::vector<std::pair<double, double>> all = points;
  for (std::size_t k = 1; k + 1 < points.size(); ++k) {
    const double sign = points[k].second > 0 ? 1 : -1;
    if (sign * points[k - 1].second < sign * points[k].second || sign * points[k + 1].second < sign * points[k].second)
      continue;
    double a = points[k - 1].first, b = points[k + 1].first;
    const double golden = 0.38196601125010515;
    double x = a + golden * (b - a), y = b - golden * (b - a), fx = sign * height(x), fy = sign * height(y);
    for (int step = 0; step < 25 && fx > 0 && fy > 0; ++step) {
      if (fx < fy)
        b = y, y = x, fy = fx, x = a + golden * (b - a), fx = sign * height(x);
      else
        a = x, x = y, fx = fy, y = b - golden * (b - a), fy = sign * height(y);
    }
    if (fx <= 0)
      all.push_back({x, sign * fx});
    else if (fy <= 0)
      all.push_back({y, sign * fy});
  }
  std::sort(all.begin(), all.end());
  double sum = 0, last = 0;
  bool under = all[0].second < 0;
  for (std::size_t k = 0; k + 1 < all.size(); ++k) {
    if ((all[k].second < 0) == (all[k + 1].second < 0)) continue;
    double a = all[k].first, b = all[k + 1].first;
    for (int step = 0; step < 36; ++step) {
      const double middle = 0.5 * (a + b);
      ((height(middle) < 0) == under ? a : b) = middle;
    }
    if (under) sum += a - last;
    last = a;
    under = !under;
  }
  return under ? sum + 1 - last : sum;
}

/// Share of a sampler's numbers (u1, u2) whose direction falls below the horizon.
template <class Sampler>
double empty_share_of(const Sampler& sampler, const V& o, double u0) {
  const auto inner = [&](double u1, Eigen::ArrayXd& out) {
    out[0] = share_below([&](double u2) {
      const V i = sampler.sample(o, u0, u1, u2).direction;
      // A direction off the disc has no height; the others' is exact.
      return std::is_same_v<Sampler, DiscSampler<double>> ? 1 - i.x * i.x - i.y * i.y : i.z;
    });
  };
  // The share has steps and roots' kinks, and one rule may agree with itself by chance: two sets of cuts judge each other, a third decides.
  const std::vector<double> ends{0, 1e-8, 1e-6, 1e-4, 0.01, 0.99, 1 - 1e-4, 1 - 1e-6, 1 - 1e-8, 1};
  const auto with_cuts = [&](std::initializer_list<int> parts) {
    std::vector<double> cuts = ends;
    for (const int n : parts)
      for (int k = 1; k < n; ++k) cuts.push_back(static_cast<double>(k) / n);
    std::sort(cuts.begin(), cuts.end());
    cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
    return integrate_adaptively(inner, cuts, 1, 3e-8, 400).value[0];
  };
  const double first = with_cuts({16}), second = with_cuts({11});
  return std::abs(first - second) < 2e-7 ? second : with_cuts({37, 48});
}

double empty_share(const LobeSampler<double>& lobe, const V& o) {
  if (std::holds_alternative<CosineSampler<double>>(lobe)) return 0;
  if (const auto* one = std::get_if<KirchhoffSampler<double>>(&lobe)) {
    const auto shares = one->shares_at(o);
    return shares.facets * empty_share_of(one->facets(), o, 0.5) +
           (0.9 - shares.facets) * empty_share_of(shares.waves, o, 0.5);
  }
  if (const auto* one = std::get_if<AshikhminShirleySampler<double>>(&lobe))
    return (1 - one->diffuse_share) * empty_share_of(*one, o, 1 - 1e-9);
  return std::visit([&](const auto& one) { return empty_share_of(one, o, 0.5); }, lobe);
}

/// What a run of samples shows.
struct Counted {
  double empty = 0, mean = 0, variance = 0, largest = 0;
  std::vector<double> seen;
};

Counted count(const Drawn& drawn, const HemisphereQuadrature& density, int samples, std::uint64_t stream) {
  Random random(kSeed, stream);
  Counted result;
  result.seen.assign(density.bins().size(), 0);
  const auto uniform = [&] {
    std::array<double, Lanes::size> u;
    for (double& one : u) one = random.uniform();
    return Lanes::load_unaligned(u.data());
  };
  double squares = 0;
  for (int s = 0; s < samples; s += int(Lanes::size)) {
    const Lanes u0 = uniform(), u1 = uniform(), u2 = uniform();
    const auto sample = drawn.lanes.sample(drawn.lanes_o, u0, u1, u2);
    const auto lit = sample.pdf_per_sr > Lanes(0.0);
    const UnitVector<Lanes>& i = sample.direction;
    const UnitVector<Lanes> safe{select(lit, i.x, Lanes(0.0)), select(lit, i.y, Lanes(0.0)),
                                 select(lit, i.z, Lanes(1.0))};
    const Lanes weight = select(lit, drawn.f_cos(safe) / select(lit, sample.pdf_per_sr, Lanes(1.0)), Lanes(0.0));
    for (std::size_t k = 0; k < Lanes::size; ++k) {
      const double one = weight.get(k);
      result.mean += one;
      squares += one * one;
      result.largest = std::max(result.largest, one);
      if (sample.pdf_per_sr.get(k) > 0)
        result.seen[density.bin_of(lane(i, k))] += 1;
      else
        result.empty += 1;
    }
  }
  result.empty /= samples;
  result.mean /= samples;
  result.variance = std::max(0.0, squares / samples - result.mean * result.mean) / samples;
  return result;
}

/// p of Pearson's χ² with the empty samples as a cell of their own (where they are enough).
double p_of_histogram(const Counted& counted, const std::vector<double>& bins, double empty, int samples) {
  double statistic = 0;
  int cells = 0;
  const auto add = [&](double seen, double expected) {
    if (expected < 10) return;
    statistic += (seen - expected) * (seen - expected) / expected;
    ++cells;
  };
  for (std::size_t k = 0; k < bins.size(); ++k) add(counted.seen[k], bins[k] * samples);
  add(counted.empty * samples, empty * samples);
  if (cells < 2) return 1;
  return boost::math::cdf(boost::math::complement(boost::math::chi_squared(cells - 1), statistic));
}

/// Bounds of `count` comparisons of which all hold with 99 %.
double least_p(std::size_t count) { return -std::expm1(std::log1p(-kFalseAlarmOfAll) / double(count)); }
double most_z(std::size_t count) {
  return boost::math::quantile(boost::math::complement(boost::math::normal(), 0.5 * least_p(count)));
}
/// How many of `count` may be beyond a bound that each passes with the chance p.
double most_beyond(std::size_t count, double p) {
  return boost::math::quantile(boost::math::complement(boost::math::binomial(double(count), p), kFalseAlarmOfAll));
}

/// A density and its empty share; several shadowings of a model share one.
struct Density {
  HemisphereQuadrature density;
  double empty;
  explicit Density(const Drawn& drawn)
      : density([&](const UnitVector<Lanes>& i) { return drawn.pdf(i); }, drawn.center, drawn.width, 2e-7),
        empty((1 - drawn.mixture.cosine_share) * empty_share(drawn.mixture.lobe, drawn.o)) {
    density.make_bins(1.0 / 64);
  }
};
std::string key_of(const SamplingCase& one, const Drawn& drawn) {
  const auto* facets = std::get_if<FacetSampler<double>>(&drawn.mixture.lobe);
  return fmt::format("{} {} {} {} {}", one.spec.info().name, one.spec.form, facets ? int(facets->visibility) : -1,
                     fmt::join(one.values, " "), one.theta_o_deg);
}

void check_all(const std::vector<SamplingCase>& cases, int samples) {
  std::size_t beyond_p = 0, beyond_3_empty = 0, beyond_3_mean = 0;
  std::map<std::string, Density> densities;
  for (std::size_t c = 0; c < cases.size(); ++c) {
    const Drawn drawn(cases[c]);
    const auto& [density, empty] = densities.try_emplace(key_of(cases[c], drawn), drawn).first->second;
    INFO(fmt::format("{}: density integrates to {:.9f} ± {:.1e}, 1 - empty {:.9f}", cases[c].name, density.integral(),
                     density.error(), 1 - empty));
    CHECK(std::abs(density.integral() - (1 - empty)) < 1e-6);

    const Counted counted = count(drawn, density, samples, c);
    const double error = std::sqrt(std::max(empty * (1 - empty), 1e-12) / samples), z = (counted.empty - empty) / error;
    INFO("empty: counted " << counted.empty << ", z " << z);
    if (empty * samples > 20) {
      CHECK(std::abs(z) < most_z(cases.size()));
      beyond_3_empty += std::abs(z) > 3;
    }
    const double p = p_of_histogram(counted, density.bins(), empty, samples);
    INFO("p of the histogram " << p << " on " << density.bins().size() << " cells");
    CHECK(p > least_p(cases.size()));
    beyond_p += p < 0.01;

    const HemisphereQuadrature energy([&](const UnitVector<Lanes>& i) { return drawn.f_cos(i); }, drawn.center,
                                      drawn.width, 1e-6 * std::max(counted.mean, 1e-300));
    const double expected = energy.integral(), deviation = std::sqrt(counted.variance);
    // Where every weight is the same the quadrature is the worse of the two; what happens to fewer than ten samples no deviation shows.
    const double slack = energy.error() + 3e-6 * expected + 10 * expected / samples;
    INFO("mean weight " << counted.mean << " ± " << deviation << ", quadrature " << expected << ", largest "
                        << counted.largest);
    CHECK(std::abs(counted.mean - expected) < most_z(cases.size()) * deviation + slack);
    beyond_3_mean += std::abs(counted.mean - expected) > 3 * deviation + slack;
    if (drawn.brdf.kd == 0 && cases[c].spec.info().reciprocal && !cases[c].spec.retro && !has_delta(drawn.brdf.lobe)) {
      const double phi_deg = 0.4 * 180 / kPi<double>;
      const Estimate e = directional_reflectance(drawn.brdf.lobe, cases[c].theta_o_deg, {{kMetal}, {kUm}},
                                                 1e-7 * std::max(1.0, expected), phi_deg)[0];
      INFO("directional reflectance " << e.value << " ± " << e.error);
      CHECK(std::abs(e.value - expected) < 2e-6 * std::max(1.0, expected) + energy.error() + e.error);
    }
  }
  CHECK(double(beyond_p) <= most_beyond(cases.size(), 0.01));
  CHECK(double(beyond_3_empty) <= most_beyond(cases.size(), 0.0027));
  CHECK(double(beyond_3_mean) <= most_beyond(cases.size(), 0.0027));
}

}  // namespace

TEST_CASE("Every sampler: density, empty samples, histogram and mean weight, in the middle of the box",
          "[brdf][sampling][slow]") {
  check_all(sampling_cases({0.5}, {60, 89}), 1 << 14);
}

TEST_CASE("Every sampler over roughness and incidence", "[brdf][sampling][slow]") {
  check_all(sampling_cases({0, 1}, {0, 30, 89}), 1 << 14);
}
