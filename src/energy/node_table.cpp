#include "energy/node_table.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "brdf/lanes.h"

namespace gonio {
namespace {

constexpr double kGrazing = 1e-6;  // cos θ of the last column; E is bounded and level from there on
constexpr double kBend =
    0.1;  // columns lie evenly in asinh(rise/(kBend·m/(1 + m))): close where slopes and rise compare
constexpr std::size_t kTaps = 4;

template <class T>
T bend_of(const T& width) {
  return T(kBend) * width / (T(1.0) + width);
}
/// Where cos θ lies among the columns, 0 at grazing to 1 at the normal, by 1 - √(1 - cos θ): like the elevation linear in θ at the normal.
template <class T>
T column_share(const T& cos_i, const T& width) {
  using std::asinh;
  using std::sqrt;
  const T bend = bend_of(width);
  return T(asinh(T(cos_i / (T(1.0) + sqrt(T(T(1.0) - cos_i))) / bend))) / T(asinh(T(T(1.0) / bend)));
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
Taps taps_at(float x, std::size_t count) {
  // A place that is no number takes the first taps: its value is none either.
  const float below = x > 1 ? std::min(std::floor(x) - 1, static_cast<float>(count - kTaps)) : 0.0F;
  const auto first = static_cast<std::size_t>(below);
  const float t = x - static_cast<float>(first), a = t - 1, b = t - 2, c = t - 3;
  return {first, {-a * b * c / 6, t * b * c / 2, -t * a * c / 2, t * a * b / 6}};
}

}  // namespace

Lobe<double> lobe_of_width(const ModelSpec& spec, double width) {
  std::vector<double> values;
  for (const ParameterInfo& p : spec.info().parameters) values.push_back(p.fallback.value_or(width));
  return make_lobe<double>(spec, values);
}

NodeTable::NodeTable(const ModelSpec& spec) : NodeTable(spec, Grid()) {}

NodeTable::NodeTable(const ModelSpec& spec, const Grid& grid)
    : NodeTable(spec, grid, std::vector<Numbers>(grid.rows * grid.columns)) {
  lobe_measure(lobe_of_width(spec, widest_), 45);  // refuses a lobe that has no nodes
  tbb::parallel_for(std::size_t{0}, cells_.size(), [&](std::size_t at) {
    const CosNodes nodes = gauss_nodes(lobe_measure(lobe_of_width(spec, width(at)), theta_deg(at)));
    for (std::size_t i = 0; i < CosNodes::kCount; ++i) {
      cells_[at].number[i] = static_cast<float>(nodes.cos_d[i]);
      cells_[at].number[CosNodes::kCount + i] = static_cast<float>(nodes.weight[i]);
    }
  });
}

NodeTable::NodeTable(const ModelSpec& spec, const Grid& grid, std::vector<Numbers> cells)
    : spec_(spec),
      grid_(grid),
      widest_(std::min(kWidest, spec.info().parameters.front().hi)),
      cells_(std::move(cells)) {
  if (grid.rows < kTaps || grid.columns < kTaps)
    throw input_error("grid {} x {}: too small; expected {} or more each way", grid.rows, grid.columns, kTaps);
  if (spec.info().parameters.front().name != "m")
    throw input_error("{}: has no table of nodes; expected a lobe of Gaussian slopes (m)", spec.info().name);
}

double NodeTable::width(std::size_t cell) const {
  const double row = static_cast<double>(cell / grid_.columns) / static_cast<double>(grid_.rows - 1);
  return kNarrowest * std::pow(widest_ / kNarrowest, row);
}

double NodeTable::theta_deg(std::size_t cell) const {
  const double share = static_cast<double>(cell % grid_.columns) / static_cast<double>(grid_.columns - 1);
  return std::acos(cosine_at(share, width(cell))) * 180 / kPi<double>;
}

template <class T>
std::pair<T, T> NodeTable::coordinates(const T& cos_i, const T& width) const {
  using std::log;
  // The bound first: what is no number passes both, and is none in the end.
  const T w = smaller_of(T(widest_), larger_of(T(kNarrowest), width));
  const T cosine = smaller_of(T(1.0), larger_of(T(0.0), cos_i));
  const double per_log = static_cast<double>(grid_.rows - 1) / std::log(widest_ / kNarrowest);
  return {T(log(T(w * T(1 / kNarrowest)))) * T(per_log),
          column_share(cosine, w) * T(static_cast<double>(grid_.columns - 1))};
}

NodeTable::Numbers NodeTable::interpolated(float row, float column) const {
  const Taps rows = taps_at(row, grid_.rows), columns = taps_at(column, grid_.columns);
  constexpr std::size_t kBatches = kNumbers / FloatLanes::size;
  std::array<FloatLanes, kBatches> sum;
  sum.fill(FloatLanes(0.0F));
  for (std::size_t r = 0; r < kTaps; ++r) {
    const Numbers* cells = &cells_[(rows.first + r) * grid_.columns + columns.first];
    for (std::size_t c = 0; c < kTaps; ++c) {
      const FloatLanes weight(rows.weight[r] * columns.weight[c]);
      for (std::size_t b = 0; b < kBatches; ++b)
        sum[b] = multiply_add(weight, FloatLanes::load_aligned(&cells[c].number[b * FloatLanes::size]), sum[b]);
    }
  }
  Numbers numbers;
  for (std::size_t b = 0; b < kBatches; ++b) sum[b].store_aligned(&numbers.number[b * FloatLanes::size]);
  return numbers;
}

CosNodes NodeTable::nodes(double cos_i, double width) const {
  const auto [row, column] = coordinates(cos_i, width);
  const Numbers numbers = interpolated(static_cast<float>(row), static_cast<float>(column));
  CosNodes nodes;
  for (std::size_t i = 0; i < CosNodes::kCount; ++i)
    nodes.cos_d[i] = std::clamp(double(numbers.number[i]), 0.0, 1.0),
    nodes.weight[i] = numbers.number[CosNodes::kCount + i];
  return nodes;
}

void NodeTable::reflectances(std::span<const double> cos_i, std::span<const double> width,
                             const Interface<double>& surface, std::span<double> e) const {
  constexpr std::size_t kLanes = FloatLanes::size, kPairs = kLanes / CosNodes::kCount;  // pairs of one batch of nodes
  static_assert(kPairs >= 1 && kNumbers % kLanes == 0);
  const Interface<FloatLanes> lanes = spread<FloatLanes>(surface);
  alignas(64) std::array<float, kLanes> c{}, w{}, row, column, cos_d{}, weight{}, parts;
  for (std::size_t from = 0; from < e.size(); from += kLanes) {
    const std::size_t count = std::min(kLanes, e.size() - from);
    for (std::size_t p = 0; p < count; ++p)
      c[p] = static_cast<float>(cos_i[from + p]), w[p] = static_cast<float>(width[from + p]);
    const auto [rows, columns] = coordinates(FloatLanes::load_aligned(c.data()), FloatLanes::load_aligned(w.data()));
    rows.store_aligned(row.data()), columns.store_aligned(column.data());
    for (std::size_t first = 0; first < count; first += kPairs) {
      const std::size_t pairs = std::min(kPairs, count - first);
      for (std::size_t p = 0; p < pairs; ++p) {
        const Numbers numbers = interpolated(row[first + p], column[first + p]);
        std::copy_n(&numbers.number[0], CosNodes::kCount, &cos_d[p * CosNodes::kCount]);
        std::copy_n(&numbers.number[CosNodes::kCount], CosNodes::kCount, &weight[p * CosNodes::kCount]);
      }
      const FloatLanes u =
          smaller_of(larger_of(FloatLanes::load_aligned(cos_d.data()), FloatLanes(0.0F)), FloatLanes(1.0F));
      (FloatLanes::load_aligned(weight.data()) * lanes.reflectance(u)).store_aligned(parts.data());
      for (std::size_t p = 0; p < pairs; ++p)
        e[from + first + p] =
            std::accumulate(&parts[p * CosNodes::kCount], &parts[p * CosNodes::kCount] + CosNodes::kCount, 0.0F);
    }
  }
}

}  // namespace gonio
