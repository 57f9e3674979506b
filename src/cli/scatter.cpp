// gonio table scatter: the light that a collector of any aperture receives, with a hole for the specular beam.
#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/cone_axis.h"
#include "cli/subject.h"
#include "energy/cone_reflectance.h"

namespace gonio::cli {
namespace {

using Json = nlohmann::ordered_json;

struct ScatterArguments {
  ModelArguments model;
  SurfaceArguments surface;
  std::optional<double> at_nm, stop_deg;
  std::string axis = "mirror";
  double theta_i_deg = 0, half_angle_deg = 90, phi_i_deg = 0;
};

struct Scatter {
  ConeReflectance cone, hemisphere;

  /// What reaches the cone of what leaves the surface: with the hemisphere less a stop, the total integrated scatter.
  double share() const { return hemisphere.total.value > 0 ? cone.total.value / hemisphere.total.value : 0; }
  bool converged() const { return cone.total.converged && hemisphere.total.converged; }
};

Json json_of(const ConeReflectance& r) {
  return {{"reflectance", r.total.value},
          {"error", r.total.error},
          {"converged", r.total.converged},
          {"coherent", r.coherent}};
}

Json scatter_json(const ScatterArguments& a, const Cone& cone, const Scatter& found, double nm) {
  Json json{
      {"model", a.model.model}, {"theta_i_deg", a.theta_i_deg}, {"wavelength_nm", nm > 0 ? Json(nm) : Json(nullptr)}};
  json["cone"] = {{"theta_deg", cone.theta_deg}, {"phi_deg", cone.phi_deg}, {"half_angle_deg", cone.half_angle_deg}};
  json["stop_half_angle_deg"] = a.stop_deg ? Json(*a.stop_deg) : Json(nullptr);
  json.update(json_of(found.cone));
  json["hemisphere"] = json_of(found.hemisphere);
  json["share"] = found.share();
  return json;
}

void print_row(const char* title, const ConeReflectance& r) {
  fmt::print("  {:<22} {:.9g} +- {:.1g}{}{}\n", title, r.total.value, r.total.error,
             r.coherent > 0 ? fmt::format("  (coherent {:.6g})", r.coherent) : "",
             r.total.converged ? "" : "  NOT CONVERGED");
}

void run_scatter(const ScatterArguments& a, Common& common) {
  const Subject subject = make_subject(a.model, a.surface);
  const double nm = subject.wavelength_for(a.at_nm);
  const std::vector<Brdf<double>> lobes = make_brdfs(subject.model.sum, subject.values_at(nm));
  const Interface<double> surface = subject.surface.at(nm);
  const double um = nm > 0 ? nm * 1e-3 : 1;
  const Cone cone = cone_about(a.axis, a.theta_i_deg, a.half_angle_deg);
  const std::optional<Cone> stop = a.stop_deg ? std::optional(Cone{a.theta_i_deg, 180, *a.stop_deg}) : std::nullopt;
  constexpr double kTolerance = 1e-6;
  const Scatter found{
      cone_reflectance(lobes, a.theta_i_deg, surface, um, cone, stop, kTolerance, a.phi_i_deg),
      cone_reflectance(lobes, a.theta_i_deg, surface, um, kHemisphere, std::nullopt, kTolerance, a.phi_i_deg)};
  if (!found.converged()) common.exit_code = 1;
  if (common.json) {
    std::cout << scatter_json(a, cone, found, nm).dump(2) << '\n';
    return;
  }
  fmt::print("{} on {}{}, light from {:g} degrees\n", a.model.model, subject.surface.name(),
             nm > 0 ? fmt::format(" at {:g} nm", nm) : "", a.theta_i_deg);
  fmt::print("  cone about ({:g}, {:g}) degrees, half angle {:g}{}\n", cone.theta_deg, cone.phi_deg,
             cone.half_angle_deg,
             stop ? fmt::format(", less {:g} degrees about the mirror direction", stop->half_angle_deg) : "");
  print_row("reflectance", found.cone);
  print_row("of the hemisphere", found.hemisphere);
  fmt::print("  {:<22} {:.9g}\n", "share", found.share());
}

}  // namespace

void add_table_scatter(CLI::App& table, Common& common) {
  auto* command = table.add_subcommand(
      "scatter", "The share of the light that reaches a cone (an integrating sphere, a lens), less a specular stop");
  command->footer(
      "Example: gonio table scatter he-1991 --set sigma0_um=0.02 --set correlation_um=3 --material Al --at 633 "
      "--theta-i 8 \\\n"
      "           --axis normal --half-angle 90 --stop 2\n"
      "share: over what the whole hemisphere receives; with --axis normal and --stop the total integrated scatter. "
      "Exit 1: an\n"
      "integral did not converge to 1e-6 of its value.");
  add_common(*command, common);
  auto a = std::make_shared<ScatterArguments>();
  a->model.add_to(*command);
  a->surface.add_to(*command);
  command->add_option("--at", a->at_nm, "Wavelength in nm");
  command->add_option("--theta-i", a->theta_i_deg, "Where the light comes from, degrees")
      ->check(CLI::Range(0.0, 89.99));
  command->add_option("--phi-i", a->phi_i_deg, "Its azimuth from the grain, degrees");
  command->add_option("--axis", a->axis, "The cone's axis: mirror, normal, or THETA,PHI (180 = mirror side)")
      ->capture_default_str();
  command->add_option("--half-angle", a->half_angle_deg, "Of the cone, degrees")
      ->check(CLI::Range(1e-4, 90.0))
      ->capture_default_str();
  command->add_option("--stop", a->stop_deg, "Half angle about the mirror direction that is left out, degrees")
      ->check(CLI::Range(1e-4, 90.0));
  command->callback([&common, a] { run_scatter(*a, common); });
}

}  // namespace gonio::cli
