#pragma once
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "brdf/models.h"
#include "energy/lobe_measure.h"

namespace gonio {

/// E of a faceted lobe of Gaussian slopes for any material: the eight nodes of lobe_measure.h on a grid over the angle and m. Between grid
/// points the nodes themselves are interpolated. Largest error of the default grid over m 0.01-2, θ 0-90° and n, k from dielectrics to metals:
/// below 1e-4 (tests/energy/node_table_test.cpp; 196 KiB a lobe).
class NodeTable {
 public:
  /// Rows over the width, columns over the angle.
  struct Grid {
    std::size_t rows = 56, columns = 56;
  };

  /// Box of m that a table covers, within the model's own.
  static constexpr double kNarrowest = 0.01, kWidest = 2;

  /// Makes the table: in parallel, the same bytes for any number of threads. InputError for other lobes.
  explicit NodeTable(const ModelSpec& spec);
  NodeTable(const ModelSpec& spec, const Grid& grid);

  /// Cubic in both directions. cos_i 0 to 1, m in the box.
  CosNodes nodes(double cos_i, double width) const;
  /// E, ks = 1.
  double reflectance(double cos_i, double width, const Interface<double>& surface) const {
    return nodes(cos_i, width).reflectance(surface);
  }
  /// The same of many pairs, in lanes.
  void reflectances(std::span<const double> cos_i, std::span<const double> width, const Interface<double>& surface,
                    std::span<double> e) const;

  const ModelSpec& spec() const { return spec_; }
  const Grid& grid() const { return grid_; }
  double widest() const { return widest_; }

  static constexpr std::size_t kNumbers = 2 * CosNodes::kCount;
  /// cos_d of each node, then the weights.
  struct alignas(64) Numbers {
    std::array<float, kNumbers> number;
  };
  /// The places of the grid, row by row.
  std::size_t cells() const { return cells_.size(); }
  const std::array<float, kNumbers>& numbers(std::size_t cell) const { return cells_[cell].number; }
  double width(std::size_t cell) const;
  double theta_deg(std::size_t cell) const;
  std::size_t bytes() const { return cells_.size() * sizeof(Numbers); }

  /// Of a file's numbers (energy/node_file.h).
  NodeTable(const ModelSpec& spec, const Grid& grid, std::vector<Numbers> cells);

 private:
  /// Where a pair lies in rows and columns.
  template <class T>
  std::pair<T, T> coordinates(const T& cos_i, const T& width) const;
  Numbers interpolated(float row, float column) const;

  ModelSpec spec_;
  Grid grid_;
  double widest_;
  std::vector<Numbers> cells_;
};

/// The lobe of a model whose widths are all the same; the other parameters at their defaults, kd = 0, ks = 1.
Lobe<double> lobe_of_width(const ModelSpec& spec, double width);

}  // namespace gonio
