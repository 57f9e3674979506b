#pragma once
#include <vector>

#include "fit/solver.h"

namespace gonio {

/// Start number `index` of a low-discrepancy design (Sobol, leaped over its first points by `seed`), in the middle 80 %
/// of each box on the logarithmic scale. The same index gives the same start, whatever the number of starts.
std::vector<double> start_point(const FitProblem& problem, int index, std::uint64_t seed);

/// Brings a start near a minimum before the derivatives take over. kd and ks are eliminated: for given roughness they
/// solve a two-parameter fit under the same metric (LaneFit::eliminate). What is
/// left is searched on a grid along one coordinate after the other, and along the direction in which all of them grow
/// together (sigma/T constant), until no grid point is better.
std::vector<double> improve_start(const LaneFit& fit, std::vector<double> x);

}  // namespace gonio
