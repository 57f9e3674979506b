// gonio table lookup: E of a lobe on a material from the tables, without a quadrature.
#include <fmt/format.h>

#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "brdf/directions.h"
#include "cli/commands.h"
#include "cli/subject.h"
#include "energy/energy_file.h"
#include "energy/lobe_energy.h"

namespace gonio::cli {
namespace {

using Json = nlohmann::ordered_json;

struct LookupArguments {
  ModelArguments model;
  SurfaceArguments surface;
  std::optional<double> at_nm;
  std::string angles = "0,30,60,80,89";
  double phi_i_deg = 0;
};

/// E over the incidence, and where it comes from.
struct Found {
  std::string model, source;
  AzimuthalCurve curve;
  double error;
  bool bounded = true, delta = false;
};

/// The width that --set gives: alpha, or m (alpha = √2·m).
double asked_alpha(const LookupArguments& a, const EnergyTable& table) {
  if (a.model.settings.size() != 1)
    throw input_error("{}: its width is not given; expected --set alpha=0.3 or --set m=0.2", a.model.model);
  const std::string& text = a.model.settings.front();
  double alpha = 0;
  if (text.starts_with("alpha="))
    alpha = number_in(text.substr(6), "alpha");
  else if (text.starts_with("m="))
    alpha = std::sqrt(2) * number_in(text.substr(2), "m");
  else
    throw input_error("--set {}: unknown here; expected alpha=VALUE or m=VALUE", text);
  if (!(alpha >= kNarrowestAlpha && alpha <= table.grid().widest))
    throw input_error("alpha={:.6g}: outside the table; expected {} to {:.6g}", alpha, kNarrowestAlpha,
                      table.grid().widest);
  return alpha;
}

Found look_in_file(const LookupArguments& a, const Interface<double>& surface) {
  const EnergyTable table = read_energy_table(a.model.model);
  const double alpha = asked_alpha(a, table);
  const Lobe<double> lobe = table.family().lobe(alpha);
  const NodeValues r = reflectance_at_nodes(lobe, surface);
  return {fmt::format("{}, alpha = {:g}", table.family().name, alpha), a.model.model,
          AzimuthalCurve(table.curve(alpha, r)), EnergyTable::kError + node_error(lobe, surface, r)};
}

Found look_up(const LookupArguments& a, const Interface<double>& surface) {
  if (a.model.model.ends_with(".exr")) return look_in_file(a, surface);
  const ChosenModel model = choose_model(a.model);
  if (model.sum.is_sum()) throw input_error("{}: is a sum; expected one lobe", a.model.model);
  const Brdf<double> brdf = make_brdfs(model.sum, model.values).front();
  const double um = a.at_nm.value_or(550) * 1e-3;
  if (model.sum.needs_wavelength() && !a.at_nm)
    throw input_error("{}: needs a wavelength; expected --at NM", a.model.model);
  const LobeEnergy energy(brdf.lobe, {{surface}, {um}});
  return {a.model.model,
          energy.from_table() ? "tables" : "quadrature",
          energy.at(0),
          energy.error(),
          !unbounded_at_grazing(brdf.lobe),
          has_delta(brdf.lobe)};
}

void run(const LookupArguments& a, const Common& common) {
  const Surface surface(a.surface);
  if (surface.needs_wavelength() && !a.at_nm)
    throw input_error("{}: needs a wavelength; expected --at NM", surface.name());
  const Found found = look_up(a, surface.at(a.at_nm.value_or(0)));
  Json rows = Json::array();
  const double cos_2phi = std::cos(2 * a.phi_i_deg * kPi<double> / 180);
  for (const double theta : number_list(a.angles, "--angles", 0, 90)) {
    if (!found.bounded && theta > LobeEnergy::kUnboundedTo_deg)
      throw input_error(
          "--angles {:g}: E of {} grows without bound next to grazing; expected at most {:g} here, or `table limits`",
          theta, found.model, LobeEnergy::kUnboundedTo_deg);
    rows.push_back({{"theta_deg", theta}, {"E", found.curve(cos_deg(theta), cos_2phi)}, {"error", found.error}});
  }
  const auto largest = found.curve.largest();
  const double largest_deg = std::acos(largest.cos_theta) * 180 / kPi<double>;
  if (common.json) {
    std::cout << Json{{"model", found.model},
                      {"material", surface.name()},
                      {"source", found.source},
                      {"E", rows},
                      {"E_mean", found.bounded ? Json(found.curve.mean()) : Json(nullptr)},
                      {"E_max", {{"theta_deg", largest_deg}, {"E", largest.value}}},
                      {"error", found.error}}
                     .dump(2)
              << '\n';
    return;
  }
  fmt::print("{} on {}, from {}\n{:>10} {:>12}   (within {:.2g})\n", found.model, surface.name(), found.source,
             "theta_deg", "E (ks = 1)", found.error);
  for (const Json& row : rows)
    fmt::print("{:>10g} {:>12.6f}\n", row["theta_deg"].get<double>(), row["E"].get<double>());
  if (found.curve.has_grain())
    fmt::print("light from {:g} degrees to the grain; the mean is over all azimuths\n", a.phi_i_deg);
  if (found.delta) fmt::print("the delta in the mirror direction is not in E\n");
  fmt::print(
      "{}largest {:.6f} at {:.4g} degrees{}\n",
      found.bounded ? fmt::format("hemispherical mean {:.6f}; ", found.curve.mean()) : "", largest.value, largest_deg,
      found.bounded ? "" : fmt::format(" (looked for to {:g}: it grows without bound)", LobeEnergy::kUnboundedTo_deg));
}

}  // namespace

void add_table_lookup(CLI::App& table, Common& common) {
  auto* command =
      table.add_subcommand("lookup", "E of a lobe on a material from the tables, its mean and largest value");
  command->alias("nodes");
  command->footer(
      "Example: gonio table lookup torrance-sparrow --set m=0.2 --material Au --at 550 --angles 0,45,80\n"
      "         gonio table lookup E.exr --set alpha=0.3 --n 1.5\n"
      "One table serves every material: E = sum of W_i(theta, alpha) R(u_i) over 20 fixed cosines. Lobes without a "
      "table "
      "are\nintegrated at 68 angles.");
  add_common(*command, common);
  auto a = std::make_shared<LookupArguments>();
  a->model.add_to(*command);
  a->surface.add_to(*command);
  command->add_option("--at", a->at_nm, "Wavelength in nm");
  command->add_option("--phi-i", a->phi_i_deg, "Azimuth of the light from the grain, degrees")->capture_default_str();
  command->add_option("--angles", a->angles, "Angles in degrees, 0 to 90")->capture_default_str();
  command->callback([&common, a] { run(*a, common); });
}

}  // namespace gonio::cli
