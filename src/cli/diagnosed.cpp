#include "cli/diagnosed.h"

#include "fit/diagnostics_json.h"
#include "fit/fit_json.h"
#include "fit/polarisation.h"

namespace gonio::cli {

nlohmann::ordered_json diagnosed(const Measurement& scan, const FitOptions& options, FitResult& result) {
  const FitDiagnostics found =
      diagnose(scan, result, options.material.empty() ? std::nullopt : std::optional(options.material));
  result.warnings.insert(result.warnings.end(), found.warnings.begin(), found.warnings.end());
  nlohmann::ordered_json json = to_json(result);
  if (!scan.conventions.empty()) json["source"]["read_as"] = scan.conventions;
  json["diagnostics"] = diagnostics_json(found, result);
  const MuellerJudgement polarisation = judge_polarisation(scan, result);
  json["polarisation"] = to_json(polarisation, scan);
  if (const std::string words = sentence(polarisation); !words.empty()) json["polarisation"]["sentence"] = words;
  return json;
}

}  // namespace gonio::cli
