#include "brdf/sampling.h"

#include <algorithm>
#include <cmath>

namespace gonio {
namespace {

/// Slopes of half vectors are half the angles of a lobe about the mirror direction.
SlopeExtent extent(const AxisSampler<double>& one) {
  const double width = 0.5 * std::sqrt(2 / (one.n + 2));
  return {width, width, false};
}
SlopeExtent extent(const CosineSampler<double>&) { return {1, 1, false}; }
SlopeExtent extent(const FacetSampler<double>& one) {
  return {one.widest(), one.narrowest(), one.law.kind == SlopeKind::gaussian};
}
SlopeExtent extent(const DiscSampler<double>& one) {
  const double width = 1 / std::sqrt(1 + 4 * one.b);
  return {width, width, false};
}
SlopeExtent extent(const AshikhminShirleySampler<double>& one) {
  const double x = one.width(one.n_u), y = one.width(one.n_v);
  return {std::max(x, y), std::min(x, y), false};
}
SlopeExtent extent(const KirchhoffSampler<double>& one) { return {one.width(), one.width(), false}; }

}  // namespace

SlopeExtent slope_extent(const Lobe<double>& lobe, double wavelength_um) {
  return std::visit([](const auto& one) { return extent(one); }, lobe_sampler(lobe, wavelength_um));
}

}  // namespace gonio
