#pragma once
// As few wavelengths as a scene needs: nodes and non-negative weights fitted to its lights, reflectances and observer.
#include <cstdint>

#include "spectrum/weight_fit.h"

namespace gonio {

/// How hard to look. The quick search takes about 0.1 s for 30 reflectances to two bounces; each thorough start, which
/// tries every node everywhere by the worst ΔE_2000 itself, a hundred times as long.
struct WavelengthSearch {
  int starts = 3;           ///< node sets of the quick search (exchange on least squares, then Gauss-Newton)
  int thorough_starts = 0;  ///< further ones, in parallel; the result does not depend on the number of threads
  std::uint64_t seed = 1;
};

/// `count` wavelengths whose weighted sum stands in for the 1 nm sum. InputError unless 2 <= count <= 64 and the lights
/// shine at that many places 5 nm apart.
NodeWeights choose_wavelengths(const SceneProducts& products, int count, const WavelengthSearch& search = {});

/// The fewest wavelengths (to `most`) whose worst ΔE_2000 stays within the tolerance, found by growing steps and
/// halving; `most` of them where even these do not reach it (see worst_e2000).
NodeWeights fewest_wavelengths(const SceneProducts& products, double tolerance_e2000, int most,
                               const WavelengthSearch& search = {});

/// As `ColorWeights`, for renders.
ColorWeights color_weights(const NodeWeights& nodes);

}  // namespace gonio
