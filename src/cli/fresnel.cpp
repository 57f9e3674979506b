#include <fmt/format.h>

#include <iostream>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "brdf/directions.h"
#include "cli/arguments.h"
#include "cli/commands.h"
#include "optics/absorption.h"

namespace gonio::cli {
namespace {

using Json = nlohmann::ordered_json;

struct FresnelArguments {
  std::string id, angles = "0,15,30,45,60,75,80,85,89,90";
  std::optional<double> n, k, at_nm, from, conductivity, permittivity;
};

/// n + ik relative to the incident medium, and where it comes from.
struct Index {
  double n, k;
  std::string name, source;
};

/// Up to here a medium counts as transparent (glasses have k of 1e-9 to 1e-5): T = 1 - R enters it.
constexpr double kTransparentK = 1e-4;

/// Of a medium known by its relative permittivity and its conductivity in S/m.
Index index_of_conductor(const FresnelArguments& arguments) {
  if (!arguments.id.empty() || arguments.n || arguments.k || arguments.from)
    throw input_error("--conductivity: given with an index; expected it with --at and --permittivity only");
  if (!arguments.at_nm) throw input_error("--conductivity: no wavelength; expected --at NM");
  const double permittivity = arguments.permittivity.value_or(1);
  if (!(*arguments.conductivity > 0 && *arguments.conductivity < 1e12))
    throw input_error("--conductivity {}: out of range; expected more than 0 S/m", *arguments.conductivity);
  if (!(*arguments.at_nm > 0 && *arguments.at_nm < 1e15) || !(std::abs(permittivity) < 1e6))
    throw input_error("--at {}, --permittivity {}: out of range; expected a wavelength above 0 and at most 1e6",
                      *arguments.at_nm, permittivity);
  const ComplexIndex<double> index = index_of_conductivity(permittivity, *arguments.conductivity, *arguments.at_nm);
  return {index.n, index.k, "", ""};
}

Index index_from(const FresnelArguments& arguments) {
  if (arguments.conductivity) return index_of_conductor(arguments);
  if (arguments.permittivity) throw input_error("--permittivity: given without --conductivity; expected both");
  if (arguments.id.empty()) {
    if (!arguments.n) throw input_error("gonio fresnel: no material; expected an ID with --at, or --n (and --k)");
    if (arguments.at_nm) throw input_error("--at: given with --n; expected it only with an ID");
    if (arguments.from) throw input_error("--from: given with --n; expected n, k relative to the incident medium");
    SurfaceArguments fixed;
    fixed.n = arguments.n;
    fixed.k = arguments.k;
    const Interface<double> surface = Surface(fixed).at(0);
    return {surface.n, surface.k, "", ""};
  }
  if (arguments.n || arguments.k) throw input_error("--n: given with the ID {}; expected one of the two", arguments.id);
  if (!arguments.at_nm) throw input_error("gonio fresnel {}: no wavelength; expected --at NM", arguments.id);
  const double from = arguments.from.value_or(1);
  if (!(from > 0 && from <= 1000)) throw input_error("--from {}: out of range; expected 0 < n <= 1000", from);
  const SurfaceMaterial material(arguments.id);
  if (material.is_perfect()) throw input_error("perfect: has no refractive index; expected a material of the database");
  const Interface<double> surface = material.at(*arguments.at_nm);
  return {surface.n / from, surface.k / from, material.id(),
          material.entry()->citation + (material.from_reflectance() ? " (F from reflectance: n from R0, k = 0)" : "")};
}

}  // namespace

void add_fresnel(CLI::App& app, Common& common) {
  auto* command = app.add_subcommand("fresnel", "Fresnel reflectances R_s, R_p, R (and T where k is below 1e-4)");
  command->footer("Example: gonio fresnel Au --at 550 --angles 0,30,60,85\n         gonio fresnel --n 1.5 --angles 56.31\n"
                  "         gonio fresnel --conductivity 5.96e7 --at 100000");
  add_common(*command, common);
  auto arguments = std::make_shared<FresnelArguments>();
  command->add_option("id", arguments->id, "Database id of the material");
  command->add_option("--n", arguments->n, "Refractive index relative to the incident medium (n < 1: total reflection)");
  command->add_option("--k", arguments->k, "Extinction coefficient relative to the incident medium");
  command->add_option("--from", arguments->from, "Refractive index of the incident medium, for an ID (default 1)");
  command->add_option("--at", arguments->at_nm, "Wavelength in nm, for an ID");
  command->add_option("--conductivity", arguments->conductivity,
                      "Conductivity in S/m, with --at: n and k of that medium instead");
  command->add_option("--permittivity", arguments->permittivity, "Its relative permittivity (default 1)");
  command->add_option("--angles", arguments->angles, "Angles of incidence in degrees, 0 to 90")->capture_default_str();
  command->callback([&common, arguments] {
    const std::vector<double> angles = number_list(arguments->angles, "--angles", 0, 90);
    const Index index = index_from(*arguments);
    const bool transparent = index.k <= kTransparentK;
    Json rows = Json::array();
    std::string text = fmt::format("{}n = {:.6g}, k = {:.6g}{}\n", index.name.empty() ? "" : index.name + ": ", index.n, index.k,
                                   arguments->at_nm ? fmt::format(" at {:g} nm", *arguments->at_nm) : "");
    if (!index.source.empty()) text += fmt::format("source: {}\n", index.source);
    text += fmt::format("{:>10} {:>12} {:>12} {:>12}{}\n", "theta_deg", "R_s", "R_p", "R", transparent ? "            T" : "");
    for (const double theta_deg : angles) {
      const Polarised<double> r = fresnel(cos_deg(theta_deg), index.n, index.k);
      const double mean = r.unpolarised();
      Json row{{"theta_deg", theta_deg}, {"R_s", r.s}, {"R_p", r.p}, {"R", mean}};
      if (transparent) row.update({{"T_s", 1 - r.s}, {"T_p", 1 - r.p}, {"T", 1 - mean}});
      rows.push_back(row);
      text += fmt::format("{:>10g} {:>12.8f} {:>12.8f} {:>12.8f}{}\n", theta_deg, r.s, r.p, mean,
                          transparent ? fmt::format(" {:>12.8f}", 1 - mean) : "");
    }
    if (common.json) {
      Json json{{"n", index.n}, {"k", index.k}, {"wavelength_nm", arguments->at_nm ? Json(*arguments->at_nm) : Json(nullptr)}};
      if (!index.name.empty()) json.update({{"id", index.name}, {"source", index.source}});
      json["rows"] = rows;
      std::cout << json.dump(2) << '\n';
    } else {
      std::cout << text;
    }
  });
}

}  // namespace gonio::cli
