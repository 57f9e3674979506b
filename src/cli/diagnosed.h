#pragma once
#include <nlohmann/json.hpp>

#include "cli/fit_options.h"

namespace gonio::cli {

/// fit.json with its part `diagnostics`; the warnings of a final fit join the others. What `fit` and `batch` share.
nlohmann::ordered_json diagnosed(const Measurement& scan, const FitOptions& options, FitResult& result);

/// request_for of a scan. Under the likelihood, where neither the scan nor --noise says what a value is worth, its
/// repeats or reciprocal pairs do: once, not in each of the fits that a choice of model makes.
FitRequest request_for_scan(const FitOptions& options, const std::string& model_name, std::uint64_t seed,
                            const Measurement& scan);

}  // namespace gonio::cli
