#pragma once
#include <nlohmann/json.hpp>

#include "fit/diagnostics.h"

namespace gonio {

/// Of `gonio measurements info --json`.
nlohmann::ordered_json quality_json(const ScanQuality& quality, const std::optional<NoiseEstimate>& noise);

/// The part `diagnostics` of a fit.json; outliers with the directions of their points.
nlohmann::ordered_json diagnostics_json(const FitDiagnostics& diagnostics, const FitResult& result);

}  // namespace gonio
