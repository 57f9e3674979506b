#include "spectrum/astm_e2022.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace gonio {
namespace {

struct Share {
  std::size_t node;
  double weight;
};

/// Lagrange's weights of the nodes first … first + count - 1 for a place `at`, both counted in steps from node 0.
std::vector<Share> lagrange(std::size_t first, std::size_t count, double at) {
  std::vector<Share> shares;
  for (std::size_t i = first; i < first + count; ++i) {
    double weight = 1;
    for (std::size_t j = first; j < first + count; ++j)
      if (j != i) weight *= (at - double(j)) / (double(i) - double(j));
    shares.push_back({i, weight});
  }
  return shares;
}

/// Who answers for a place counted in steps from node 0.
std::vector<Share> shares_at(double at, std::size_t nodes) {
  if (at <= 0) return {{0, 1}};
  if (at >= double(nodes - 1)) return {{nodes - 1, 1}};
  const auto interval = static_cast<std::size_t>(at);
  if (at == double(interval)) return {{interval, 1}};
  if (interval == 0) return lagrange(0, 3, at);
  if (interval == nodes - 2) return lagrange(nodes - 3, 3, at);
  return lagrange(interval - 1, 4, at);
}

void check(double first_nm, double last_nm, double step_nm) {
  const double steps = (last_nm - first_nm) / step_nm;
  for (const double value : {first_nm, last_nm, step_nm})
    if (!(value > 0 && value == std::floor(value)))
      throw input_error("ASTM E2022 weights from {} to {} by {} nm; expected whole nanometres", first_nm, last_nm,
                        step_nm);
  if (!(steps >= 2 && steps == std::floor(steps)))
    throw input_error("ASTM E2022 weights from {} to {} by {} nm; expected at least two whole steps", first_nm, last_nm,
                      step_nm);
}

}  // namespace

ColorWeights astm_e2022_weights(const Spectrum& light, const Observer& observer, double first_nm, double last_nm,
                                double step_nm) {
  check(first_nm, last_nm, step_nm);
  const auto nodes = static_cast<std::size_t>((last_nm - first_nm) / step_nm) + 1;
  ColorWeights weights{{}, std::vector<double>(nodes), std::vector<double>(nodes), std::vector<double>(nodes)};
  for (std::size_t i = 0; i < nodes; ++i) weights.wavelength_nm.push_back(first_nm + double(i) * step_nm);
  double luminance = 0;
  const double lo = std::ceil(std::max(light.lo_nm(), observer.lo_nm())),
               hi = std::min(light.hi_nm(), observer.hi_nm());
  for (double nm = lo; nm <= hi; ++nm) {
    const double power = light.at(nm);
    const Xyz<double> eye = observer.at(nm);
    luminance += power * eye.y;
    for (const auto& [node, share] : shares_at((nm - first_nm) / step_nm, nodes)) {
      weights.x[node] += share * power * eye.x;
      weights.y[node] += share * power * eye.y;
      weights.z[node] += share * power * eye.z;
    }
  }
  if (!(luminance > 0)) throw input_error("light and observer share no visible power; expected some");
  for (std::vector<double>* component : {&weights.x, &weights.y, &weights.z})
    for (double& weight : *component) weight *= 100 / luminance;
  return weights;
}

ColorSum color_by_weights(const Factor& data, const ColorWeights& weights) {
  const double lo = weights.wavelength_nm.front(), hi = weights.wavelength_nm.back();
  if (lo < data.lo_nm || hi > data.hi_nm)
    throw input_error("{}: known from {} to {} nm; the weights expected {} to {} nm", data.name, data.lo_nm, data.hi_nm,
                      lo, hi);
  std::vector<double> values;
  for (const double nm : weights.wavelength_nm) values.push_back(data.at(nm));
  const std::vector<double> ones(values.size(), 1.0);
  return {weights.xyz(values.data()), weights.xyz(ones.data()), lo, hi, 0};
}

}  // namespace gonio
