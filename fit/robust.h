#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

namespace gonio {

/// Makes the median absolute deviation of normal errors their standard deviation: 1/Φ⁻¹(3/4).
inline constexpr double kMadToSigma = 1.4826022185056018;

/// Of two middle values the larger; 0 of none.
inline double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Median of the sizes of the differences from `centre`, as a standard deviation.
inline double robust_spread(std::vector<double> values, double centre) {
  for (double& value : values) value = std::abs(value - centre);
  return kMadToSigma * median(std::move(values));
}

}  // namespace gonio
