#pragma once
#include <vector>

#include "fit/problem.h"

namespace gonio {

/// Start number `index` of a low-discrepancy design (Sobol, leaped over its first points by `seed`), in the middle 80 %
/// of each box on the logarithmic scale. The same index gives the same start, whatever the number of starts.
std::vector<double> start_point(const FitProblem& problem, int index, std::uint64_t seed);

/// Brings a start near a minimum before the derivatives take over. kd and ks are eliminated: for given roughness they
/// solve a two-parameter fit under the same metric (begun from a non-negative linear least-squares solution). What is
/// left is searched on a grid along one coordinate after the other, and along the direction in which all of them grow
/// together (sigma/T constant), until no grid point is better.
std::vector<double> improve_start(const FitProblem& problem, std::vector<double> x);

/// The kd, ks that fit best at the roughness of x; returns ½·Σ residual². Public for its test.
double eliminate_linear(const FitProblem& problem, std::vector<double>& x);

}  // namespace gonio
