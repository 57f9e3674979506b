#include <algorithm>
#include <cmath>

#include "assess/published_comparisons.h"

namespace gonio {
namespace {

/// Poisson probabilities of first, first + 1, …: all but 1e-14 of them.
struct PoissonWindow {
  int first;
  std::vector<double> weights;

  explicit PoissonWindow(double g) {
    first = std::max(0, static_cast<int>(g - 8 * std::sqrt(g) - 8));
    const int last = static_cast<int>(g + 9 * std::sqrt(g) + 24);
    for (int j = first; j <= last; ++j)
      weights.push_back(g > 0 ? std::exp(j * std::log(g) - g - std::lgamma(j + 1.0)) : (j == 0 ? 1.0 : 0.0));
  }
};

}  // namespace

double power_per_sr(const Lobe<double>& lobe, const Interface<double>& surface, double theta_i_deg, double theta_o_deg,
                    double wavelength_um) {
  const double degree = kPi<double> / 180, ti = theta_i_deg * degree, to = theta_o_deg * degree;
  const Directions<double> w = reduce(-std::sin(ti), 0.0, std::cos(ti), std::sin(to), 0.0, std::cos(to));
  return evaluate(Brdf<double>{lobe, 0.0, 1.0, false}, w, surface, wavelength_um) * w.cos_o;
}

Curve power_curve(std::string name, const Lobe<double>& lobe, const Interface<double>& surface, double theta_i_deg,
                  double from_deg, double to_deg, double step_deg, double wavelength_um) {
  Curve curve{std::move(name), {}};
  const int count = static_cast<int>(std::lround((to_deg - from_deg) / step_deg));
  for (int n = 0; n <= count; ++n) {
    const double theta_o = from_deg + n * step_deg;
    curve.points.emplace_back(theta_o, power_per_sr(lobe, surface, theta_i_deg, theta_o, wavelength_um));
  }
  return curve;
}

LobeShape shape_of(const Curve& curve) {
  const auto& points = curve.points;
  const auto top =
      std::max_element(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  const double half = 0.5 * top->second;
  const auto crossing = [&](const auto& above, const auto& below) {
    return below.first + (above.first - below.first) * (half - below.second) / (above.second - below.second);
  };
  double lo = points.front().first, hi = points.back().first;
  for (auto at = top; at != points.begin(); --at)
    if (std::prev(at)->second < half) {
      lo = crossing(*at, *std::prev(at));
      break;
    }
  for (auto at = top; std::next(at) != points.end(); ++at)
    if (std::next(at)->second < half) {
      hi = crossing(*at, *std::next(at));
      break;
    }
  return {top->first, top->second, hi - lo};
}

double value_at(const Curve& curve, double degrees) {
  const auto above =
      std::find_if(curve.points.begin(), curve.points.end(), [&](const auto& p) { return p.first >= degrees - 1e-9; });
  if (above == curve.points.begin() || above->first <= degrees + 1e-9) return above->second;
  const auto below = std::prev(above);
  return below->second + (above->second - below->second) * (degrees - below->first) / (above->first - below->first);
}

Curve relative_to(Curve curve, double value) {
  for (auto& point : curve.points) point.second /= value;
  return curve;
}

double share_behind(const Curve& curve) {
  double behind = 0, all = 0;
  for (std::size_t n = 1; n < curve.points.size(); ++n) {
    const auto& [a, pa] = curve.points[n - 1];
    const auto& [b, pb] = curve.points[n];
    const double part = 0.5 * (pa + pb) * (b - a);
    all += part;
    if (a >= 90 - 1e-9) behind += part;
  }
  return behind / all;
}

double two_scale_power_per_sr(double sigma1_um, double correlation1_um, double sigma2_um, double correlation2_um,
                              double theta_i_deg, double theta_o_deg, double wavelength_um) {
  const double degree = kPi<double> / 180, ci = std::cos(theta_i_deg * degree), co = std::cos(theta_o_deg * degree),
               wave = 2 * kPi<double> / wavelength_um,
               v = wave * (std::sin(theta_i_deg * degree) - std::sin(theta_o_deg * degree)), v_z = wave * (ci + co),
               f_prime = (1 + std::cos((theta_i_deg + theta_o_deg) * degree)) / (ci + co);
  const PoissonWindow first(square(v_z * sigma1_um)), second(square(v_z * sigma2_um));
  const double inverse1 = 1 / square(correlation1_um), inverse2 = 1 / square(correlation2_um);
  double sum = 0;
  for (std::size_t j = 0; j < first.weights.size(); ++j)
    for (std::size_t k = 0; k < second.weights.size(); ++k) {
      const double a =
          (first.first + static_cast<double>(j)) * inverse1 + (second.first + static_cast<double>(k)) * inverse2;
      if (a > 0) sum += first.weights[j] * second.weights[k] / a * std::exp(-square(v) / (4 * a));
    }
  return kPi<double> * square(f_prime / wavelength_um) / ci * sum;
}

double kirchhoff_validity(double sigma_um, double correlation_um, double theta_i_deg, double wavelength_um) {
  const double radius_um = square(correlation_um) / (2 * std::sqrt(3.0) * sigma_um);
  return std::min(correlation_um / wavelength_um,
                  4 * kPi<double> * radius_um * std::cos(theta_i_deg * kPi<double> / 180) / wavelength_um);
}

}  // namespace gonio
