#include <fmt/format.h>

#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "cli/commands.h"
#include "cli/subject.h"
#include "energy/limits_json.h"
#include "energy/table.h"

namespace gonio::cli {
namespace {

using Json = nlohmann::ordered_json;

struct TableArguments {
  ModelArguments model;
  SurfaceArguments surface;
  std::string out, angles;
  std::optional<double> at_nm, ks;
};

Json limits_json(Limits limits, const Subject& subject, const std::vector<LimitRow>& rows) {
  limits.rows = rows;
  Json json{{"model", subject.model.spec.info().name}, {"material", subject.surface.name()}};
  json.update(to_json(limits));
  return json;
}

void print_limits(const Limits& limits, const Subject& subject, const std::vector<LimitRow>& rows) {
  const Brdf<double> brdf = make_brdf<double>(subject.model.spec, subject.model.values);
  const bool spectral = limits.range_lo_nm > 0;
  fmt::print("{} on {}{}\n", subject.model.spec.info().name, subject.surface.name(),
             !spectral ? "" : limits.range_lo_nm == limits.range_hi_nm
                                  ? fmt::format(" at {:g} nm", limits.range_lo_nm)
                                  : fmt::format(", {:g}-{:g} nm (worst wavelength at each angle)", limits.range_lo_nm, limits.range_hi_nm));
  fmt::print("{:>10} {:>12} {:>10}{}\n", "theta_deg", "E (ks = 1)", "error", spectral ? "  wavelength_nm" : "");
  for (const LimitRow& row : rows)
    fmt::print("{:>10g} {:>12.8f} {:>10.1e}{}{}\n", row.theta_deg, row.e.value, row.e.error,
               spectral ? fmt::format(" {:>14g}", row.wavelength_nm) : "",
               row.coherent > 0 ? fmt::format("  + coherent {:.6f}", row.coherent) : "");
  if (!limits.bounded)
    fmt::print("not conserving beyond {:g} deg: this lobe is unbounded at grazing; the limits hold up to there\n", limits.theta_max_deg);
  fmt::print("ks_max = {:.6f} (kd = 0)\nkd_max = {:.6f} (ks = {:g})\n", limits.ks_max, limits.kd_max, brdf.ks);
  fmt::print("kd = {:g}, ks = {:g}: largest kd rho_d + ks E = {:.6f} at {:g} deg; (43) {}\n", brdf.kd, brdf.ks, limits.worst_total,
             limits.worst_theta_deg, limits.worst_total > 1 + limits.worst_error ? fmt::format("is broken by {:.4g}", limits.worst_total - 1)
                                     : limits.bounded ? "holds" : "holds up to there");
}

void run_limits(const TableArguments& arguments, Common& common) {
  Subject subject = make_subject(arguments.model, arguments.surface);
  if (arguments.ks) {
    if (subject.model.spec.id == ModelId::lambert) throw input_error("--ks: lambert has no lobe; expected kd only");
    subject.model.values.back() = *arguments.ks;
    check_values(subject.model.spec, subject.model.values);
  }
  const SurfaceSamples samples = sample_surface(subject, arguments.at_nm);
  const std::vector<double> asked =
      arguments.angles.empty() ? limit_angles_deg() : number_list(arguments.angles, "--angles", 0, 89.99);
  std::vector<double> angles = limit_angles_deg();
  angles.insert(angles.end(), asked.begin(), asked.end());
  const Brdf<double> brdf = make_brdf<double>(subject.model.spec, subject.model.values);
  const Limits limits = conservation_limits(brdf, samples, angles);
  std::vector<LimitRow> rows;
  for (const double theta : asked)
    for (const LimitRow& row : limits.rows)
      if (row.theta_deg == theta) rows.push_back(row);
  if (common.json) std::cout << limits_json(limits, subject, rows).dump(2) << '\n';
  else print_limits(limits, subject, rows);
  common.exit_code = limits.holds() ? 0 : 1;
}

void run_table(const TableArguments& arguments) {
  if (arguments.model.model.empty() || arguments.out.empty())
    throw input_error("gonio table: MODEL and --out are needed; expected `gonio table MODEL --out T.exr` or `gonio table limits MODEL`");
  ModelSpec spec;
  spec.id = model(arguments.model.model).id;
  for (const std::string& setting : arguments.model.settings) {
    if (!setting.starts_with("shadowing="))
      throw input_error("--set {}: a table runs over the roughness; expected only shadowing=NAME", setting);
    set_shadowing(spec, setting.substr(10));
  }
  write_reflectance_table(make_reflectance_table(spec), arguments.out);
}

}  // namespace

void add_table(CLI::App& app, Common& common) {
  auto* command = app.add_subcommand("table", "Directional reflectance tables E(theta; m) and the limits of kd and ks");
  command->footer("Example: gonio table torrance-sparrow --set shadowing=v-cavity --out E.exr\n"
                  "         gonio table limits pseudo-realistic --set m=0.3 --material Au --at 550");
  add_common(*command, common);
  auto arguments = std::make_shared<TableArguments>();
  command->add_option("model", arguments->model.model, "Model name");
  command->add_option("--set", arguments->model.settings, "shadowing=NAME")->allow_extra_args(false);
  command->add_option("-o,--out", arguments->out, "OpenEXR file to write (a CSV of the same name beside it)");

  auto* limits = command->add_subcommand("limits", "ks_max, kd_max and E of a material or a fit; exit 1 when (43) is broken");
  limits->footer("Example: gonio table limits torrance-sparrow --set m=0.2 --material Au --ks 0.9 --angles 0,45,80");
  add_common(*limits, common);
  auto asked = std::make_shared<TableArguments>();
  asked->model.add_to(*limits);
  asked->surface.add_to(*limits);
  limits->add_option("--ks", asked->ks, "ks for which kd_max is asked (default: the material's own)");
  limits->add_option("--at", asked->at_nm, "Wavelength in nm; without it the worst over the visible range of the data");
  limits->add_option("--angles", asked->angles, "Angles in degrees, 0 to 89.99, whose E is shown");
  limits->callback([&common, asked] { run_limits(*asked, common); });
  command->callback([command, limits, arguments] {
    if (!command->got_subcommand(limits)) run_table(*arguments);
  });
}

}  // namespace gonio::cli
