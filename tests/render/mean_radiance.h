#pragma once
#include <cmath>
#include <numeric>
#include <vector>

#include "render/render.h"

namespace gonio::test {

/// Mean over an image, and its standard error.
struct Mean {
  double value, error;
};
inline Mean mean_of(const RenderResult& result) {
  const auto sum = [](const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); };
  const auto count = static_cast<double>(result.image.radiance.size());
  return {sum(result.image.radiance) / count, std::sqrt(sum(result.variance)) / count};
}

}  // namespace gonio::test
