#include <fmt/format.h>

#include <cmath>

#include "reports/html.h"
#include "reports/validation.h"

namespace gonio {
namespace {

using html::escape;

std::string stated(const std::string& text) { return text.empty() ? "not stated" : escape(text); }

std::string parameter_text(const FittedParameter& p) {
  const std::string unit = p.unit == "1" ? "" : p.unit == "um" ? " µm" : fmt::format(" {}", p.unit);
  if (p.held) return fmt::format("{} = {:.5g}{} (held)", p.name, p.value, unit);
  if (!p.standard_error)
    return fmt::format("{} = {:.5g}{} ({})", p.name, p.value, unit, p.at_bound ? "at its bound" : "not identifiable");
  return fmt::format("{} = {:.5g}{} [{:.5g}, {:.5g}]", p.name, p.value, unit, p.lo95, p.hi95);
}

std::string percent(double log10_error) { return fmt::format("{:.4f} (×{:.2f})", log10_error, std::pow(10, log10_error)); }

std::string trials_table(const MaterialReport& report) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < report.trials.size(); ++i) {
    const Trial& trial = report.trials[i];
    const std::string name = (i == report.chosen ? "<b>" : "") + escape(trial.name) + (i == report.chosen ? "</b> (taken)" : "");
    if (!trial.fit) {
      rows.push_back({name, "not fitted: " + escape(trial.skipped), "", "", ""});
      continue;
    }
    std::string values;
    for (const FittedParameter& p : trial.fit->parameters) values += (values.empty() ? "" : "<br>") + parameter_text(p);
    rows.push_back({name, values, percent(trial.fit->all.rms_log10), trial.fit->held_out ? percent(trial.fit->held_out->rms_log10) : "–",
                    fmt::format("{} of {}, {}", trial.fit->starts_converged, trial.fit->starts,
                                trial.fit->distinct_minima == 1 ? "one minimum" : fmt::format("{} minima", trial.fit->distinct_minima))});
  }
  return html::table({"model", "parameters, 95 % interval", "rms of log<sub>10</sub>(model/data), fitted points (factor)",
                      "the same, incidence left out", "starts converged"},
                     rows);
}

std::string provenance(const Measurement& m, const FitResult& fit) {
  std::string left_out;
  for (const auto& [reason, count] : fit.left_out) left_out += fmt::format("{}{} × {}", left_out.empty() ? "" : "; ", count, escape(reason));
  const std::string wavelength = m.wavelengths().empty() ? fit.assumed_wavelength_nm
                                                               ? fmt::format("not stated; n and k of {} taken at {:g} nm: an assumption",
                                                                             escape(fit.material.value_or("")), *fit.assumed_wavelength_nm)
                                                               : "not stated"
                                                         : fmt::format("{:g} nm", m.wavelengths().front());
  return html::table({"", ""}, {{"source", stated(m.source)},
                                {"licence", stated(m.licence)},
                                {"sample", stated(m.sample)},
                                {"instrument", stated(m.instrument)},
                                {"uncertainty", stated(m.uncertainty)},
                                {"quantity in the file", escape(m.quantity)},
                                {"wavelength", wavelength},
                                {"facets' reflectance", fit.material ? escape(*fit.material)
                                                        : fit.index() ? fmt::format("dielectric, n = {:.4g} fitted", *fit.index())
                                                                      : "F = 1 (no material named): ks holds the reflectance"},
                                {"points", fmt::format("{} used{}", fit.points_used, left_out.empty() ? "" : "; left out: " + left_out)},
                                {"metric", fmt::format("{}, weighting {}, floor f0 = {:.3g} per sr", name_of(fit.metric), name_of(fit.weighting),
                                                       fit.floor_per_sr)}});
}

std::string verdict(const MaterialReport& report) {
  std::string out;
  for (const std::string& warning : report.fit().warnings) out += "<div class=\"bad\">" + escape(warning) + "</div>\n";
  if (report.fit().warnings.empty()) out += "<div class=\"good\">The fit has nothing to object to.</div>\n";
  return out;
}

std::string energy_verdict(const MaterialReport& report) {
  const Limits& limits = report.limits;
  const std::string where = fmt::format("at {:g}° incidence, {:g} nm", limits.worst_theta_deg, limits.worst_wavelength_nm);
  const std::string range = limits.range_lo_nm == limits.range_hi_nm
                                ? fmt::format("{:g} nm", limits.range_lo_nm)
                                : fmt::format("{:g}–{:g} nm", limits.range_lo_nm, limits.range_hi_nm);
  std::string out;
  if (limits.worst_total > 1 + limits.worst_error)
    out = fmt::format("<div class=\"bad\">The fitted material breaks energy conservation (43): it reflects {:.6f} {}, {:.4g} more than it receives. "
                      "Both are shown below: as fitted, and with kd and ks scaled by {:.6f} to the limit.</div>\n",
                      limits.worst_total, where, limits.worst_total - 1, report.scale_to_limit);
  else
    out = fmt::format("<div class=\"good\">Energy conservation (43) holds{}: at most {:.6f} of the energy comes back ({}; quadrature error "
                      "below {:.1g}).</div>\n",
                      limits.bounded ? "" : fmt::format(" up to {:g}°", limits.theta_max_deg), limits.worst_total, where, limits.worst_error);
  if (!limits.bounded)
    out += fmt::format("<div class=\"bad\">This lobe grows without bound at grazing: it is not conserving beyond {:g}°.</div>\n", limits.theta_max_deg);
  if (std::isfinite(limits.ks_max)) out += fmt::format("<p>ks<sub>max</sub> = {:.6f} (kd = 0); ", limits.ks_max);
  else out += "<p>No lobe, so no ks<sub>max</sub>; ";
  out += fmt::format("kd<sub>max</sub> = {:.6f} at the fitted ks; range examined {}, {}.</p>\n", limits.kd_max, range,
                     limits.bounded ? "0 to 89.99°" : fmt::format("0 to {:g}°", limits.theta_max_deg));
  return out;
}

std::string section(const MaterialReport& report, const std::filesystem::path& folder) {
  const FitResult& fit = report.fit();
  std::string out = fmt::format("<h2 id=\"{0}\">{1}</h2>\n{2}", escape(report.id),
                                report.measurement.name.empty() ? escape(report.id) : escape(report.measurement.name),
                                provenance(report.measurement, fit));
  out += "<h3>Which model explains it, and how surely</h3>\n<p>" + escape(report.choice) + "</p>\n" + trials_table(report) + verdict(report);
  out += "<h3>Measured against fitted</h3>\n";
  for (const Picture& plot : report.plots)
    if (plot.file != "energy.svg") out += html::figure(folder / plot.file, plot.caption);
  if (!fit.by_incidence.empty()) {
    std::vector<std::vector<std::string>> rows;
    for (const IncidenceResiduals& r : fit.by_incidence)
      rows.push_back({fmt::format("{:g}{}", r.theta_i_deg, r.held_out ? " (left out of the fit)" : ""), fmt::format("{}", r.points),
                      fmt::format("{:.4f}", r.rms_log10), fmt::format("{:+.4f}", r.mean_log10)});
    out += html::table({"incidence (deg)", "points", "rms of log<sub>10</sub>(model/data)", "mean (positive: model too bright)"}, rows);
  }
  out += "<h3>Does it conserve energy?</h3>\n" + energy_verdict(report);
  for (const Picture& plot : report.plots)
    if (plot.file == "energy.svg") out += html::figure(folder / plot.file, plot.caption);
  out += "<h3>What it looks like</h3>\n";
  for (const Picture& picture : report.renders) out += html::figure(folder / picture.file, picture.caption);
  out += fmt::format("<p class=\"note\">Files in the folder {}: fit.json (and one a model tried), limits.json, table.csv, the plots, and the renders "
                     "as spectral OpenEXR and PNG.</p>\n",
                     escape(report.id));
  return out;
}

std::string summary(const std::vector<MaterialReport>& reports) {
  std::vector<std::vector<std::string>> rows;
  for (const MaterialReport& r : reports)
    rows.push_back({fmt::format("<a href=\"#{0}\">{0}</a>", escape(r.id)), escape(r.trials[r.chosen].name), percent(r.fit().all.rms_log10),
                    r.fit().held_out ? percent(r.fit().held_out->rms_log10) : "–",
                    r.limits.holds() ? fmt::format("yes (at most {:.4f})", r.limits.worst_total)
                    : r.limits.worst_total > 1 + r.limits.worst_error ? fmt::format("no: {:.4f} at {:g}°", r.limits.worst_total, r.limits.worst_theta_deg)
                                                                      : fmt::format("up to {:g}°", r.limits.theta_max_deg),
                    r.fit().warnings.empty() ? "–" : fmt::format("{}", r.fit().warnings.size())});
  return html::table({"measurement", "model", "fit error, rms log<sub>10</sub> (factor)", "left-out incidence", "conserves energy", "warnings"}, rows);
}

}  // namespace

std::string validation_page(const std::vector<MaterialReport>& reports, const std::filesystem::path& folder) {
  std::string body = "<h1>Materials validated against measurements</h1>\n<p>Each scan is fitted by every model that its data allow; the model taken is "
                     "checked against energy conservation and rendered. f<sub>r</sub> is a BRDF in sr<sup>-1</sup>, without cosine; errors are rms "
                     "of log<sub>10</sub>(model/data), beside them the factor they stand for.</p>\n";
  body += summary(reports);
  for (const MaterialReport& report : reports) body += section(report, folder / report.id);
  return html::page("gonio: materials validated against measurements", body);
}

}  // namespace gonio
