#include "surface/roughness.h"

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

#include "base/error.h"
#include "base/number.h"

namespace gonio {
namespace {

constexpr std::size_t kFewestStretches = 8, kMostStretches = 40;
constexpr double kStretchOverT = 5;
const double kOneOverE = std::exp(-1.0);

/// Mean products over a set of stretches: lags 0 …, then squares of first and second differences over Δ and 2Δ.
struct Moments {
  std::vector<double> sum, count;
  explicit Moments(std::size_t lags) : sum(lags + 4), count(lags + 4) {}
  std::size_t lags() const { return sum.size() - 4; }
  double mean(std::size_t k) const { return sum[k] / count[k]; }
  double difference(std::size_t k) const { return mean(lags() + k); }
  void add(const Moments& other, double sign) {
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += sign * other.sum[k], count[k] += sign * other.count[k];
  }
};

/// Products whose first point lies in [from, to).
Moments moments_of(const HeightProfile& p, std::size_t from, std::size_t to, std::size_t lags) {
  Moments m(lags);
  const std::vector<double>& z = p.z_um;
  for (std::size_t lag = 0; lag < lags; ++lag)
    for (std::size_t i = from; i < to && i + lag < z.size(); ++i) m.sum[lag] += z[i] * z[i + lag], m.count[lag] += 1;
  for (std::size_t s = 1; s <= 2; ++s) {
    const double h = p.step_um * static_cast<double>(s);
    for (std::size_t i = from; i < to; ++i) {
      if (i + s < z.size()) m.sum[lags + s - 1] += square((z[i + s] - z[i]) / h), m.count[lags + s - 1] += 1;
      if (i + 2 * s < z.size())
        m.sum[lags + s + 1] += square((z[i + 2 * s] - 2 * z[i + s] + z[i]) / (h * h)), m.count[lags + s + 1] += 1;
    }
  }
  return m;
}

/// Where C falls to C(0)/e, in steps; none when it does not.
std::optional<double> fall_to_1_e(const Moments& m) {
  for (std::size_t j = 1; j < m.lags(); ++j) {
    const double a = m.mean(j - 1) / m.mean(0), b = m.mean(j) / m.mean(0), lo = static_cast<double>(j - 1);
    if (b > kOneOverE) continue;
    if (b <= 0) return lo + (a - kOneOverE) / (a - b);
    const double share = (std::log(a) + 1) / (std::log(a) - std::log(b));
    return std::sqrt(lo * lo + share * (2 * lo + 1));
  }
  return std::nullopt;
}

/// From Δ and 2Δ to 0: the error of a difference quotient's square starts with Δ². Never below the one at Δ.
double extrapolated(double at_step, double at_two) { return std::sqrt(std::max((4 * at_step - at_two) / 3, at_step)); }

enum class Statistic { sigma, correlation, slope, curvature };

std::optional<double> statistic(const Moments& m, double step_um, Statistic which) {
  switch (which) {
    case Statistic::sigma: return std::sqrt(m.mean(0));
    case Statistic::slope: return extrapolated(m.difference(0), m.difference(1));
    case Statistic::curvature: return extrapolated(m.difference(2), m.difference(3));
    case Statistic::correlation: break;
  }
  const auto steps = fall_to_1_e(m);
  return steps ? std::optional(*steps * step_um) : std::nullopt;
}

/// Jackknife over stretches, on the logarithm.
Estimate estimate(const Moments& all, const std::vector<Moments>& stretches, double step_um, Statistic which) {
  Estimate result{*statistic(all, step_um, which), std::nullopt};
  const auto count = static_cast<double>(stretches.size());
  if (stretches.size() < kFewestStretches || !(result.value > 0)) return result;
  std::vector<double> without;
  double mean = 0;
  for (const Moments& stretch : stretches) {
    Moments rest = all;
    rest.add(stretch, -1);
    const auto value = statistic(rest, step_um, which);
    if (!value || !(*value > 0)) return result;
    without.push_back(std::log(*value));
    mean += without.back() / count;
  }
  double squares = 0;
  for (const double x : without) squares += square(x - mean);
  const double error = std::sqrt(squares * (count - 1) / count);
  const double t = boost::math::quantile(boost::math::students_t(count - 1), 0.975);
  result.interval95 = {result.value * std::exp(-t * error), result.value * std::exp(t * error)};
  return result;
}

/// Lags needed to see the fall to 1/e; InputError when a quarter of the longest profile does not.
std::size_t lags_to_fall(const std::vector<HeightProfile>& profiles) {
  std::size_t longest = 0;
  for (const HeightProfile& p : profiles) longest = std::max(longest, p.z_um.size());
  double first = 0;
  for (std::size_t lag = 0; lag <= longest / 4; ++lag) {
    double sum = 0, count = 0;
    for (const HeightProfile& p : profiles)
      for (std::size_t i = 0; i + lag < p.z_um.size(); ++i) sum += p.z_um[i] * p.z_um[i + lag], count += 1;
    if (lag == 0) first = sum / count;
    if (!(first > 0)) throw input_error(
          "profile: all heights are equal once the trend is off; expected a rough profile");
    if (sum / count <= first * kOneOverE) return lag;
  }
  throw input_error(
      "profile: its autocorrelation does not fall to 1/e within a quarter of its length; expected a longer profile, or "
      "another --detrend");
}

/// Skewness and kurtosis against a Gaussian process: their variances are 6·Σρ³/N and 24·Σρ⁴/N (Lomnicki 1961).
void test_gaussian(const std::vector<HeightProfile>& profiles, Roughness& r) {
  double n = 0, m3 = 0, m4 = 0;
  for (const HeightProfile& p : profiles)
    for (const double z : p.z_um) {
      const double u = z / r.sigma_um.value;
      n += 1, m3 += u * u * u, m4 += square(u * u);
    }
  r.skewness = m3 / n, r.excess_kurtosis = m4 / n - 3;
  double cubes = 1, fourths = 1;
  for (std::size_t j = 1; j < r.autocorrelation.size() && r.autocorrelation[j] > 0; ++j)
    cubes += 2 * std::pow(r.autocorrelation[j], 3), fourths += 2 * std::pow(r.autocorrelation[j], 4);
  const double z2 = square(r.skewness) * n / (6 * cubes) + square(r.excess_kurtosis) * n / (24 * fourths);
  r.gaussian_p = std::exp(-z2 / 2);  // χ² with two degrees of freedom
}

void compare_autocorrelation(double step_um, Roughness& r) {
  double sum = 0, count = 0;
  for (std::size_t j = 0; j < r.autocorrelation.size(); ++j) {
    const double t = static_cast<double>(j) * step_um / r.correlation_um.value;
    if (t <= 2) sum += square(r.autocorrelation[j] - std::exp(-t * t)), count += 1;
  }
  r.autocorrelation_misfit = std::sqrt(sum / count);
}

void warn(double step_um, Roughness& r) {
  if (r.stretches < kFewestStretches)
    r.warnings.push_back(
        fmt::format("only {} stretches of 5 T: no intervals; expected {}", r.stretches, kFewestStretches));
  if (step_um > r.correlation_um.value / 3)
    r.warnings.push_back("the step exceeds T/3: m and curvature are those of the step");
  if (r.step_dependence < 0.8)
    r.warnings.push_back(
        "the slope depends on the step (no differentiable surface, or noise): m and curvature have no limit");
}

}  // namespace

HeightProfile detrended(const HeightProfile& profile, Detrend detrend) {
  const auto n = static_cast<Eigen::Index>(profile.z_um.size());
  const Eigen::Index terms = static_cast<Eigen::Index>(detrend) + 1;
  Eigen::MatrixXd basis(n, terms);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double x = n > 1 ? 2.0 * static_cast<double>(i) / static_cast<double>(n - 1) - 1 : 0;
    for (Eigen::Index t = 0; t < terms; ++t) basis(i, t) = std::pow(x, static_cast<int>(t));
  }
  const Eigen::Map<const Eigen::VectorXd> z(profile.z_um.data(), n);
  const Eigen::VectorXd rest = z - basis * basis.householderQr().solve(z);
  HeightProfile result{profile.name, profile.step_um, {rest.begin(), rest.end()}};
  const double rounding = 1e-13 * z.cwiseAbs().maxCoeff();
  for (double& height : result.z_um)
    if (std::abs(height) <= rounding) height = 0;  // a straight line is flat
  return result;
}

Roughness roughness_of(const std::vector<HeightProfile>& profiles) {
  const double step_um = profiles.front().step_um;
  const std::size_t fall = lags_to_fall(profiles), lags = 3 * fall + 3;
  Moments all(lags);
  std::vector<Moments> stretches;
  std::size_t points = 0;
  for (const HeightProfile& p : profiles) points += p.z_um.size();
  const std::size_t shortest =
      std::max(static_cast<std::size_t>(kStretchOverT * static_cast<double>(fall)), points / kMostStretches);
  for (const HeightProfile& p : profiles) {
    const std::size_t parts = std::max<std::size_t>(1, p.z_um.size() / std::max<std::size_t>(shortest, 1));
    for (std::size_t k = 0; k < parts; ++k) {
      stretches.push_back(moments_of(p, p.z_um.size() * k / parts, p.z_um.size() * (k + 1) / parts, lags));
      all.add(stretches.back(), 1);
    }
  }
  if (all.count[lags - 1] < 1)
    throw input_error("profile: too short for its correlation length; expected a longer one");
  Roughness r;
  r.stretches = stretches.size();
  r.sigma_um = estimate(all, stretches, step_um, Statistic::sigma);
  r.correlation_um = estimate(all, stretches, step_um, Statistic::correlation);
  r.slope_rms = estimate(all, stretches, step_um, Statistic::slope);
  r.curvature_per_um = estimate(all, stretches, step_um, Statistic::curvature);
  r.radius_um.value = 1 / r.curvature_per_um.value;
  if (const auto& c = r.curvature_per_um.interval95) r.radius_um.interval95 = {1 / c->second, 1 / c->first};
  r.slope_at_step = std::sqrt(all.difference(0));
  r.step_dependence = all.difference(1) / all.difference(0);
  r.gaussian_slope = std::sqrt(2.0) * r.sigma_um.value / r.correlation_um.value;
  r.gaussian_curvature_per_um = 2 * std::sqrt(3.0) * r.sigma_um.value / square(r.correlation_um.value);
  for (std::size_t j = 0; j < lags; ++j) r.autocorrelation.push_back(all.mean(j) / all.mean(0));
  test_gaussian(profiles, r);
  compare_autocorrelation(step_um, r);
  warn(step_um, r);
  return r;
}

double rayleigh_height_um(double wavelength_um, double angle_deg) {
  return wavelength_um / (8 * std::cos(angle_deg * kPi<double> / 180));
}

double rayleigh_angle_deg(double wavelength_um, double sigma_um) {
  const double cosine = wavelength_um / (8 * sigma_um);
  return cosine >= 1 ? 0 : std::acos(cosine) * 180 / kPi<double>;
}

}  // namespace gonio
