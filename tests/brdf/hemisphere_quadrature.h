#pragma once
// Adaptive quadrature over the hemisphere in the direction's own coordinates (1 - z and azimuth: equal areas), which no sampler uses;
// its leaves serve as the cells of a histogram.
#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <vector>

#include "base/number.h"
#include "base/unit_vector.h"

namespace gonio::test {

class HemisphereQuadrature {
 public:
  using Lanes = DoubleLanes;
  using Direction = UnitVector<double>;

  /// ∫ g dω, g(UnitVector<Lanes>) -> Lanes. Cells are halved until they are smaller than half their distance from `center`, or than a lobe of half
  /// vectors' slopes `width` is there; and, next to grazing, smaller than half their distance from the meridian of `center`, or
  /// than that lobe is across it: no peak and no ridge is missed.
  template <class G>
  HemisphereQuadrature(G&& g, const Direction& center, double width, double tolerance,
                       std::size_t most_cells = 200000) {
    cells_.push_back({0, 1, 0, kTurn});
    cells_[0].value = gauss(g, cells_[0]);
    for (std::size_t at = 0; at < cells_.size(); ++at) {  // children come later in the list
      const Cell& c = cells_[at];
      const double turn = turn_distance(c, center), z = 1 - 0.5 * (c.q0 + c.q1);
      if (std::max(polar_side(c), turn_side(c)) > kLargest)
        halve(g, at);
      else if (polar_side(c) >
               std::max(width * std::max(center.z, 0.02), 0.5 * std::max(polar_distance(c, center), turn)))
        split(g, at, true);
      else if (turn_side(c) > std::max(width * (z + center.z), 0.5 * turn))
        split(g, at, false);
    }
    for (int side = 0; side < 2; ++side)  // every cell's error from its halves, both ways
      for (std::size_t at = 0, n = cells_.size(); at < n; ++at)
        if (cells_[at].child < 0) split(g, at, side == 0);
    refine(g, tolerance, most_cells);
  }

  double integral() const { return total_; }
  double error() const { return error_; }

  /// Merges leaves, neighbours in the tree, into cells of at least `share` of the integral each.
  void make_bins(double share) {
    bins_.assign(1, 0);
    group(0, share * total_);
    if (bins_.size() > 1 && bins_.back() < share * total_) {  // the last one is too small: it joins its neighbour
      for (Cell& cell : cells_) cell.bin = std::min(cell.bin, int(bins_.size()) - 2);
      bins_[bins_.size() - 2] += bins_.back();
      bins_.pop_back();
    }
  }
  const std::vector<double>& bins() const { return bins_; }
  std::size_t bin_of(const Direction& i) const {
    const double q = 1 - i.z, phi = azimuth(i);
    std::size_t at = 0;
    while (cells_[at].child >= 0) {
      const Cell& one = cells_[std::size_t(cells_[at].child)];
      at = std::size_t(cells_[at].child + !(q <= one.q1 && phi <= one.phi1));
    }
    return std::size_t(cells_[at].bin);
  }

 private:
  static constexpr double kLargest = 0.25;  ///< rad, of any cell
  static constexpr double kTurn = 6.283185307179586476925286766559;
  struct Cell {
    double q0, q1, phi0, phi1;
    double value = 0, error = 0;
    int child = -1, bin = 0;  ///< the first of two children
  };

  static double azimuth(const Direction& i) {
    const double phi = std::atan2(i.y, i.x);
    return phi < 0 ? phi + kTurn : phi;
  }
  /// Length of the longer side on the sphere, and which it is.
  static double polar_side(const Cell& c) {
    return 2 * (std::asin(std::sqrt(0.5 * c.q1)) - std::asin(std::sqrt(0.5 * c.q0)));
  }
  static double turn_side(const Cell& c) { return (c.phi1 - c.phi0) * std::sqrt(c.q1 * (2 - c.q1)); }
  /// How far a cell lies from a direction, in zenith angle and around the zenith.
  static double polar_distance(const Cell& c, const Direction& to) {
    const double theta = 2 * std::asin(std::sqrt(0.5 * (1 - to.z)));
    return std::max({0.0, 2 * std::asin(std::sqrt(0.5 * c.q0)) - theta, theta - 2 * std::asin(std::sqrt(0.5 * c.q1))});
  }
  static double turn_distance(const Cell& c, const Direction& to) {
    const double phi = azimuth(to), over = std::max({0.0, c.phi0 - phi, phi - c.phi1});
    const double around = std::min(over, std::max(0.0, kTurn - std::max(phi - c.phi0, c.phi1 - phi)));
    return std::sqrt(c.q1 * (2 - c.q1)) * std::min(around, 1.0);
  }
  template <class G>
  void split(G& g, std::size_t at, bool polar) {
    const Cell parent = cells_[at];
    Cell a = parent, b = parent;
    if (polar)
      a.q1 = b.q0 = 0.5 * (parent.q0 + parent.q1);
    else
      a.phi1 = b.phi0 = 0.5 * (parent.phi0 + parent.phi1);
    a.value = gauss(g, a);
    b.value = gauss(g, b);
    // Halves that agree with their whole by chance (a kink along a side) still inherit a part of its error.
    a.error = b.error = std::max(0.5 * std::abs(parent.value - a.value - b.value), 0.12 * parent.error);
    cells_[at].child = int(cells_.size());
    cells_.push_back(a);
    cells_.push_back(b);
  }

  /// Across the side that matters more: the longer one.
  template <class G>
  void halve(G& g, std::size_t at) {
    split(g, at, polar_side(cells_[at]) > turn_side(cells_[at]));
  }

  template <class G>
  void refine(G& g, double tolerance, std::size_t most_cells) {
    std::priority_queue<std::pair<double, std::size_t>> worst;
    error_ = 0;
    for (std::size_t at = 0; at < cells_.size(); ++at)
      if (cells_[at].child < 0) worst.push({cells_[at].error, at}), error_ += cells_[at].error;
    while (error_ > tolerance && cells_.size() < most_cells) {
      const auto [error, at] = worst.top();
      worst.pop();
      halve(g, at);
      error_ -= error;
      for (int k = 0; k < 2; ++k) {
        const std::size_t child = std::size_t(cells_[at].child + k);
        worst.push({cells_[child].error, child});
        error_ += cells_[child].error;
      }
    }
    total_ = error_ = 0;
    for (const Cell& cell : cells_)
      if (cell.child < 0) total_ += cell.value, error_ += cell.error;
  }

  /// Gauss-Legendre, 4 × 4 nodes.
  template <class G>
  static double gauss(G& g, const Cell& c) {
    constexpr std::array<double, 4> x{-0.86113631159405257522, -0.33998104358485626480, 0.33998104358485626480,
                                      0.86113631159405257522};
    constexpr std::array<double, 4> w{0.34785484513745385737, 0.65214515486254614263, 0.65214515486254614263,
                                      0.34785484513745385737};
    std::array<double, 16> ix, iy, iz, weight;
    for (std::size_t k = 0; k < 16; ++k) {
      const double q = 0.5 * (c.q0 + c.q1) + 0.5 * (c.q1 - c.q0) * x[k / 4],
                   phi = 0.5 * (c.phi0 + c.phi1) + 0.5 * (c.phi1 - c.phi0) * x[k % 4];
      const double r = std::sqrt(q * (2 - q));
      ix[k] = r * std::cos(phi);
      iy[k] = r * std::sin(phi);
      iz[k] = 1 - q;
      weight[k] = 0.25 * w[k / 4] * w[k % 4];
    }
    Lanes sum(0.0);
    for (std::size_t k = 0; k < 16; k += Lanes::size)
      sum += Lanes::load_unaligned(&weight[k]) *
             g(UnitVector<Lanes>{Lanes::load_unaligned(&ix[k]), Lanes::load_unaligned(&iy[k]),
                                 Lanes::load_unaligned(&iz[k])});
    return xsimd::hadd(sum) * (c.q1 - c.q0) * (c.phi1 - c.phi0);
  }

  void group(std::size_t at, double least) {
    if (cells_[at].child >= 0) {
      const std::size_t child = std::size_t(cells_[at].child);
      group(child, least);
      group(child + 1, least);
      return;
    }
    if (bins_.back() >= least) bins_.push_back(0);
    cells_[at].bin = int(bins_.size()) - 1;
    bins_.back() += cells_[at].value;
  }

  std::vector<Cell> cells_;
  std::vector<double> bins_;
  double total_ = 0, error_ = 0;
};

}  // namespace gonio::test
