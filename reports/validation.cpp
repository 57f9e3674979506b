#include "reports/validation.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/files.h"
#include "energy/energy_file.h"
#include "energy/energy_tables.h"
#include "energy/limits_json.h"
#include "fit/fit_json.h"
#include "fit/fitted_material.h"
#include "fit/gnuplot.h"
#include "image/exr.h"
#include "image/png.h"
#include "render/render.h"
#include "scene/fitted.h"
#include "scene/scene.h"

namespace gonio {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr double kNoBetter = 1.05;  ///< errors within 5 % count as equal: the simpler model is taken

void say(const ValidationSettings& settings, const std::string& line) {
  if (settings.progress) settings.progress(line);
}

Trial try_model(const Measurement& measurement, ModelId id, bool free_n, const ValidationSettings& settings) {
  Trial trial;
  trial.name = fmt::format("{}{}", model(id).name, free_n ? ", n fitted" : "");
  FitRequest request;
  ModelSpec spec;
  spec.id = id;
  request.model = spec;
  request.free_n = free_n;
  request.starts = settings.starts;
  request.seed = settings.seed;
  say(settings, fmt::format("{}: fitting {}", measurement.id, trial.name));
  try {
    trial.fit = fit(measurement, request);
    trial.free_parameters = static_cast<int>(trial.fit->parameters.size());
  } catch (const InputError& error) {
    trial.skipped = error.what();
  }
  return trial;
}

std::vector<Trial> try_models(const Measurement& measurement, const ValidationSettings& settings) {
  std::vector<Trial> trials;
  // The thesis's own: its report compares these four.
  for (const ModelId id : {ModelId::lambert, ModelId::pseudo_realistic, ModelId::torrance_sparrow, ModelId::beckmann_kirchhoff})
    trials.push_back(try_model(measurement, id, false, settings));
  if (!measurement.material) trials.push_back(try_model(measurement, ModelId::torrance_sparrow, true, settings));
  return trials;
}

/// The error a model is judged by: where it was not fitted, else (one or two incidences) where it was.
double judged_error(const FitResult& fit) { return fit.held_out ? fit.held_out->rms_log10 : fit.all.rms_log10; }

/// May it be taken? Not when it did not converge, nor when its parameters scale with a wavelength that is only assumed.
bool eligible(const Trial& trial) {
  return trial.fit && trial.fit->converged &&
         !(trial.fit->model.needs_wavelength() && trial.fit->wavelength_nm.empty());
}

/// The simplest of the models whose error is within kNoBetter of the least; of equally simple ones the most accurate.
void choose(MaterialReport& report) {
  double least = HUGE_VAL;
  for (const Trial& trial : report.trials)
    if (eligible(trial)) least = std::min(least, judged_error(*trial.fit));
  const Trial* taken = nullptr;
  for (std::size_t i = 0; i < report.trials.size(); ++i) {
    const Trial& trial = report.trials[i];
    if (!eligible(trial) || judged_error(*trial.fit) > kNoBetter * least) continue;
    if (!taken || trial.free_parameters < taken->free_parameters ||
        (trial.free_parameters == taken->free_parameters && judged_error(*trial.fit) < judged_error(*taken->fit))) {
      taken = &trial;
      report.chosen = i;
    }
  }
  if (!taken) throw input_error("{}: no model could be fitted; expected a scan that one of them can describe", report.id);
  const std::string where = taken->fit->held_out
                                ? fmt::format("at the incidence left out of the fit, {:.4g}°", taken->fit->held_out->theta_i_deg)
                                : std::string("of the fit");
  report.choice = fmt::format("{} is taken: the simplest model within 5 % of the least error {} (rms of log10 = {:.4f}).", taken->name,
                              where, judged_error(*taken->fit));
  for (const Trial& trial : report.trials)
    if (trial.fit && trial.fit->converged && !eligible(trial))
      report.choice += fmt::format(" {} is shown but not taken: its parameters scale with the wavelength, which the scan does not state.",
                                   trial.name);
}

/// Where the fitted material is rendered and checked: over the visible range when its n, k come from the database, else at
/// the fit's wavelength.
std::vector<double> rendered_wavelengths(const FittedMaterial& material) {
  if (material.material) return visible_wavelengths();
  return {material.wavelength(std::nullopt).value_or(550)};
}

SurfaceSamples sample(const FittedMaterial& material) {
  SurfaceSamples samples;
  if (!material.material) {
    samples.wavelength_nm = rendered_wavelengths(material);
  } else {
    const SurfaceMaterial surface(*material.material);
    for (double nm = std::max(360.0, surface.range_lo_nm()); nm <= std::min(830.0, surface.range_hi_nm()); nm += 5)
      samples.wavelength_nm.push_back(nm);
  }
  for (const double nm : samples.wavelength_nm) {
    samples.surface.interfaces.push_back(material.surface(nm));
    samples.surface.wavelength_um.push_back(nm / 1000);
  }
  return samples;
}

std::string table_csv(const Limits& limits) {
  std::string text = "theta_deg,worst_wavelength_nm,E,error,coherent_energy,total\n";
  for (const LimitRow& row : limits.rows)
    text += fmt::format("{},{},{},{},{},{}\n", row.theta_deg, row.wavelength_nm, row.e.value, row.e.error, row.coherent, row.total);
  return text;
}

std::string energy_svg(const MaterialReport& report) {
  std::string script = "set xlabel 'angle of incidence (deg)'\nset ylabel 'reflected share of the energy'\nset key below\n"
                       "set xrange [0:90]\nset yrange [0:*]\nset grid\n$total << E\n";
  for (const LimitRow& row : report.limits.rows) script += fmt::format("{} {} {}\n", row.theta_deg, row.total, row.e.value + row.coherent);
  script += "E\nplot 1 lw 2 dt 2 lc rgb '#b3261e' title 'limit (43)', $total using 1:2 with linespoints lw 2 pt 7 ps 0.4 lc rgb "
            "'#1f4e79' title 'kd ρ_d + ks E, worst wavelength'";
  if (report.fit().model.first().id != ModelId::lambert)
    script += ", $total using 1:3 with lines lw 2 dt 3 lc rgb '#e08a00' title 'E of the lobe alone (ks = 1)'";
  return gnuplot_svg(script + "\n", 680, 440);
}

/// The fitted material with kd and ks times `scale`.
SceneMaterial scaled_material(const FittedMaterial& fitted, double scale) {
  SceneMaterial material = scene_material("fitted", fitted, rendered_wavelengths(fitted));
  const auto& parameters = fitted.model.parameters();
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (parameters[i].linear) material.values[i] *= scale;
  return material;
}

std::string render_caption(const MaterialReport& report, const FittedMaterial& material, double scale) {
  std::string text = scale == 1 ? "As fitted: " : fmt::format("kd and ks scaled by {:.6f} to the limit (43): ", scale);
  if (material.material)
    text += fmt::format("sphere on a grey ground (reflectance 0.4) under D65; F of {} over 390-700 nm, the fitted roughness, kd and ks "
                        "held constant over the spectrum: an assumption.",
                        *material.material);
  else
    text += fmt::format("sphere on a grey ground (reflectance 0.4), rendered at {} alone, hence grey.",
                        report.fit().wavelength_nm.empty() ? "one wavelength (not stated by the scan)"
                                                           : fmt::format("{:g} nm", rendered_wavelengths(material).front()));
  return text;
}

void render_one(MaterialReport& report, const FittedMaterial& material, double scale, const std::string& name, const fs::path& folder,
                const ValidationSettings& settings) {
  say(settings, fmt::format("{}: rendering {}", report.id, name));
  const Scene scene = validation_scene(scaled_material(material, scale), rendered_wavelengths(material));
  RenderSettings render_settings;
  render_settings.spp = settings.spp;
  render_settings.seed = settings.seed;
  render_settings.threads = settings.threads;
  render_settings.variance = false;
  render_settings.energy = EnergyRule::allow_gain;  // a fit is shown as it is, and what it gains is said beside it
  const RenderResult result = render(scene, render_settings);
  write_spectral_exr(folder / (name + ".exr"), result.image);
  write_png(folder / (name + ".png"), result.image, 1);
  std::string caption = render_caption(report, material, scale);
  for (const std::string& gain : result.gains) caption += fmt::format(" Not conserving: {}.", gain);
  report.renders.push_back({name + ".png", caption});
}

void check_energy(MaterialReport& report, const FittedMaterial& material, const fs::path& folder, const ValidationSettings& settings) {
  say(settings, fmt::format("{}: energy conservation", report.id));
  report.limits = conservation_limits(material.brdfs({}).front(), sample(material), limit_angles_deg());
  if (report.limits.worst_total > 1 + report.limits.worst_error) report.scale_to_limit = 1 / (report.limits.worst_total + report.limits.worst_error);
  write_file(folder / "limits.json", to_json(report.limits).dump(2) + "\n");
  write_file(folder / "table.csv", table_csv(report.limits));
  const auto families = family_lobes(make_brdfs(report.fit().model, report.fit().values()).front().lobe);
  if (!families.empty())
    if (const EnergyTable* table = bundled_energy_table(*families.front().family))
      write_energy_table(*table, folder / "lobe-table.exr");
  write_file(folder / "energy.svg", energy_svg(report));
  report.plots.push_back({"energy.svg", "Energy conservation: reflected share against the angle of incidence (source: adaptive "
                                        "quadrature of the fitted model)."});
}

}  // namespace

MaterialReport validate_measurement(const Measurement& measurement, const fs::path& folder, const ValidationSettings& settings) {
  MaterialReport report;
  report.id = measurement.id;
  report.measurement = measurement;
  report.trials = try_models(measurement, settings);
  choose(report);
  make_folder(folder);
  for (const Trial& trial : report.trials)
    if (trial.fit) write_file(folder / fmt::format("fit-{}{}.json", trial.fit->model.name(), trial.fit->index() ? "-n" : ""),
                              to_json(*trial.fit).dump(2) + "\n");
  write_file(folder / "fit.json", to_json(report.fit()).dump(2) + "\n");
  for (const Plot& plot : write_plots(report.fit(), folder)) report.plots.push_back({plot.file, plot.caption});
  const FittedMaterial material = fitted_material(report.fit());
  check_energy(report, material, folder, settings);
  render_one(report, material, 1, "sphere", folder, settings);
  if (report.scale_to_limit < 1) render_one(report, material, report.scale_to_limit, "sphere-at-the-limit", folder, settings);
  return report;
}

Json to_json(const MaterialReport& report) {
  const FitResult& fit = report.fit();
  return {{"measurement", report.id},
          {"model", fit.model.name()},
          {"rms_log10", fit.all.rms_log10},
          {"held_out_rms_log10", fit.held_out ? Json(fit.held_out->rms_log10) : Json(nullptr)},
          {"warnings", fit.warnings},
          {"conserves", report.limits.holds()},
          {"worst_total", report.limits.worst_total},
          {"scale_to_limit", report.scale_to_limit}};
}

}  // namespace gonio
