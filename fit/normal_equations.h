#pragma once
#include "fit/solver.h"

namespace gonio {

inline constexpr int kMostColumns = 16;
/// Of few columns, without memory of its own.
using GramMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMostColumns, kMostColumns>;

/// The sums over all points at one place: for each block of kd and ks the Gram matrix of the columns [roughness …, kd, ks, residual],
/// weighted by the loss.
class NormalEquations {
 public:
  NormalEquations(const LaneFit& fit, bool with_roughness);

  /// Where the sums are taken: logarithms of the roughness (fit.roughness_), kd and ks of each block.
  std::vector<double> roughness;
  std::vector<std::array<double, 2>> linear;

  /// The lobe at `roughness`, then the sums; only the sums where the roughness is that of the last call. false where not finite.
  bool evaluate(bool new_roughness);
  /// Sums of ψ'(measured)·[kd, ks | measured]: a linear problem whose solution is near that of the metric.
  std::vector<Eigen::Matrix3d> linear_guess();

  double cost = 0;
  std::vector<GramMatrix> gram;
  const LobeColumns& columns() const { return columns_; }

 private:
  const LaneFit* fit_;  ///< not a reference: places are exchanged
  std::size_t varied_;
  LobeColumns columns_;
  struct Stretch {
    std::size_t group, from, to;
  };
  std::vector<Stretch> stretches_;  ///< blocks of batches
  /// The triangle of each, row by row, its cost after it.
  std::vector<std::array<double, kMostColumns*(kMostColumns + 1) / 2 + 1>> parts_;

  template <class Sums>
  void each_stretch(Sums&& sums) const;
  void evaluate_lobe_at();
};

}  // namespace gonio
