#include "surface/instrument.h"

#include <algorithm>
#include <cmath>

#include "base/number.h"

namespace gonio {
namespace {

/// The tip reaches only where its own sag stays within the range of heights.
HeightProfile under_tip(const HeightProfile& p, double radius_um, double sign) {
  const auto [lo, hi] = std::minmax_element(p.z_um.begin(), p.z_um.end());
  const double range = *hi - *lo;
  const double reach = range >= radius_um ? radius_um : std::sqrt(range * (2 * radius_um - range));
  const auto n = static_cast<std::ptrdiff_t>(p.z_um.size());
  const auto width = static_cast<std::ptrdiff_t>(std::min(reach / p.step_um, static_cast<double>(n)));
  std::vector<double> sag;
  for (std::ptrdiff_t j = 0; j <= width; ++j) {
    const double u = std::min(static_cast<double>(j) * p.step_um, radius_um);
    sag.push_back(u * u / (radius_um + std::sqrt((radius_um - u) * (radius_um + u))));
  }
  HeightProfile result = p;
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    double top = sign * p.z_um[static_cast<std::size_t>(i)];
    for (std::ptrdiff_t j = std::max<std::ptrdiff_t>(0, i - width); j <= std::min(n - 1, i + width); ++j)
      top = std::max(top, sign * p.z_um[static_cast<std::size_t>(j)] - sag[static_cast<std::size_t>(std::abs(i - j))]);
    result.z_um[static_cast<std::size_t>(i)] = sign * top;
  }
  return result;
}

}  // namespace

HeightProfile stylus_trace(const HeightProfile& profile, double radius_um) { return under_tip(profile, radius_um, 1); }

HeightProfile stylus_reconstruction(const HeightProfile& trace, double radius_um) {
  return under_tip(trace, radius_um, -1);
}

HeightProfile averaged(const HeightProfile& p, double width_um) {
  constexpr double kCut = 6;  // exp(-36): below rounding
  const auto n = static_cast<std::ptrdiff_t>(p.z_um.size());
  const auto reach = static_cast<std::ptrdiff_t>(std::min(kCut * width_um / p.step_um, static_cast<double>(n)));
  std::vector<double> weight;
  for (std::ptrdiff_t j = 0; j <= reach; ++j)
    weight.push_back(std::exp(-square(static_cast<double>(j) * p.step_um / width_um)));
  HeightProfile result = p;
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    double sum = 0, weights = 0;
    for (std::ptrdiff_t j = std::max<std::ptrdiff_t>(0, i - reach); j <= std::min(n - 1, i + reach); ++j) {
      const double w = weight[static_cast<std::size_t>(std::abs(i - j))];
      sum += w * p.z_um[static_cast<std::size_t>(j)], weights += w;
    }
    result.z_um[static_cast<std::size_t>(i)] = sum / weights;
  }
  return result;
}

GaussianSurface averaged(const GaussianSurface& s, double width_um, int dimensions) {
  const double wide = std::sqrt(square(s.correlation_um) + 2 * square(width_um));
  return {s.sigma_um * std::pow(s.correlation_um / wide, 0.5 * dimensions), wide};
}

std::optional<GaussianSurface> before_averaging(const GaussianSurface& seen, double width_um, int dimensions) {
  const double left = square(seen.correlation_um) - 2 * square(width_um);
  if (!(left > 0)) return std::nullopt;
  const double narrow = std::sqrt(left);
  return GaussianSurface{seen.sigma_um * std::pow(seen.correlation_um / narrow, 0.5 * dimensions), narrow};
}

}  // namespace gonio
