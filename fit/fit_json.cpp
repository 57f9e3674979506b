#include "fit/fit_json.h"

#include <fmt/format.h>

#include <cmath>

namespace gonio {
namespace {

using Json = nlohmann::ordered_json;

template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}
Json stated(const std::string& text) { return text.empty() ? Json("not stated") : Json(text); }
/// JSON knows no infinity.
Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json parameter(const FittedParameter& p) {
  Json json{{"value", p.value},       {"standard_error", or_null(p.standard_error)},
            {"unit", p.unit},         {"interval95", {p.lo95, p.hi95}},
            {"at_bound", p.at_bound}, {"identifiable", p.identifiable}};
  json["interval95_kind"] = p.interval95_kind;
  if (p.lo_open || p.hi_open) json["interval95_open"] = {p.lo_open, p.hi_open};
  if (p.held) json["held"] = true;
  return json;
}

/// Lists over wavelength_nm in place of what differs between wavelengths.
Json parameters(const FitResult& result) {
  Json all = Json::object();
  for (const FittedParameter& p : result.parameters) {
    const Json one = parameter(p);
    if (p.group == FittedParameter::kShared) {
      all[p.name] = one;
      continue;
    }
    Json& lists = all[p.name];
    for (const auto& [key, value] : one.items())
      if (key == "unit" || key == "interval95_kind")
        lists[key] = value;
      else
        lists[key].push_back(value);
  }
  return all;
}

/// Choices that are no numbers; of a sum with the suffix of the lobe.
Json options(const LobeSum& model) {
  Json json = Json::object();
  for (std::size_t j = 0; j < model.lobes().size(); ++j) {
    const ModelSpec& lobe = model.lobes()[j];
    const std::string suffix = model.is_sum() ? fmt::format("_{}", j + 1) : "";
    if (!lobe.info().shadowings.empty()) json["shadowing" + suffix] = name_of(lobe.shadowing);
    if (lobe.retro) json["retro" + suffix] = "yes";
  }
  return json;
}

Json residuals_of(const Residuals& r) {
  return {{"points", r.points}, {"rms", r.rms}, {"rms_log10", r.rms_log10}, {"mean_log10", r.mean_log10}};
}

Json incidence(const IncidenceResiduals& r) {
  Json json{{"theta_i_deg", r.theta_i_deg}};
  json.update(residuals_of(r));
  json["held_out"] = r.held_out;
  return json;
}

Json residuals(const FitResult& result) {
  Json json{{"rms", result.all.rms}, {"rms_log10", result.all.rms_log10}, {"mean_log10", result.all.mean_log10}};
  json["by_scan"] = Json::array();
  for (const IncidenceResiduals& r : result.by_incidence) json["by_scan"].push_back(incidence(r));
  json["held_out"] = result.held_out ? incidence(*result.held_out) : Json(nullptr);
  json["incidences_binned"] = result.incidences_binned;
  json["neighbour_correlation"] = result.neighbour_correlation;
  return json;
}

Json next(const NextMeasurement& n) {
  return {{"theta_i_deg", n.theta_i_deg}, {"theta_o_deg", n.theta_o_deg},       {"phi_deg", n.phi_deg},
          {"parameter", n.parameter},     {"log_error_before", n.error_before}, {"log_error_after", n.error_after}};
}

}  // namespace

Json to_json(const FitResult& result) {
  Json json{{"gonio_fit", 1}, {"model", result.model.name()}, {"variant", result.model.variant()}};
  json["options"] = options(result.model);
  json["material"] = or_null(result.material);
  json["wavelength_nm"] = result.wavelength_nm;
  json["assumed_wavelength_nm"] = or_null(result.assumed_wavelength_nm);
  json["parameters"] = parameters(result);
  json["metric"] = name_of(result.metric);
  json["weighting"] = name_of(result.weighting);
  if (result.chi2_reduced) json["chi2_reduced"] = *result.chi2_reduced;
  if (result.relative_sd > 0) json["relative_sd"] = result.relative_sd;
  if (result.aperture.detector_deg > 0 || result.aperture.source_deg > 0)
    json["aperture"] = {{"detector_deg", result.aperture.detector_deg}, {"source_deg", result.aperture.source_deg}};
  if (result.loss != Loss::none) json["loss"] = {{"name", name_of(result.loss)}, {"width", result.loss_width}};
  json["floor_per_sr"] = result.floor_per_sr;
  json["residuals"] = residuals(result);
  json["correlation"] = {
      {"names", result.correlation_names}, {"matrix", result.correlation}, {"condition", finite(result.condition)}};
  json["starts"] = {{"count", result.starts},
                    {"converged", result.starts_converged},
                    {"distinct_minima", result.distinct_minima},
                    {"refused_evaluations", result.refused_evaluations}};
  json["converged"] = result.converged;
  json["points"] = {{"used", result.points_used}, {"left_out", Json(result.left_out)}};
  json["warnings"] = result.warnings;
  json["next_measurement"] = result.next_measurement ? next(*result.next_measurement) : Json(nullptr);
  json["source"] = {{"measurement", result.measurement_id},
                    {"name", stated(result.name)},
                    {"source", stated(result.source)},
                    {"licence", stated(result.licence)},
                    {"quantity", result.quantity}};
  return json;
}

}  // namespace gonio
