#pragma once
#include <nlohmann/json.hpp>

#include "cli/fit_options.h"

namespace gonio::cli {

/// fit.json with what is to be asked of a final fit: `diagnostics`, whose warnings join the others, `polarisation`, and how the scan was
/// read. What `fit` and `batch` share.
nlohmann::ordered_json diagnosed(const Measurement& scan, const FitOptions& options, FitResult& result);

}  // namespace gonio::cli
