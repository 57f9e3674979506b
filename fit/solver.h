#pragma once
#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "fit/lobe_lanes.h"
#include "fit/problem.h"

namespace gonio {

/// kd, and ks of each lobe.
inline constexpr std::size_t kMostLinear = 1 + LobeSum::kMostLobes;
using Linear = std::array<double, kMostLinear>;

/// Where one start ended.
struct Solution {
  std::vector<double> x;
  double cost = 0;  ///< ½ Σ residual², or the sum of the robust losses
  bool converged = false;
  int iterations = 0;
  int rejected = 0;  ///< evaluations that were not finite and therefore refused
};

/// Relative decrease of the cost by a step below which a solve ends. Data that the model fits exactly are solved to the
/// last digit with either; data it does not fit converge linearly, and only the best start is worth kPolish.
inline constexpr double kSearch = 1e-10, kPolish = 1e-15;

/// Residuals and Jacobian at x, in the problem's order.
struct Linearised {
  Eigen::VectorXd residual;
  Eigen::MatrixXd jacobian;
  bool finite = false;
};

/// A problem (which it refers to) made ready: its points, or some of them, in lanes.
///
/// Least squares by Levenberg and Marquardt on the normal equations of [roughness …, kd, ks … | residual], whose sums are all that a step
/// needs of the points. kd and ks, of all wavelengths or of each, are eliminated from every step (Golub & Pereyra's variable
/// projection, here as the Schur complement of their blocks: the same Gauss-Newton step, and good for metrics in which they are
/// not linear); they stay >= 0 by an active set. The other parameters move in their logarithms, inside their boxes.
/// Own code where Ceres could stand: Ceres takes a residual and a row of the Jacobian from each point, and that is what costs the time (10 times
/// as much on the same residuals with ceres::Jet: reports/fit-speed); fit/least_squares.h, by Ceres, is for everything else.
/// Sums are taken in blocks of fixed length, added in order: the same bits for any number of threads.
class LaneFit {
 public:
  LaneFit(const FitProblem& problem, std::span<const std::size_t> points);

  Solution solve(std::vector<double> x, double tolerance = kPolish) const;
  /// The kd, ks that fit best at the roughness of x; returns the cost.
  double eliminate(std::vector<double>& x) const;
  Linearised linearise(const std::vector<double>& x) const;

  const FitProblem& problem() const { return problem_; }

 private:
  friend class NormalEquations;

  /// One of the lobes: what varies of it, in its own parameters (without n and k) and as places in roughness_ (n and k last), and R of its facets at
  /// the points, or at each node of the aperture.
  struct Lobe {
    std::vector<std::size_t> varied, roughness;
    std::vector<std::vector<DoubleLanes>> reflectance;
  };

  const FitProblem& problem_;
  LanePoints points_;
  std::vector<LanePoints> nodes_;  ///< of the aperture
  std::vector<Lobe> lobes_;
  std::vector<std::size_t> roughness_;  ///< places in x of what is not linear, n and k last
  /// Places in x of kd and ks of each block; kHeld where not free.
  std::vector<std::array<std::size_t, kMostLinear>> linear_;
  Linear held_{};                ///< kd and ks where they are not free
  std::vector<double> diffuse_;  ///< f per kd of each of points_.groups
  static constexpr std::size_t kHeld = static_cast<std::size_t>(-1);

  void find_places();
  void open_aperture(std::span<const std::size_t> points);
  std::size_t block_of(const LaneGroup& group) const { return linear_.size() == 1 ? 0 : group.group; }
  std::size_t linear_count() const { return 1 + lobes_.size(); }
};

/// From x, with all points.
Solution solve(const FitProblem& problem, std::vector<double> x, double tolerance = kPolish);
Linearised linearise(const FitProblem& problem, const std::vector<double>& x);

}  // namespace gonio
