// 95 % intervals hold the truth in 95 % of repeats: 1,000 synthetic scans for each of three models.
#include <tbb/parallel_for.h>

#include <array>
#include <atomic>
#include <boost/math/distributions/binomial.hpp>

#include "catch.h"
#include "materials/database.h"
#include "synthetic.h"

using namespace gonio;
using namespace gonio::test;

namespace {

constexpr int kRepeats = 1000;
constexpr double kLeast = 0.93, kMost = 0.97;

/// Probability that intervals which hold the truth with probability 0.95 are found outside [kLeast, kMost].
double false_alarm() {
  const boost::math::binomial repeats(kRepeats, 0.95);
  return boost::math::cdf(repeats, kLeast * kRepeats - 1) +
         boost::math::cdf(boost::math::complement(repeats, kMost * kRepeats));
}

struct Case {
  const char* model;
  const char* material;
  std::vector<double> truth;
  std::map<std::string, double> held;
  double noise;  ///< standard deviation of ln f
};

/// How many of the repeats hold the truth, for each parameter of the model.
std::vector<int> count_inside(const Case& c) {
  const ModelSpec spec = spec_of(c.model);
  const Measurement clean = empty_scan(20);
  const Interface<double> surface = SurfaceMaterial(c.material).at(550);
  std::vector<std::atomic<int>> inside(c.truth.size());
  tbb::parallel_for(0, kRepeats, [&](int repeat) {
    FitRequest request;
    request.model = spec, request.starts = 2, request.material = c.material, request.held = c.held;
    request.hold_out = HoldOut::none, request.floor_per_sr = 0;
    const auto seed = static_cast<std::uint64_t>(50000 + repeat);
    const FitResult result = fit(synthetic(clean, spec, c.truth, surface, c.noise, seed), request);
    for (std::size_t i = 0; i < c.truth.size(); ++i)
      inside[i] += result.parameters[i].lo95 <= c.truth[i] && c.truth[i] <= result.parameters[i].hi95;
  });
  return {inside.begin(), inside.end()};
}

}  // namespace

TEST_CASE("95 % intervals hold the truth in 93 to 97 % of 1,000 repeats", "[fit][coverage][slow]") {
  // A true 95 % falls outside [930, 970] with probability 0.0030 for a parameter, 0.024 for any of the eight; seeds are fixed.
  CHECK(false_alarm() == Approx(0.00305).margin(1e-5));
  const std::vector<Case> cases = {
      {"torrance-sparrow", "Au", {0.2, 0.05, 0.9}, {}, 0.05},
      {"ggx", "Al", {0.25, 0.25, 0.02, 0.8}, {{"alpha_y", 0.25}}, 0.1},
      {"oren-nayar", "perfect", {0.4, 0.0, 0.7}, {{"kd", 0.0}}, 0.05},
  };
  for (const Case& c : cases) {
    const std::vector<int> inside = count_inside(c);
    for (std::size_t i = 0; i < inside.size(); ++i) {
      const std::string name(spec_of(c.model).info().parameters[i].name);
      if (c.held.contains(name)) continue;
      INFO(c.model << " " << name << ": " << inside[i] << " of " << kRepeats);
      CHECK(inside[i] >= kLeast * kRepeats);
      CHECK(inside[i] <= kMost * kRepeats);
    }
  }
}
