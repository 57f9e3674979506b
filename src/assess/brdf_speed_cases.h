#pragma once
// The rows of `gonio assess speed brdf`: a case on a path, what it costs and what it loses.
#include <functional>

#include "assess/brdf_speed.h"

namespace gonio {

struct SpeedRow {
  ModelSpec spec;
  std::string path;  ///< float lanes, double lanes, float, double
  double ns = 0, largest = 0, percentile_999 = 0,
         mean = 0;             ///< relative errors where f > 1e-6 of its peak (float), 1e-290 (double)
  VisibleError visible{0, 0};  ///< of the variant's formula (double), against the exact form

  std::string name() const;
};

/// What a variant is compared with: the exact form that it approximates, or itself (a reading of its own, a published formula).
ModelSpec exact_form(const ModelSpec& spec);

/// Every model with its default shadowing and every variant, over the box that the fit searches.
std::vector<SpeedRow> speed_rows(const std::function<void(const std::string&)>& progress);

/// Those that nothing else beats in both cost and error, by cost.
std::vector<SpeedRow> pareto_front(std::vector<SpeedRow> rows);

/// Schlick 1992's D for Beckmann's over alpha 0.05 to 0.7 and all angles: errors as shares of the peak, relative ones where both are
/// above 1e-3 of it, and how much faster it is (scalar double as the compiler makes it; float lanes).
struct SchlickClaim {
  double mean, deviation, largest, relative_mean, relative_largest, share_of_zeros, speed_scalar, speed_lanes;
};
SchlickClaim schlick_claim();

}  // namespace gonio
