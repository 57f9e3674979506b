#pragma once
#include <span>
#include <vector>

#include "brdf/directions.h"
#include "fit/problem.h"

namespace gonio {

/// Points of one wavelength, in whole batches: the last one is filled up with points of no weight.
struct LaneGroup {
  std::size_t first = 0, batches = 0;  ///< in batches
  std::size_t group = 0;               ///< FitPoint's
  double wavelength_um = 1;
  Interface<double> surface;
};

/// The points of a problem as lanes see them: a component an array, a wavelength a group, so that n, k, kd and ks are the same in every
/// lane of a batch.
struct LanePoints {
  static constexpr std::size_t kWidth = DoubleLanes::size;

  /// At the points' own directions, or at those of a node of the aperture.
  LanePoints(const FitProblem& problem, std::span<const std::size_t> chosen, const ApertureNode* node = nullptr);

  Directions<DoubleLanes> directions(std::size_t batch) const {
    return {cos_i[batch], cos_o[batch], cos_d[batch], tan2_h[batch], tan2_i[batch], tan2_o[batch],
            ix[batch],    iy[batch],    ox[batch],    oy[batch],     hx[batch],     hy[batch]};
  }

  std::vector<DoubleLanes> cos_i, cos_o, cos_d, tan2_h, tan2_i, tan2_o, ix, iy, ox, oy, hx, hy;
  std::vector<DoubleLanes> measured;    ///< per sr
  std::vector<DoubleLanes> compared;    ///< ψ of it
  std::vector<DoubleLanes> weight;      ///< of FitPoint
  std::vector<DoubleLanes> confidence;  ///< what a residual is multiplied by; 0 where there is no point
  std::vector<DoubleLanes> share;       ///< of a node: its weight
  std::vector<LaneGroup> groups;
  std::vector<std::size_t> point;  ///< of each lane, kNoPoint where there is none
  std::size_t count = 0;           ///< of points

  static constexpr std::size_t kNoPoint = static_cast<std::size_t>(-1);
  std::size_t batches() const { return cos_i.size(); }
};

/// All points, or at most `most` of them, evenly through the problem's order.
std::vector<std::size_t> every_point(const FitProblem& problem);
std::vector<std::size_t> thinned_points(const FitProblem& problem, std::size_t most);

}  // namespace gonio
