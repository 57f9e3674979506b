#pragma once
#include "fit/solver.h"

namespace gonio {

/// Roughness, kd, ks of each lobe and the residual.
inline constexpr int kMostColumns = 20;
/// Of few columns, without memory of its own.
using GramMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMostColumns, kMostColumns>;
/// Of kd, ks of each lobe and the measured values.
using LinearGram =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMostLinear + 1, kMostLinear + 1>;

/// The sums over all points at one place: for each block of kd and ks the Gram matrix of the columns [roughness …, kd, ks …, residual],
/// weighted by the loss.
class NormalEquations {
 public:
  NormalEquations(const LaneFit& fit, bool with_roughness);

  /// Where the sums are taken: logarithms of the roughness (fit.roughness_), kd and ks of each block.
  std::vector<double> roughness;
  std::vector<Linear> linear;

  /// The lobes at `roughness`, then the sums; only the sums where the roughness is that of the last call. false where not finite.
  bool evaluate(bool new_roughness);
  /// Sums of ψ'(measured)·[kd, ks … | measured]: a linear problem whose solution is near that of the metric.
  std::vector<LinearGram> linear_guess();

  double cost = 0;
  std::vector<GramMatrix> gram;
  const std::vector<LobeColumns>& columns() const { return columns_; }  ///< of each lobe

  /// A stretch of batches as its loop sees it.
  struct Block {
    const LanePoints* points;
    std::size_t lobes, columns;
    std::array<const DoubleLanes*, LobeSum::kMostLobes> value{};
    /// Derivatives by each roughness; null where it is not this lobe's.
    std::array<std::array<const DoubleLanes*, kMostColumns>, LobeSum::kMostLobes> slope{};
    Linear linear{};
    double diffuse = 0, floor_per_sr = 0, loss_width = 1;
    std::size_t from = 0, to = 0;
  };
  /// The triangle of the Gram matrix, row by row, and the cost after it.
  using Triangle = std::array<double, kMostColumns*(kMostColumns + 1) / 2 + 1>;

 private:
  const LaneFit* fit_;  ///< not a reference: places are exchanged
  std::size_t varied_;
  std::vector<LobeColumns> columns_;
  LobeColumns node_;  ///< of one lobe at one node of the aperture
  struct Stretch {
    std::size_t group, from, to;
  };
  std::vector<Stretch> stretches_;  ///< blocks of batches
  std::vector<Triangle> parts_;

  template <class Sums>
  void each_stretch(Sums&& sums) const;
  void evaluate_lobes();
  void average(std::size_t lobe, const LobeAt& at);
  Block block_of(const Stretch& stretch) const;
};

}  // namespace gonio
