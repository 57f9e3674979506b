#include "energy/energy_table.h"

#include <oneapi/tbb/parallel_for.h>

#include <atomic>

#include "base/error.h"
#include "brdf/lanes.h"

namespace gonio {
namespace {

constexpr std::size_t kTaps = CubicTaps<double>::kCount;
constexpr double kTolerance = 1e-6;  // of a cell's quadrature

/// Σ over the taps' places of weight·value(row, column).
template <class T, class Value>
auto interpolated(const CubicTaps<T>& rows, const CubicTaps<T>& columns, Value value) {
  T sum(0);
  for (std::size_t r = 0; r < kTaps; ++r)
    for (std::size_t c = 0; c < kTaps; ++c)
      sum += rows.weight[r] * columns.weight[c] * value(rows.first + r, columns.first + c);
  return sum;
}

}  // namespace

EnergyTable::Cell EnergyTable::made(const LobeFamily& family, double cos_theta, double alpha) {
  const LobeMeasure measure = lobe_measure(family.lobe(alpha), std::acos(cos_theta) * 180 / kPi<double>, kTolerance);
  const NodeValues weights = node_weights(measure);
  Cell cell{{}, static_cast<float>(measure.error)};
  for (std::size_t i = 0; i < kCosNodes; ++i) cell.weight[i] = static_cast<float>(weights[i]);
  return cell;
}

EnergyTable::EnergyTable(const LobeFamily& family, const std::function<void(double)>& done)
    : EnergyTable(family, {.widest = family.widest}, done) {}

EnergyTable::EnergyTable(const LobeFamily& family, const EnergyGrid& grid, const std::function<void(double)>& done)
    : EnergyTable(family, grid, std::vector<Cell>(grid.rows * grid.columns)) {
  std::vector<double> cosines;
  for (std::size_t c = 0; c < grid.columns; ++c) cosines.push_back(grid.cos_theta(c));
  std::atomic<std::size_t> rows_done{0};
  tbb::parallel_for(std::size_t{0}, grid.rows, [&](std::size_t row) {
    for (std::size_t c = 0; c < grid.columns; ++c)
      cells_[row * grid.columns + c] = made(family, cosines[c], grid.alpha(row));
    if (done) done(static_cast<double>(++rows_done) / static_cast<double>(grid.rows));
  });
}

EnergyTable::EnergyTable(const LobeFamily& family, const EnergyGrid& grid, std::vector<Cell> cells)
    : family_(&family), grid_(grid), cells_(std::move(cells)) {
  if (grid.rows < kTaps || grid.columns < kTaps)
    throw input_error("grid {} x {}: too small; expected {} or more each way", grid.rows, grid.columns, kTaps);
  if (cells_.size() != grid.rows * grid.columns)
    throw input_error("{} places; expected {} x {}", cells_.size(), grid.rows, grid.columns);
}

NodeValues EnergyTable::weights(double cos_theta, double alpha) const {
  const CubicTaps<double> rows(grid_.row_of(alpha), grid_.rows), columns(grid_.column_of(cos_theta), grid_.columns);
  NodeValues all;
  for (std::size_t i = 0; i < kCosNodes; ++i)
    all[i] = interpolated(rows, columns, [&](std::size_t r, std::size_t c) { return cell(r, c).weight[i]; });
  return all;
}

ReflectanceCurve EnergyTable::curve(double alpha, const NodeValues& r) const {
  const CubicTaps<double> rows(grid_.row_of(alpha), grid_.rows);
  std::vector<double> e(grid_.columns, 0);
  for (std::size_t tap = 0; tap < kTaps; ++tap)
    for (std::size_t c = 0; c < grid_.columns; ++c) {
      const Cell& at = cell(rows.first + tap, c);
      for (std::size_t i = 0; i < kCosNodes; ++i) e[c] += rows.weight[tap] * r[i] * double(at.weight[i]);
    }
  return ReflectanceCurve(std::move(e));
}

std::vector<float> EnergyTable::values(const NodeValues& r) const {
  std::vector<float> e;
  for (const Cell& cell : cells_) {
    double sum = 0;
    for (std::size_t i = 0; i < kCosNodes; ++i) sum += r[i] * double(cell.weight[i]);
    e.push_back(static_cast<float>(sum));
  }
  return e;
}

SurfaceEnergyTable::SurfaceEnergyTable(const EnergyTable& table, const NodeValues& r)
    : grid_(table.grid()), e_(table.values(r)) {}

double SurfaceEnergyTable::reflectance(double cos_theta, double alpha) const {
  return interpolated(CubicTaps<double>(grid_.row_of(alpha), grid_.rows),
                      CubicTaps<double>(grid_.column_of(cos_theta), grid_.columns),
                      [&](std::size_t r, std::size_t c) { return double(e_[r * grid_.columns + c]); });
}

void SurfaceEnergyTable::reflectances(std::span<const float> cos_theta, std::span<const float> alpha,
                                      std::span<float> e) const {
  constexpr std::size_t kLanes = FloatLanes::size;
  alignas(64) std::array<float, kLanes> c{}, w{};
  for (std::size_t from = 0; from < e.size(); from += kLanes) {
    const std::size_t count = std::min(kLanes, e.size() - from);
    std::copy_n(&cos_theta[from], count, c.begin());
    std::copy_n(&alpha[from], count, w.begin());
    const FloatLanes columns = grid_.column_of(FloatLanes::load_aligned(c.data())),
                     rows = grid_.row_of(FloatLanes::load_aligned(w.data()));
    columns.store_aligned(c.data()), rows.store_aligned(w.data());
    for (std::size_t i = 0; i < count; ++i) {
      const CubicTaps<float> row(w[i], grid_.rows), column(c[i], grid_.columns);
      const float* at = &e_[row.first * grid_.columns + column.first];
      float sum = 0;
      for (std::size_t r = 0; r < kTaps; ++r, at += grid_.columns) {
        const float along =
            column.weight[0] * at[0] + column.weight[1] * at[1] + column.weight[2] * at[2] + column.weight[3] * at[3];
        sum += row.weight[r] * along;
      }
      e[from + i] = sum;
    }
  }
}

}  // namespace gonio
