#pragma once
#include <vector>

#include "fit/fit.h"
#include "fit/problem.h"
#include "fit/solver.h"

namespace gonio {

/// Where the profile of a parameter, which is the least cost of the fit while the parameter is held, has risen to the 95 % bound.
struct ProfileInterval {
  double lo = 0, hi = 0;                  ///< of the parameter itself, in its own unit
  bool lo_open = false, hi_open = false;  ///< the box ended first: lo or hi is the box's end
  bool known = false;  ///< false: no degree of freedom, or no finite solution with the parameter held
};

/// 95 % profile-likelihood intervals, one for each of problem.free.
///
/// A value v belongs to the interval of parameter p while
///   min over the others of cost(p = v) <= cost_min·(1 + F/ν),  F = F_{0.95}(1, ν) = t_{0.975}(ν)²,
/// cost = ½ Σ residual², ν = points - free parameters inside their boxes, the residuals' variance estimated as 2 cost_min/ν
/// (Bates & Watts 1988, Nonlinear Regression Analysis, chapter 6; Venzon & Moolgavkar 1988, doi:10.2307/2347496).
/// Where the residuals are linear in the parameter this is Student's interval; elsewhere it need not be symmetric, may be ended by the
/// boxes of the others, and does not depend on whether the parameter or its logarithm is thought of. Where a model does not explain
/// the data the two differ even over short ways: the cost's own curvature holds the residuals' second derivatives, which JᵀJ leaves out.
/// Each end is bracketed by doubled steps and found by regula falsi in the logarithm, to 1e-6 of the bound. Robust losses: the bound is
/// that of their sum, an approximation. Held by the box (both ends at the value), or, kd and ks, by taking them out of the free
/// parameters; kd or ks of one wavelength among several cannot be taken out alone and stays unknown.
/// tests/fit/profile_likelihood_test.cpp.
std::vector<ProfileInterval> profile_intervals(const FitProblem& problem, const Solution& solution);

/// Replaces lo95 and hi95 of a result's free parameters by those of their profiles, where known, and says so in interval95_kind.
void use_profile_intervals(const FitProblem& problem, const Solution& solution, FitResult& result);

}  // namespace gonio
