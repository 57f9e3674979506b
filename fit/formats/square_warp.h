#pragma once
#include <array>
#include <cstddef>
#include <vector>

namespace gonio {

/// A point of the unit square: x along the fastest index of a table, y along the slower one.
struct SquarePoint {
  double x, y;
};

/// The (at most four) slices of a table between which a pair of parameters lies, and their shares (their sum is 1).
struct SliceMix {
  std::array<std::size_t, 4> slice;
  std::array<double, 4> share;
};

/// Where a value lies between increasing nodes: the node before it and the share of the next, held at the ends.
struct NodeShare {
  std::size_t before;
  double next;
};
NodeShare between(const std::vector<float>& nodes, double value);

/// Slices of a table over (first, second) nodes, the second faster.
SliceMix mix_of(const NodeShare& first, const NodeShare& second, std::size_t second_count);

/// The density over the unit square that is bilinear between the nodes of a table, one table a slice, and the map that carries
/// uniform points to it: the marginal over rows is inverted first, then the row's conditional (Dupuy & Jakob 2018, section 4.3).
/// Each slice is scaled to integrate to 1; between slices densities and their integrals are mixed linearly. Double throughout.
class SquareWarp {
 public:
  SquareWarp() = default;
  /// Values >= 0, slice by slice, `height` rows of `width` each (at least 2 by 2); a slice without any is taken as uniform.
  SquareWarp(const std::vector<float>& values, std::size_t height, std::size_t width);

  /// Uniform to warped.
  SquarePoint sample(const SliceMix& mix, SquarePoint uniform) const;
  /// Warped to uniform.
  SquarePoint invert(const SliceMix& mix, SquarePoint warped) const;
  /// With respect to the unit square.
  double density(const SliceMix& mix, SquarePoint warped) const;

 private:
  double mixed(const std::vector<double>& table, std::size_t stride, std::size_t index, const SliceMix& mix) const;
  double value(const SliceMix& mix, std::size_t row, std::size_t column) const;
  double row_integral(const SliceMix& mix, std::size_t row, std::size_t columns) const;

  std::size_t height_ = 0, width_ = 0;
  std::vector<double> values_, rows_, marginal_;  ///< density, its integral along each row, that of the rows; in cells
};

/// Bilinear between nodes of `height` rows of `width`, beginning at `first`; the point is held inside the square.
double bilinear(const std::vector<float>& values, std::size_t first, std::size_t height, std::size_t width,
                SquarePoint at);

}  // namespace gonio
