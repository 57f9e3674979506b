#pragma once
#include "fit/fit.h"

namespace gonio {

/// What a scan hides from any fit, said as warnings of the result: a peak between its points (none lies near the mirror direction, or the
/// light's own for lobes turned back), and a detector at its end (its brightest values are all the same).
void warn_of_traps(const Measurement& scan, FitResult& result);

}  // namespace gonio
