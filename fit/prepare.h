#pragma once
#include "fit/fit.h"
#include "fit/problem.h"

namespace gonio {

/// A scan made ready for fitting: all its points as the models see them, and which of them are fitted.
struct Prepared {
  FitProblem problem;            ///< with the points that are fitted
  std::vector<FitPoint> points;  ///< all of the scan
  std::vector<bool> used, held_out;
  std::optional<std::size_t> held_incidence;
};

/// Fills the part of `result` that does not depend on the fit (material, wavelengths, metric, counts, warnings).
Prepared prepare(const Measurement& measurement, const FitRequest& request, FitResult& result);

}  // namespace gonio
