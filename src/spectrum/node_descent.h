#pragma once
#include "spectrum/weight_fit.h"

namespace gonio {

/// Moves all nodes together while the worst ΔE_2000 falls: Gauss-Newton steps of nodes and weights at once, on the
/// least squares whose importances the last weight fit found, each kept only if fit_weights at the new nodes does
/// better. Nodes stay apart by kLeastGap_nm, within the range, and where every light shines.
NodeWeights descend_nodes(const SceneProducts& products, NodeWeights start, int most_steps, int rounds);

inline constexpr double kLeastGap_nm = 2;

/// Increasing, apart, within the range and lit.
bool nodes_allowed(const SceneProducts& products, const std::vector<double>& nodes_nm);

}  // namespace gonio
