#include "cli/diagnosed.h"

#include <fmt/format.h>

#include <algorithm>

#include "fit/diagnostics_json.h"
#include "fit/fit_json.h"

namespace gonio::cli {

nlohmann::ordered_json diagnosed(const Measurement& scan, const FitOptions& options, FitResult& result) {
  const FitDiagnostics found =
      diagnose(scan, result, options.material.empty() ? std::nullopt : std::optional(options.material));
  if (result.relative_sd > 0 && options.noise.empty())
    result.warnings.push_back(fmt::format(
        "no standard deviation is stated: {:.2g} of each value is taken, what its repeats or reciprocal pairs show",
        result.relative_sd));
  result.warnings.insert(result.warnings.end(), found.warnings.begin(), found.warnings.end());
  nlohmann::ordered_json json = to_json(result);
  json["diagnostics"] = diagnostics_json(found, result);
  return json;
}

FitRequest request_for_scan(const FitOptions& options, const std::string& model_name, std::uint64_t seed,
                            const Measurement& scan) {
  FitRequest request = request_for(options, model_name, seed, scan.aperture_deg);
  if (request.metric != Metric::likelihood || request.relative_sd > 0) return request;
  const bool stated =
      std::all_of(scan.points.begin(), scan.points.end(), [](const ScanPoint& p) { return p.f_std_per_sr > 0; });
  if (stated) return request;
  if (const auto noise = noise_estimate(scan)) request.relative_sd = noise->relative_sd;
  return request;
}

}  // namespace gonio::cli
