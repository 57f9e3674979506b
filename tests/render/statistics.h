#pragma once
// Tests of random estimators. Every test names its false-alarm rate; seeds are fixed, so that a passing test stays
// passing.
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/poisson.hpp>
#include <cmath>
#include <vector>

namespace gonio::test {

/// Probability that all of a test's comparisons together raise a false alarm.
inline constexpr double kFalseAlarm = 1e-4;

/// Two-sided bound on a standard normal value, such that `count` of them stay within with 1 - kFalseAlarm (Šidák).
inline double sidak_bound(std::size_t count) {
  const double one = -std::expm1(std::log1p(-kFalseAlarm) / static_cast<double>(count));
  return boost::math::quantile(boost::math::complement(boost::math::normal(), one / 2));
}

/// How many of `count` normal values may lie beyond `bound` with a false alarm of kFalseAlarm (Poisson).
inline std::size_t allowed_beyond(double bound, std::size_t count) {
  const double each = 2 * boost::math::cdf(boost::math::complement(boost::math::normal(), bound));
  const boost::math::poisson expected(each * static_cast<double>(count));
  std::size_t most = 0;
  while (boost::math::cdf(boost::math::complement(expected, static_cast<double>(most))) > kFalseAlarm) ++most;
  return most;
}

/// Values that should be standard normal: the largest, how many lie beyond 4, their sum over √count, Σz².
struct Normality {
  std::size_t count = 0, beyond_4 = 0;
  double largest = 0, sum = 0, squares = 0;

  void add(double z) {
    ++count;
    beyond_4 += std::abs(z) > 4;
    largest = std::max(largest, std::abs(z));
    sum += z;
    squares += z * z;
  }
  double mean_z() const { return sum / std::sqrt(static_cast<double>(count)); }
  /// Σz² has mean count and variance 2·count.
  double spread_z() const { return (squares - static_cast<double>(count)) / std::sqrt(2 * static_cast<double>(count)); }
  bool holds() const {
    return beyond_4 <= allowed_beyond(4, count) && largest <= sidak_bound(count) &&
           std::abs(mean_z()) <= sidak_bound(1);
  }
};

/// Does a histogram agree with expected counts? Cells expected to hold under 10 are merged. Pearson's χ², kFalseAlarm.
inline bool chi_square_agrees(const std::vector<double>& seen, const std::vector<double>& expected) {
  double statistic = 0, rest_seen = 0, rest_expected = 0;
  int cells = 0;
  const auto add = [&](double s, double e) {
    statistic += (s - e) * (s - e) / e;
    ++cells;
  };
  for (std::size_t c = 0; c < seen.size(); ++c) {
    if (expected[c] >= 10) {
      add(seen[c], expected[c]);
    } else {
      rest_seen += seen[c];
      rest_expected += expected[c];
    }
  }
  if (rest_expected >= 10) add(rest_seen, rest_expected);
  const boost::math::chi_squared law(std::max(1, cells - 1));
  return statistic <= boost::math::quantile(boost::math::complement(law, kFalseAlarm));
}

}  // namespace gonio::test
