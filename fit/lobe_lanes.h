#pragma once
#include <optional>
#include <span>
#include <vector>

#include "fit/lane_points.h"

namespace gonio {

/// A lobe at all points, without ks, and its derivatives by the logarithms of some of its parameters (n and k last, where they are free).
struct LobeColumns {
  std::vector<DoubleLanes> value;
  std::vector<std::vector<DoubleLanes>> slope;
};

/// What to evaluate: the model's parameters, those of them that vary, and n and k where they are free (k only with n, else 0).
struct LobeAt {
  ModelSpec model;
  std::span<const double> values;       ///< in the model's order; kd and ks are not looked at
  std::span<const std::size_t> varied;  ///< places of the parameters that vary, kd and ks not among them
  std::optional<double> n, k;

  /// Of what varies, n and k included.
  std::size_t slopes() const { return varied.size() + (n ? 1 : 0) + (k ? 1 : 0); }
};

/// R of each point for lobes that do not choose it themselves, where n is not free; the same at every step of a fit.
std::vector<DoubleLanes> facet_reflectances(const LanePoints& points, const LobeAt& at);

/// The lobe and, with `slopes`, its derivatives: the model's own code over a dual number of lanes, a few derivatives a pass.
/// `reflectance` is facet_reflectances' (empty where n is free). In parallel where there is much to do; results do not depend on it.
void evaluate_lobe(const LanePoints& points, const LobeAt& at, std::span<const DoubleLanes> reflectance, bool slopes,
                   LobeColumns& columns);

/// One pass with derivatives by at.varied[first …] (and n), as many as fit N; N = 0: the value alone. Instantiated for 0, 1, 2 and 4.
template <int N>
void lobe_pass(const LanePoints& points, const LobeAt& at, std::span<const DoubleLanes> reflectance, std::size_t first,
               LobeColumns& columns);

}  // namespace gonio
