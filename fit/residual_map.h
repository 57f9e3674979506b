#pragma once
#include <optional>
#include <string>

#include "fit/fit.h"

namespace gonio {

/// Where a fit misses its scan: log10((fitted + f0)/(measured + f0)), a panel an incidence (up to 12), outliers ringed
/// (fit/diagnostics.h); SVG. Scans in the plane of incidence: against the signed zenith angle. Scans with azimuths: as
/// colours over zenith angle and azimuth, the first wavelength alone. Nothing where no measured value is positive.
std::optional<std::string> residual_map_svg(const FitResult& result);

}  // namespace gonio
