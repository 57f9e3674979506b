// Special functions in lanes against 50 digits (MPFR's own erfc and exp): the errors that base/special.h states, and what its
// thresholds cut.
#include "base/special.h"

#include <random>

#include "catch.h"
#include "oracles/fifty_digits.h"

using namespace gonio;
using oracle::Real;

namespace {

/// 1 + 2Λ at s = 1/a as Smith prints it.
Real visible(const Real& s) {
  const Real a = 1 / s;
  return Real(erf(a) + s * exp(-a * a) / sqrt(oracle::pi()));
}
Real erfcx_of(const Real& x) { return Real(exp(x * x) * erfc(x)); }
Real q_of(const Real& x) { return Real(1 / sqrt(oracle::pi()) - x * erfcx_of(x)); }

/// Largest relative error over x = 10^lo … 10^hi.
template <class Lanes, class F, class Exact>
double worst(double lo, double hi, F&& f, Exact&& exact) {
  using S = scalar_t<Lanes>;
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> exponent(lo, hi);
  double largest = 0;
  for (int i = 0; i < 3000; ++i) {
    const S x = S(std::pow(10, exponent(random)));
    const Real truth = exact(Real(x));
    largest = std::max(largest, std::abs(Real(Real(f(Lanes(x)).get(0)) / truth - 1).template convert_to<double>()));
  }
  return largest;
}

}  // namespace

TEST_CASE("Lanes: erfcx, q, exp, log1p and 1 + 2 Lambda lose what they say", "[special]") {
  const auto erfcx_lanes = [](const auto& x) { return erfcx(x); };
  const auto q_lanes = [](const auto& x) { return erfcx_q(x); };
  const auto decay = [](const auto& x) { return exp_of_decay<0>(-x); };
  const auto logarithm = [](const auto& x) { return fast_log1p(x); };
  const auto smith = [](const auto& s) { return smith_visible(s * s).value(); };
  const auto decay_truth = [](const Real& x) { return Real(exp(-x)); };
  const auto log_truth = [](const Real& x) { return Real(log1p(x)); };
  CHECK(worst<DoubleLanes>(-8, 1.4, erfcx_lanes, erfcx_of) < 1e-15);
  CHECK(worst<FloatLanes>(-8, 1.4, erfcx_lanes, erfcx_of) < 4e-7);
  CHECK(worst<DoubleLanes>(-8, 1.4, q_lanes, q_of) < 2e-15);
  CHECK(worst<FloatLanes>(-8, 1.4, q_lanes, q_of) < 8e-7);
  CHECK(worst<DoubleLanes>(-8, 2.8, decay, decay_truth) < 5e-16);
  CHECK(worst<FloatLanes>(-8, 1.9, decay, decay_truth) < 1.2e-7);
  CHECK(worst<DoubleLanes>(-12, 30, logarithm, log_truth) < 1e-15);
  CHECK(worst<FloatLanes>(-12, 30, logarithm, log_truth) < 3e-7);
  const auto log_of = [](const auto& x) { return fast_log(x + std::remove_cvref_t<decltype(x)>(1.5F)); };
  const auto log_of_truth = [](const Real& x) { return Real(log(Real(1.5 + x))); };
  CHECK(worst<DoubleLanes>(-8, 30, log_of, log_of_truth) < 1e-15);
  CHECK(worst<FloatLanes>(-8, 30, log_of, log_of_truth) < 4e-7);
  CHECK(worst<DoubleLanes>(-4, 7, smith, visible) < 2e-14);
  CHECK(worst<FloatLanes>(-4, 7, smith, visible) < 3e-7);
  // Scalars stay at the last place.
  double scalar = 0;
  for (double s = 1e-3; s < 1e6; s *= 1.07)
    scalar = std::max(scalar,
                      std::abs(Real(Real(smith_visible(s * s).value()) / visible(Real(s)) - 1).convert_to<double>()));
  CHECK(scalar < 2e-15);
}

TEST_CASE("1 + 2 Lambda is held at 1 where it differs from 1 by less than its error, and not before", "[special]") {
  const auto beyond = [](double least) { return Real(visible(Real(std::sqrt(least))) - 1).convert_to<double>(); };
  CHECK(beyond(kSmithLeast) < 3e-14);
  CHECK(beyond(2 * kSmithLeast) > 1e-9);
  CHECK(beyond(kSmithLeastFloat) < 1e-7);
  CHECK(beyond(2 * kSmithLeastFloat) > 1e-5);
  CHECK(smith_visible(DoubleLanes(0.0)).value().get(0) == Approx(1).epsilon(2e-14));
  CHECK(smith_visible(0.0).value() == 1);
}

TEST_CASE("Exponentials of a decay: 2^power more range, no zero, no NaN at the ends", "[special]") {
  CHECK(exp_of_decay<90>(FloatLanes(-120.0F)).get(0) == Approx(std::exp(-120.0) * 0x1p90).epsilon(3e-6));
  CHECK(exp_of_decay<0>(FloatLanes(-120.0F)).get(0) < 2e-38F);
  CHECK(exp_of_decay<0>(FloatLanes(-INFINITY)).get(0) > 0);
  CHECK(exp_of_decay<90>(DoubleLanes(-750.0)).get(0) == Approx(std::exp(-750.0 + 90 * std::log(2.0))).epsilon(1e-12));
  CHECK(fast_exp(DoubleLanes(-INFINITY)).get(0) == 0);
  CHECK(fast_exp(FloatLanes(-100.0F)).get(0) == 0);
  CHECK(std::isfinite(fast_exp(FloatLanes(1e4F)).get(0)));
}
