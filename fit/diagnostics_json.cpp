#include "fit/diagnostics_json.h"

#include "fit/fit.h"

namespace gonio {
namespace {

using Json = nlohmann::ordered_json;

Json nm_or_null(double nm) { return nm == nm ? Json(nm) : Json(nullptr); }

Json pairs_json(const PairStatistics& pairs, bool with_sides) {
  Json json{{"pairs", pairs.pairs}};
  if (pairs.pairs == 0) return json;
  json["rms_log10"] = pairs.rms_log10, json["spread_log10"] = pairs.spread_log10;
  if (with_sides)
    json["median_log10"] = pairs.median_log10, json["median_error_log10"] = pairs.median_error_log10,
    json["one_sided"] = pairs.one_sided;
  return json;
}

Json outlier_json(const Outlier& outlier, const FittedPoint& p) {
  return {{"theta_i_deg", p.theta_i_deg},
          {"theta_o_deg", p.theta_o_deg},
          {"phi_deg", p.phi_deg},
          {"wavelength_nm", nm_or_null(p.wavelength_nm)},
          {"log10_ratio", outlier.log10_ratio},
          {"deviations", outlier.deviations},
          {"row", outlier.point}};
}

}  // namespace

Json quality_json(const ScanQuality& quality, const std::optional<NoiseEstimate>& noise) {
  Json json{{"repeats", pairs_json(quality.repeats, false)}, {"reciprocal", pairs_json(quality.reciprocal, true)}};
  json["noise"] = nullptr;
  if (noise) json["noise"] = {{"relative_sd", noise->relative_sd}, {"from", noise->from}, {"pairs", noise->pairs}};
  json["reflectance"] = Json::array();
  for (const ScanEnergy& e : quality.energies)
    json["reflectance"].push_back({{"theta_i_deg", e.theta_i_deg},
                                   {"phi_i_deg", e.phi_i_deg},
                                   {"wavelength_nm", nm_or_null(e.wavelength_nm)},
                                   {"value", e.reflectance},
                                   {"error", e.error},
                                   {"points", e.points}});
  json["warnings"] = quality.warnings;
  return json;
}

Json diagnostics_json(const FitDiagnostics& diagnostics, const FitResult& result) {
  const Outliers& outliers = diagnostics.outliers;
  Json listed = Json::array();
  for (const Outlier& one : outliers.largest) listed.push_back(outlier_json(one, result.points[one.point]));
  Json json{{"outliers",
             {{"count", outliers.count},
              {"expected", outliers.expected()},
              {"limit_deviations", Outliers::kDeviations},
              {"median_log10", outliers.median_log10},
              {"spread_log10", outliers.spread_log10},
              {"largest", std::move(listed)}}}};
  json["energy"] = nullptr;
  if (const auto& e = diagnostics.energy)
    json["energy"] = {{"largest", e->largest},
                      {"error", e->error},
                      {"theta_i_deg", e->theta_i_deg},
                      {"wavelength_nm", e->wavelength_nm ? Json(*e->wavelength_nm) : Json(nullptr)}};
  json["repeats"] = pairs_json(diagnostics.repeats, false);
  json["reciprocal"] = pairs_json(diagnostics.reciprocal, true);
  json["model_reciprocal"] = diagnostics.model_reciprocal;
  json["warnings"] = diagnostics.warnings;
  return json;
}

}  // namespace gonio
