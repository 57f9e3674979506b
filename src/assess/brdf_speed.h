#pragma once
// What an evaluation costs: every model and variant on this machine, one thread, beside a plain loop of the textbook formula.
#include <string>
#include <vector>

#include "assess/brdf_error.h"
#include "assess/counted.h"
#include "assess/sphere_difference.h"

namespace gonio {

/// Nanoseconds an evaluation (reduction of the unit vectors included), the least of several runs over 512 pairs in memory near the core.
struct EvaluationCost {
  double float_lanes, double_lanes, float_scalar, double_scalar;
};
EvaluationCost evaluation_cost(const ModelSpec& spec, const std::vector<double>& values);

/// Beckmann's normals, correlated Smith shadowing and a conductor as the textbooks print them: exp, erfc, one division each; a plain
/// scalar loop in double, as the compiler makes it. The measure that the ratios refer to.
double plain_beckmann(const UnitVector<double>& i, const UnitVector<double>& o, double alpha, double n, double k);
double plain_loop_ns();

/// Loops of torrance-sparrow (correlated, conductor) that the ratios name, in ns an evaluation (a pair).
struct FacetedCosts {
  double plain, double_lanes, float_lanes;  ///< one wavelength
  double jet, dual_lanes;  ///< with derivatives by alpha, n, k: ceres::Jet, a dual number over double lanes
  double one_pair, one_pair_16,
      one_pair_16f;  ///< one pair at a time: one wavelength; 16 wavelengths side by side, double and float lanes
  double lanes_16, float_lanes_16;             ///< pairs in lanes, 16 wavelengths each: D and G once
  double fma_per_ns_double, fma_per_ns_float;  ///< measured ceiling: fused multiply-adds of lanes, in numbers a ns
  OperationCount operations;                   ///< of one evaluation, invariants of the batch not counted
};
FacetedCosts faceted_costs();

/// Beckmann-Kirchhoff over pairs of all directions at a phase variance g at the normal, ns an evaluation.
struct DiffractionCost {
  double g, float_lanes, double_lanes;
};
std::vector<DiffractionCost> diffraction_costs();

/// Values in the middle of the box that the fit searches (geometric), kd = 0.
std::vector<double> middle_values(const ModelInfo& info);

/// ΔE_2000 (D65, 1931 observer) on a sphere of gold lit at 45° from the eye, its brightest point Y = 100: `spec` against `exact`.
VisibleError visible_error(const ModelSpec& spec, const ModelSpec& exact, const std::vector<double>& values);

}  // namespace gonio
