#include "energy/node_table.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "brdf/lanes.h"

namespace gonio {
namespace {

constexpr double kGrazing = 1e-6;  // cos θ of the last column; E is bounded and level from there on
constexpr double kBend =
    0.1;  // columns lie evenly in asinh(rise/(kBend·m/(1 + m))): close where slopes and rise compare
constexpr std::size_t kTaps = 4;

/// cos θ as columns count it, 0 at grazing to 1 at the normal.
double bend_of(double width) { return kBend * width / (1 + width); }
/// 1 - √(1 - cos θ): like the elevation, linear in θ at the normal.
double column_share(double cos_i, double width) {
  const double bend = bend_of(width);
  return std::asinh(cos_i / (1 + std::sqrt(1 - cos_i)) / bend) / std::asinh(1 / bend);
}
double cosine_at(double share, double width) {
  const double bend = bend_of(width), rise = bend * std::sinh(share * std::asinh(1 / bend));
  return std::clamp(rise * (2 - rise), kGrazing, 1.0);
}

/// Four neighbours of a place between grid points, and their weights in Lagrange's cubic.
struct Taps {
  std::size_t first;
  std::array<float, kTaps> weight;
};
Taps taps_at(double x, std::size_t count) {
  const auto first = static_cast<std::size_t>(std::clamp(std::floor(x) - 1, 0.0, static_cast<double>(count - kTaps)));
  const double t = x - static_cast<double>(first);
  return {first,
          {float(-(t - 1) * (t - 2) * (t - 3) / 6), float(t * (t - 2) * (t - 3) / 2), float(-t * (t - 1) * (t - 3) / 2),
           float(t * (t - 1) * (t - 2) / 6)}};
}

}  // namespace

struct NodeTable::Place {
  Taps row, column;
};

Lobe<double> lobe_of_width(const ModelSpec& spec, double width) {
  std::vector<double> values;
  for (const ParameterInfo& p : spec.info().parameters) values.push_back(p.fallback.value_or(width));
  return make_lobe<double>(spec, values);
}

NodeTable::NodeTable(const ModelSpec& spec) : NodeTable(spec, Grid()) {}

NodeTable::NodeTable(const ModelSpec& spec, const Grid& grid)
    : spec_(spec),
      grid_(grid),
      widest_(std::min(kWidest, spec.info().parameters.front().hi)),
      cells_(grid.rows * grid.columns) {
  if (grid.rows < kTaps || grid.columns < kTaps)
    throw input_error("grid {} x {}: too small; expected {} or more each way", grid.rows, grid.columns, kTaps);
  if (spec.info().parameters.front().name != "m")
    throw input_error("{}: has no table of nodes; expected a lobe of Gaussian slopes (m)", spec.info().name);
  lobe_measure(lobe_of_width(spec, widest_), 45);  // refuses a lobe that has no nodes
  tbb::parallel_for(std::size_t{0}, cells_.size(), [&](std::size_t at) {
    const double row = static_cast<double>(at / grid.columns) / static_cast<double>(grid.rows - 1);
    const double width = kNarrowest * std::pow(widest_ / kNarrowest, row);
    const double share = static_cast<double>(at % grid.columns) / static_cast<double>(grid.columns - 1);
    const double theta_deg = std::acos(cosine_at(share, width)) * 180 / kPi<double>;
    const CosNodes nodes = gauss_nodes(lobe_measure(lobe_of_width(spec, width), theta_deg));
    for (std::size_t i = 0; i < CosNodes::kCount; ++i) {
      cells_[at][i] = static_cast<float>(nodes.cos_d[i]);
      cells_[at][CosNodes::kCount + i] = static_cast<float>(nodes.weight[i]);
    }
  });
}

NodeTable::Place NodeTable::place(double cos_i, double width) const {
  const double w = std::clamp(width, kNarrowest, widest_);
  const double row = std::log(w / kNarrowest) / std::log(widest_ / kNarrowest) * static_cast<double>(grid_.rows - 1);
  const double column = column_share(std::clamp(cos_i, 0.0, 1.0), w) * static_cast<double>(grid_.columns - 1);
  return {taps_at(row, grid_.rows), taps_at(column, grid_.columns)};
}

std::array<float, NodeTable::kNumbers> NodeTable::interpolated(const Place& at) const {
  std::array<float, kNumbers> sum{};
  for (std::size_t r = 0; r < kTaps; ++r)
    for (std::size_t c = 0; c < kTaps; ++c) {
      const Cell& cell = cells_[(at.row.first + r) * grid_.columns + at.column.first + c];
      const float weight = at.row.weight[r] * at.column.weight[c];
      for (std::size_t i = 0; i < kNumbers; ++i) sum[i] += weight * cell[i];
    }
  return sum;
}

CosNodes NodeTable::nodes(double cos_i, double width) const {
  const auto numbers = interpolated(place(cos_i, width));
  CosNodes nodes;
  for (std::size_t i = 0; i < CosNodes::kCount; ++i)
    nodes.cos_d[i] = std::clamp(double(numbers[i]), 0.0, 1.0), nodes.weight[i] = numbers[CosNodes::kCount + i];
  return nodes;
}

void NodeTable::reflectances(std::span<const double> cos_i, std::span<const double> width,
                             const Interface<double>& surface, std::span<double> e) const {
  constexpr std::size_t kPairs = FloatLanes::size / CosNodes::kCount;  // in one batch of lanes
  static_assert(kPairs >= 1);
  const Interface<FloatLanes> lanes = spread<FloatLanes>(surface);
  alignas(64) std::array<float, FloatLanes::size> cos_d{}, weight{};
  for (std::size_t from = 0; from < e.size(); from += kPairs) {
    const std::size_t count = std::min(kPairs, e.size() - from);
    for (std::size_t p = 0; p < count; ++p) {
      const auto numbers = interpolated(place(cos_i[from + p], width[from + p]));
      std::copy_n(numbers.begin(), CosNodes::kCount, cos_d.begin() + std::ptrdiff_t(p * CosNodes::kCount));
      std::copy_n(numbers.begin() + CosNodes::kCount, CosNodes::kCount,
                  weight.begin() + std::ptrdiff_t(p * CosNodes::kCount));
    }
    const FloatLanes u =
        smaller_of(larger_of(FloatLanes::load_aligned(cos_d.data()), FloatLanes(0.0F)), FloatLanes(1.0F));
    const FloatLanes share = FloatLanes::load_aligned(weight.data()) * lanes.reflectance(u);
    alignas(64) std::array<float, FloatLanes::size> parts;
    share.store_aligned(parts.data());
    for (std::size_t p = 0; p < count; ++p) {
      float sum = 0;
      for (std::size_t i = 0; i < CosNodes::kCount; ++i) sum += parts[p * CosNodes::kCount + i];
      e[from + p] = sum;
    }
  }
}

}  // namespace gonio
