#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files.h"
#include "cli/commands.h"
#include "cli/progress.h"
#include "cli/subject.h"
#include "energy/energy_file.h"
#include "energy/energy_tables.h"
#include "energy/limits_json.h"
#include "energy/material_energy.h"

namespace gonio::cli {
namespace {

using Json = nlohmann::ordered_json;

struct TableArguments {
  ModelArguments model;
  SurfaceArguments surface;
  std::string out, angles;
  std::optional<double> at_nm, ks;
  bool spectrum = false;
};

Json limits_json(Limits limits, const Subject& subject, const std::vector<LimitRow>& rows) {
  limits.rows = rows;
  Json json{{"model", subject.model.sum.name()}, {"material", subject.surface.name()}};
  json.update(to_json(limits));
  return json;
}

/// "kd = 0.1", "ks_1 = 0.3, ks_2 = 0.5"; where the wavelengths differ "kd = 0.1 to 0.4". lambert has ks = 0.
std::string linear_values(const Subject& subject, const Limits& limits, std::string_view kind) {
  const auto& parameters = subject.model.sum.parameters();
  const std::vector<double> values = subject.values_at(limits.range_lo_nm);
  const bool one_only = limits.range_lo_nm == limits.range_hi_nm || !subject.is_spectral();
  std::string text;
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    if (!parameters[p].name.starts_with(kind)) continue;
    text += fmt::format("{}{} = ", text.empty() ? "" : ", ", parameters[p].name);
    if (one_only || subject.fitted->by_wavelength[p].empty()) {
      text += fmt::format("{:g}", values[p]);
    } else {
      const auto [least, most] = std::ranges::minmax(subject.fitted->by_wavelength[p]);
      text += fmt::format("{:g} to {:g}", least, most);
    }
  }
  return text.empty() ? fmt::format("{} = 0", kind) : text;
}

void print_limits(const Limits& limits, const Subject& subject, const std::vector<LimitRow>& rows) {
  const bool spectral = limits.range_lo_nm > 0;
  fmt::print("{} on {}{}\n", subject.model.sum.name(), subject.surface.name(),
             !spectral                                  ? ""
             : limits.range_lo_nm == limits.range_hi_nm ? fmt::format(" at {:g} nm", limits.range_lo_nm)
                                                        : fmt::format(", {:g}-{:g} nm (worst wavelength at each angle)",
                                                                      limits.range_lo_nm, limits.range_hi_nm));
  fmt::print("{:>10} {:>12} {:>10}{}\n", "theta_deg", subject.model.sum.is_sum() ? "E (own ks)" : "E (ks = 1)", "error",
             spectral ? "  wavelength_nm" : "");
  for (const LimitRow& row : rows)
    fmt::print("{:>10g} {:>12.8f} {:>10.1e}{}{}\n", row.theta_deg, row.e.value, row.e.error,
               spectral ? fmt::format(" {:>14g}", row.wavelength_nm) : "",
               row.coherent > 0 ? fmt::format("  + coherent {:.6f}", row.coherent) : "");
  if (!limits.bounded)
    fmt::print("not conserving beyond {:g} deg: this lobe is unbounded at grazing; the limits hold up to there\n",
               limits.theta_max_deg);
  const bool sum = subject.model.sum.is_sum();
  const std::string kd = linear_values(subject, limits, "kd"), ks = linear_values(subject, limits, "ks");
  fmt::print("ks_max = {:.6f} ({}kd = 0)\nkd_max = {:.6f} ({})\n", limits.ks_max, sum ? "all ks times this; " : "",
             limits.kd_max, ks);
  fmt::print("{}, {}: largest kd rho_d + {} = {:.6f} at {:g} deg; (43) {}\n", kd, ks, sum ? "E" : "ks E",
             limits.worst_total, limits.worst_theta_deg,
             limits.worst_total > 1 + limits.worst_error ? fmt::format("is broken by {:.4g}", limits.worst_total - 1)
             : limits.bounded                            ? "holds"
                                                         : "holds up to there");
  fmt::print("under uniform light its behaviour is {}: least kd rho_d {:.6f}, largest ks E {:.6f}\n",
             limits.behaviour(), limits.diffuse_least, limits.lobes_most);
}

void set_ks(Subject& subject, double ks) {
  const LobeSum& sum = subject.model.sum;
  if (sum.first().id == ModelId::lambert) throw input_error("--ks: lambert has no lobe; expected kd only");
  if (sum.is_sum()) throw input_error("--ks: {} has a ks for each lobe; expected --set ks_1=…", sum.name());
  if (subject.is_spectral())
    throw input_error("--ks: this fit's kd or ks differ between wavelengths; expected no --ks");
  subject.model.values.back() = ks;
  if (subject.fitted) subject.fitted->values = subject.model.values;
  sum.check(subject.model.values);
}

/// One list where one serves all wavelengths.
SampledLobes lobes_at(const Subject& subject, const std::vector<double>& wavelengths_nm) {
  if (!subject.is_spectral()) return {make_brdfs(subject.model.sum, subject.model.values)};
  SampledLobes all;
  for (const double nm : wavelengths_nm) all.push_back(make_brdfs(subject.model.sum, subject.values_at(nm)));
  return all;
}

/// Limits of one wavelength, from the curves of its lobes and rounded to the conserving side by their error.
struct SpectrumRow {
  double wavelength_nm, e_max, e_mean, error, ks_max, kd_max;
};

SpectrumRow limits_at(const MaterialEnergy& energy, const std::vector<Brdf<double>>& lobes,
                      const SurfaceSamples& samples, std::size_t w) {
  SpectrumRow row{samples.wavelength_nm[w], 0, 0, 0, 0, 0};
  std::vector<Brdf<double>> asked = lobes;
  if (asked.size() == 1) asked[0].ks = 1;
  for (std::size_t j = 0; j < asked.size(); ++j) {
    row.e_mean += asked[j].ks * energy.lobes[j].at(w).mean();
    row.error += asked[j].ks * energy.lobes[j].error();
  }
  row.e_max = lobes_reflectance(energy, asked, samples.surface, w).value;
  const double rho_d = lobes[0].diffuse_times_r0() ? samples.surface.interfaces[w].r0() : 1;
  row.ks_max = 1 / (row.e_max + row.error);
  row.kd_max = std::max(0.0, (1 - (lobes.size() == 1 ? lobes[0].ks : 1) * (row.e_max + row.error)) / rho_d);
  return row;
}

std::vector<SpectrumRow> limits_spectrum(const SampledLobes& materials, const SurfaceSamples& samples) {
  for (const Brdf<double>& one : materials.front())
    if (unbounded_at_grazing(one.lobe))
      throw input_error("--spectrum: the lobe grows without bound next to grazing; expected a bounded one, or --at NM");
  const MaterialEnergy energy(materials.front(), samples.surface, CompensationKind::none);
  std::vector<SpectrumRow> rows;
  for (std::size_t w = 0; w < samples.surface.size(); ++w)
    rows.push_back(limits_at(energy, materials[materials.size() > 1 ? w : 0], samples, w));
  return rows;
}

Json spectrum_json(const std::vector<SpectrumRow>& rows) {
  Json all = Json::array();
  for (const SpectrumRow& row : rows)
    all.push_back({{"wavelength_nm", row.wavelength_nm > 0 ? Json(row.wavelength_nm) : Json(nullptr)},
                   {"ks_max", row.ks_max},
                   {"kd_max", row.kd_max},
                   {"E_max", row.e_max},
                   {"E_mean", row.e_mean},
                   {"error", row.error}});
  return all;
}

void print_spectrum(const std::vector<SpectrumRow>& rows) {
  fmt::print(
      "{:>13} {:>9} {:>9} {:>9} {:>9}   (E_max with deltas, E_mean without; rounded to the conserving side by "
      "{:.1g})\n",
      "wavelength_nm", "ks_max", "kd_max", "E_max", "E_mean", rows.front().error);
  for (const SpectrumRow& row : rows)
    fmt::print("{:>13g} {:>9.5f} {:>9.5f} {:>9.5f} {:>9.5f}\n", row.wavelength_nm, row.ks_max, row.kd_max, row.e_max,
               row.e_mean);
}

void run_limits(const TableArguments& arguments, Common& common) {
  Subject subject = make_subject(arguments.model, arguments.surface);
  if (arguments.ks) set_ks(subject, *arguments.ks);
  const SurfaceSamples samples = sample_surface(subject, arguments.at_nm);
  const std::vector<double> asked =
      arguments.angles.empty() ? limit_angles_deg() : number_list(arguments.angles, "--angles", 0, 89.99);
  std::vector<double> angles = limit_angles_deg();
  angles.insert(angles.end(), asked.begin(), asked.end());
  const Limits limits = conservation_limits(lobes_at(subject, samples.wavelength_nm), samples, angles);
  std::vector<LimitRow> rows;
  for (const double theta : asked)
    for (const LimitRow& row : limits.rows)
      if (row.theta_deg == theta) rows.push_back(row);
  const std::vector<SpectrumRow> spectrum = arguments.spectrum
                                                ? limits_spectrum(lobes_at(subject, samples.wavelength_nm), samples)
                                                : std::vector<SpectrumRow>();
  if (common.json) {
    Json json = limits_json(limits, subject, rows);
    if (arguments.spectrum) json["spectrum"] = spectrum_json(spectrum);
    std::cout << json.dump(2) << '\n';
  } else {
    print_limits(limits, subject, rows);
    if (arguments.spectrum) print_spectrum(spectrum);
  }
  common.exit_code = limits.holds() ? 0 : 1;
}

/// The families of which a model's isotropic lobe is made, whatever its width.
std::vector<FamilyLobe> families_of(const ModelArguments& model) {
  ModelArguments asked = model;
  const ModelInfo& info = gonio::model(model.model);
  for (const ParameterInfo& p : info.parameters)
    if (!p.fallback) asked.settings.push_back(fmt::format("{}={}", p.name, std::clamp(0.5, p.lo, p.hi)));
  const ChosenModel chosen = choose_model(asked);
  const std::vector<FamilyLobe> families = family_lobes(make_brdfs(chosen.sum, chosen.values).front().lobe);
  if (families.empty())
    throw input_error("{}: has no table; expected isotropic facets of one width, bounded at grazing", model.model);
  return families;
}

void run_table(const TableArguments& arguments) {
  if (arguments.model.model.empty() || arguments.out.empty())
    throw input_error(
        "gonio table: MODEL and --out are needed; expected `gonio table MODEL --out T.exr`, `gonio table all --out "
        "FOLDER`, `gonio table lookup MODEL` or `gonio table limits MODEL`");
  Progress progress("table");
  const auto show = [&](double done) { progress.show(done); };
  if (arguments.model.model == "all") {
    make_energy_tables(
        arguments.out, [](const std::string& line) { fmt::print(stderr, "{}\n", line); }, show);
    return;
  }
  const FamilyLobe lobe = families_of(arguments.model).front();
  WholeFile refused_before_the_work(arguments.out);
  write_energy_table(EnergyTable(*lobe.family, show), arguments.out);
  if (lobe.factor != 1)
    fmt::print(stderr, "{}: the table of {}, of which it is a multiple\n", arguments.model.model, lobe.family->name);
}

}  // namespace

void add_table(CLI::App& app, Common& common) {
  auto* command = app.add_subcommand("table", "Directional reflectance tables E(theta; m) and the limits of kd and ks");
  command->footer(
      "Example: gonio table torrance-sparrow --set shadowing=v-cavity --out E.exr\n"
      "         gonio table all --out out/tables\n"
      "         gonio table limits pseudo-realistic --set m=0.3 --material Au --at 550");
  add_common(*command, common);
  auto arguments = std::make_shared<TableArguments>();
  command->add_option("model", arguments->model.model,
                      "Model whose lobe is tabulated over the incidence and its width, for every material; or `all`");
  command->add_option("--set", arguments->model.settings, "shadowing=NAME")->allow_extra_args(false);
  command->add_option("-o,--out", arguments->out, "OpenEXR file to write (a CSV of E beside it); of `all` a folder");

  auto* limits =
      command->add_subcommand("limits", "ks_max, kd_max and E of a material or a fit; exit 1 when (43) is broken");
  limits->footer(
      "Example: gonio table limits torrance-sparrow --set m=0.2 --material Au --ks 0.9 --angles 0,45,80\n"
      "(43): kd rho_d + ks E <= 1 at every angle and wavelength. E is of ks = 1, ks_max the largest ks at kd = 0, "
      "kd_max\n"
      "the largest kd at the material's own ks. Of a sum E is of its lobes with their own ks, and ks_max the largest\n"
      "factor on all of them together. Where kd or ks differ between a fit's wavelengths, each must hold with its "
      "own.");
  add_common(*limits, common);
  auto asked = std::make_shared<TableArguments>();
  asked->model.add_to(*limits);
  asked->surface.add_to(*limits);
  limits->add_option("--ks", asked->ks, "ks for which kd_max is asked (default: the material's own); not for sums");
  limits->add_option("--at", asked->at_nm, "Wavelength in nm; without it the worst over the visible range of the data");
  limits->add_option("--angles", asked->angles, "Angles in degrees, 0 to 89.99, whose E is shown");
  limits->add_flag("--spectrum", asked->spectrum,
                   "ks_max, kd_max, the largest and the hemispherical mean E of each wavelength too");
  limits->callback([&common, asked] { run_limits(*asked, common); });
  add_table_instrument(*command, common);
  add_table_scatter(*command, common);
  add_table_lookup(*command, common);
  add_table_check(*command, common);
  command->callback([command, arguments] {
    if (command->get_subcommands().empty()) run_table(*arguments);
  });
}

}  // namespace gonio::cli
