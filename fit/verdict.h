#pragma once
#include "fit/fit.h"
#include "fit/prepare.h"

namespace gonio {

/// From this rms of log10(model/data) on, typical errors exceed a quarter of the value and the fit says so.
inline constexpr double kExplains = 0.1;

/// Fills residuals, errors by incidence, the held-out error, and says in plain words where the model fails the data.
/// `result.points` must hold measured and fitted values.
void judge(const Prepared& prepared, FitResult& result);

}  // namespace gonio
