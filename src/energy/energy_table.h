#pragma once
#include <functional>
#include <span>
#include <vector>

#include "energy/cos_nodes.h"
#include "energy/energy_grid.h"
#include "energy/reflectance_curve.h"

namespace gonio {

/// E of a family of lobes for any material: the weights of fixed cosines (cos_nodes.h) on a grid over the incidence and the width.
///
///     E(θ; alpha, surface) = Σ_i W_i(θ, alpha)·R(u_i)
///
/// Largest error of the default grid, over its widths, 0-90° and every solid and liquid of the database whose node_error() is below 2e-5:
/// kError, shown by tests/energy/energy_table_test.cpp on a grid four times denser and at random places.
class EnergyTable {
 public:
  static constexpr double kError = 1e-4;

  struct Cell {
    std::array<float, kCosNodes> weight;
    float error;  ///< estimated, of the quadrature of E on white facets
  };

  /// Makes the table, in parallel, the same numbers for any number of threads. `done` hears the share made, from any thread.
  explicit EnergyTable(const LobeFamily& family, const std::function<void(double done)>& done = {});
  EnergyTable(const LobeFamily& family, const EnergyGrid& grid, const std::function<void(double done)>& done = {});
  /// Of a file's numbers (energy/energy_file.h), row by row.
  EnergyTable(const LobeFamily& family, const EnergyGrid& grid, std::vector<Cell> cells);

  /// W between the grid's points. cos_theta 0 to 1.
  NodeValues weights(double cos_theta, double alpha) const;
  /// E of one width and surface over the incidence; `r` = reflectance_at_nodes().
  ReflectanceCurve curve(double alpha, const NodeValues& r) const;

  /// E of one surface at every place of the grid, row by row.
  std::vector<float> values(const NodeValues& r) const;

  const LobeFamily& family() const { return *family_; }
  const EnergyGrid& grid() const { return grid_; }
  std::span<const Cell> cells() const { return cells_; }
  const Cell& cell(std::size_t row, std::size_t column) const { return cells_[row * grid_.columns + column]; }
  std::size_t bytes() const { return cells_.size() * sizeof(Cell); }

  /// A cell as it is made.
  static Cell made(const LobeFamily& family, double cos_theta, double alpha);

 private:
  const LobeFamily* family_;
  EnergyGrid grid_;
  std::vector<Cell> cells_;
};

/// The same for one surface: E itself on the grid.
class SurfaceEnergyTable {
 public:
  SurfaceEnergyTable(const EnergyTable& table, const NodeValues& r);

  double reflectance(double cos_theta, double alpha) const;
  /// Of many pairs, in lanes.
  void reflectances(std::span<const float> cos_theta, std::span<const float> alpha, std::span<float> e) const;

 private:
  EnergyGrid grid_;
  std::vector<float> e_;
};

}  // namespace gonio
