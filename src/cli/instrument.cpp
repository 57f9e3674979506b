// gonio table instrument: what an instrument of any source and collector reports (8:di, 45:0, two cones, two hemispheres).
#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "cli/commands.h"
#include "cli/cone_axis.h"
#include "cli/subject.h"
#include "energy/instrument_geometry.h"

namespace gonio::cli {
namespace {

using Json = nlohmann::ordered_json;

struct InstrumentArguments {
  ModelArguments model;
  SurfaceArguments surface;
  std::optional<double> at_nm, stop_deg, source_stop_deg;
  std::string geometry, axis = "mirror";
  double theta_i_deg = 0, phi_i_deg = 0, source_half_angle_deg = 0, half_angle_deg = 0, tolerance = 1e-6;
};

InstrumentGeometry geometry_of(const InstrumentArguments& a) {
  if (!a.geometry.empty()) {
    if (a.stop_deg && a.geometry.find("de") == a.geometry.npos)
      throw input_error("--stop: {} has none; expected a geometry with de, or --theta-i and --axis", a.geometry);
    InstrumentApertures apertures{a.phi_i_deg, a.source_half_angle_deg, a.half_angle_deg};
    if (a.stop_deg) apertures.trap_half_angle_deg = *a.stop_deg;
    return instrument_geometry(a.geometry, apertures);
  }
  const Cone source{a.theta_i_deg, a.phi_i_deg, a.source_half_angle_deg},
      collector = cone_about(a.axis, a.theta_i_deg, a.half_angle_deg);
  InstrumentGeometry geometry{{source}, {collector}};
  if (a.stop_deg) geometry.collector.stop = mirror_cone({a.theta_i_deg, 0, 0}, *a.stop_deg);
  if (a.source_stop_deg) geometry.source.stop = mirror_cone(collector, *a.source_stop_deg, a.phi_i_deg);
  return geometry;
}

Json json_of(const Cone& cone) {
  return {{"theta_deg", cone.theta_deg}, {"phi_deg", cone.phi_deg}, {"half_angle_deg", cone.half_angle_deg}};
}
Json json_of(const Opening& opening, double projected_sr) {
  Json json = json_of(opening.cone);
  json["stop"] = opening.stop ? json_of(*opening.stop) : Json(nullptr);
  json["projected_solid_angle_sr"] = opening.is_direction() ? Json(nullptr) : Json(projected_sr);
  return json;
}

Json instrument_json(const InstrumentArguments& a, const InstrumentGeometry& g, const InstrumentReflectance& found,
                     double nm) {
  Json json{{"model", a.model.model},
            {"wavelength_nm", nm > 0 ? Json(nm) : Json(nullptr)},
            {"geometry", a.geometry.empty() ? Json(nullptr) : Json(a.geometry)},
            {"kind", nicodemus_name(g)},
            {"source", json_of(g.source, found.source_sr)},
            {"collector", json_of(g.collector, found.collector_sr)}};
  json["reflectance"] = found.reflectance ? Json(found.reflectance->value) : Json(nullptr);
  json["reflectance_error"] = found.reflectance ? Json(found.reflectance->error) : Json(nullptr);
  json["reflectance_factor"] = found.factor.value;
  json["reflectance_factor_error"] = found.factor.error;
  json["coherent_reflectance_factor"] = found.coherent_factor;
  json["converged"] = found.factor.converged;
  return json;
}

std::string described(const Opening& o, double projected_sr) {
  if (o.is_direction()) return fmt::format("the direction ({:g}, {:g}) degrees", o.cone.theta_deg, o.cone.phi_deg);
  std::string text = o.cone.theta_deg == 0 && o.cone.half_angle_deg == 90
                         ? "the hemisphere"
                         : fmt::format("a cone about ({:g}, {:g}) degrees, half angle {:g}", o.cone.theta_deg,
                                       o.cone.phi_deg, o.cone.half_angle_deg);
  if (o.stop)
    text += fmt::format(", less {:g} degrees about ({:g}, {:g})", o.stop->half_angle_deg, o.stop->theta_deg,
                        o.stop->phi_deg);
  return text + fmt::format("; projected {:.6g} sr", projected_sr);
}

void print_row(const char* title, const Estimate& e) {
  fmt::print("  {:<20} {:.9g} +- {:.1g}{}\n", title, e.value, e.error, e.converged ? "" : "  NOT CONVERGED");
}

void run_instrument(const InstrumentArguments& a, Common& common) {
  const Subject subject = make_subject(a.model, a.surface);
  const double nm = subject.wavelength_for(a.at_nm);
  const InstrumentGeometry geometry = geometry_of(a);
  const InstrumentReflectance found =
      instrument_reflectance(make_brdfs(subject.model.sum, subject.values_at(nm)), geometry, subject.surface.at(nm),
                             nm > 0 ? nm * 1e-3 : 1, a.tolerance);
  if (!found.factor.converged) common.exit_code = 1;
  if (common.json) {
    std::cout << instrument_json(a, geometry, found, nm).dump(2) << '\n';
    return;
  }
  fmt::print("{} on {}{}, {}{}\n", a.model.model, subject.surface.name(), nm > 0 ? fmt::format(" at {:g} nm", nm) : "",
             a.geometry.empty() ? "" : a.geometry + ", ", nicodemus_name(geometry));
  fmt::print("  {:<20} {}\n", "source", described(geometry.source, found.source_sr));
  fmt::print("  {:<20} {}\n", "collector", described(geometry.collector, found.collector_sr));
  if (found.reflectance) print_row("reflectance", *found.reflectance);
  print_row("reflectance factor", found.factor);
  if (found.coherent_factor > 0) fmt::print("  {:<20} {:.9g}\n", "of it coherent", found.coherent_factor);
}

void add_openings(CLI::App& command, InstrumentArguments& a) {
  auto* named = command.add_option("--geometry", a.geometry,
                                   "SOURCE:COLLECTOR, each an angle, 45a (annular, 40 to 50 degrees), d, h or di (the "
                                   "hemisphere), de (less the specular cone)");
  command.add_option("--theta-i", a.theta_i_deg, "The source's axis, degrees")
      ->check(CLI::Range(0.0, 90.0))
      ->excludes(named);
  command.add_option("--phi-i", a.phi_i_deg, "Its azimuth from the grain, degrees");
  command.add_option("--source-half-angle", a.source_half_angle_deg, "Of the source, degrees; 0: a direction")
      ->check(CLI::Range(0.0, 90.0))
      ->capture_default_str();
  command
      .add_option("--source-stop", a.source_stop_deg,
                  "Half angle about the mirror direction of --axis that does not shine, degrees")
      ->check(CLI::Range(1e-4, 90.0))
      ->excludes(named);
  command.add_option("--axis", a.axis, "The collector's axis: mirror, normal, or THETA,PHI (180 = mirror side)")
      ->capture_default_str()
      ->excludes(named);
  command.add_option("--half-angle", a.half_angle_deg, "Of the collector, degrees; 0: a direction")
      ->check(CLI::Range(0.0, 90.0))
      ->capture_default_str();
  command
      .add_option("--stop", a.stop_deg,
                  "Half angle about the mirror direction of the source's axis that is not collected, degrees; with "
                  "de what it leaves out (4)")
      ->check(CLI::Range(1e-4, 90.0));
}

}  // namespace

void add_table_instrument(CLI::App& table, Common& common) {
  auto* command = table.add_subcommand(
      "instrument", "What an instrument reports: reflectance and reflectance factor of any source and collector");
  command->footer(
      "Example: gonio table instrument ggx --set alpha=0.1 --material Au --at 550 --geometry 8:de\n"
      "         gonio table instrument ggx --set alpha=0.1 --geometry 45:0 --source-half-angle 2 --half-angle 5\n"
      "         gonio table instrument ggx --set alpha=0.1 --theta-i 30 --source-half-angle 3 --axis 35,170 "
      "--half-angle 6\n"
      "reflectance: the share of the light from a source of uniform radiance that is collected (Nicodemus et al. "
      "1977); none\n"
      "for a direction. reflectance factor: over a perfect diffuser in the same geometry. 8:di with the specular "
      "beam, 8:de\n"
      "without it, 45:0 between two directions where no half angle is given. Exit 1: an integral did not converge to "
      "--tolerance.");
  add_common(*command, common);
  auto a = std::make_shared<InstrumentArguments>();
  a->model.add_to(*command);
  a->surface.add_to(*command);
  command->add_option("--at", a->at_nm, "Wavelength in nm");
  add_openings(*command, *a);
  command
      ->add_option("--tolerance", a->tolerance, "Of the integrals, relative; narrow lobes between two cones take long")
      ->check(CLI::Range(1e-9, 0.1))
      ->capture_default_str();
  command->callback([&common, a] { run_instrument(*a, common); });
}

}  // namespace gonio::cli
