#include <fmt/format.h>

#include <iostream>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "brdf/directions.h"
#include "cli/arguments.h"
#include "cli/commands.h"
#include "optics/absorption.h"
#include "optics/smooth_dielectric.h"

namespace gonio::cli {
namespace {

using Json = nlohmann::ordered_json;

struct FresnelArguments {
  std::string id, angles = "0,15,30,45,60,75,80,85,89,90", wavelengths;
  std::optional<double> n, k, at_nm, from, conductivity, permittivity, thickness_um;
};

/// n + ik relative to the incident medium, its k relative to vacuum, and where it comes from.
struct Index {
  double n, k, k_in_vacuum;
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
  return {index.n, index.k, index.k, "", ""};
}

Index index_from(const FresnelArguments& arguments) {
  if (arguments.conductivity) return index_of_conductor(arguments);
  if (arguments.permittivity) throw input_error("--permittivity: given without --conductivity; expected both");
  if (arguments.id.empty()) {
    if (!arguments.n) throw input_error("gonio fresnel: no material; expected an ID with --at, or --n (and --k)");
    if (arguments.at_nm && !arguments.thickness_um)
      throw input_error("--at: given with --n; expected it only with an ID");
    if (arguments.from) throw input_error("--from: given with --n; expected n, k relative to the incident medium");
    SurfaceArguments fixed;
    fixed.n = arguments.n;
    fixed.k = arguments.k;
    const Interface<double> surface = Surface(fixed).at(0);
    return {surface.n, surface.k, surface.k, "", ""};
  }
  if (arguments.n || arguments.k) throw input_error("--n: given with the ID {}; expected one of the two", arguments.id);
  if (!arguments.at_nm) throw input_error("gonio fresnel {}: no wavelength; expected --at NM", arguments.id);
  const double from = arguments.from.value_or(1);
  if (!(from > 0 && from <= 1000)) throw input_error("--from {}: out of range; expected 0 < n <= 1000", from);
  const SurfaceMaterial material(arguments.id);
  if (material.is_perfect()) throw input_error("perfect: has no refractive index; expected a material of the database");
  const Interface<double> surface = material.at(*arguments.at_nm);
  return {surface.n / from, surface.k / from, surface.k, material.id(),
          material.entry()->citation + (material.from_reflectance() ? " (F from reflectance: n from R0, k = 0)" : "")};
}

/// A slab's check: what slab_shares() holds for.
void check_slab(const FresnelArguments& arguments, const Index& index) {
  if (!(*arguments.thickness_um > 0 && *arguments.thickness_um <= 1e9))
    throw input_error("--thickness-um {}: out of range; expected 0 to 1e9 um", *arguments.thickness_um);
  if (index.k > kTransparentK)
    throw input_error(
        "--thickness-um: the slab absorbs too strongly for its faces to count as dielectric (k = {}); expected k up to "
        "{}",
        index.k, kTransparentK);
  if (!arguments.at_nm && index.k > 0)
    throw input_error("--thickness-um: absorption needs the wavelength; expected --at NM");
}

/// Of an interface: reflected, and entering where it is transparent; of a slab: out of its front, out of its back.
struct Shares {
  Polarised<double> reflected, transmitted;
};

Shares shares_at(const FresnelArguments& arguments, const Index& index, double theta_deg) {
  const double c = cos_deg(theta_deg);
  if (arguments.thickness_um) {
    const auto slab =
        slab_shares(c, index.n, index.k_in_vacuum, *arguments.thickness_um, arguments.at_nm.value_or(550) / 1000);
    return {slab.reflected, slab.transmitted};
  }
  const Polarised<double> r = fresnel(c, index.n, index.k);
  return {r, {1 - r.s, 1 - r.p}};
}

/// The table of one wavelength, as JSON rows and as text.
struct FresnelTable {
  Index index;
  Json rows = Json::array();
  std::string text;
};

FresnelTable table_at(const FresnelArguments& arguments, const std::vector<double>& angles, bool with_source) {
  FresnelTable table{index_from(arguments), Json::array(), {}};
  const Index& index = table.index;
  const bool slab = arguments.thickness_um.has_value();
  if (slab) check_slab(arguments, index);
  const bool transparent = index.k <= kTransparentK;
  table.text = fmt::format("{}n = {:.6g}, k = {:.6g}{}\n", index.name.empty() ? "" : index.name + ": ", index.n,
                           index.k, arguments.at_nm ? fmt::format(" at {:g} nm", *arguments.at_nm) : "");
  if (with_source && !index.source.empty()) table.text += fmt::format("source: {}\n", index.source);
  table.text += fmt::format("{:>10} {:>12} {:>12} {:>12}{}{}\n", "theta_deg", "R_s", "R_p", "R",
                            slab ? "          T_s          T_p" : "", transparent ? "            T" : "");
  for (const double theta_deg : angles) {
    const auto [r, t] = shares_at(arguments, index, theta_deg);
    Json row{{"theta_deg", theta_deg}, {"R_s", r.s}, {"R_p", r.p}, {"R", r.unpolarised()}};
    if (transparent) row.update({{"T_s", t.s}, {"T_p", t.p}, {"T", slab ? t.unpolarised() : 1 - r.unpolarised()}});
    table.rows.push_back(row);
    table.text += fmt::format("{:>10g} {:>12.8f} {:>12.8f} {:>12.8f}{}{}\n", theta_deg, r.s, r.p, r.unpolarised(),
                              slab ? fmt::format(" {:>12.8f} {:>12.8f}", t.s, t.p) : "",
                              transparent ? fmt::format(" {:>12.8f}", row["T"].get<double>()) : "");
  }
  return table;
}

void run_fresnel(FresnelArguments arguments, bool json) {
  const std::vector<double> angles = number_list(arguments.angles, "--angles", 0, 90);
  const bool many = !arguments.wavelengths.empty();
  if (many && arguments.at_nm) throw input_error("--wavelengths and --at: both given; expected one of the two");
  if (many && arguments.id.empty())
    throw input_error("--wavelengths: given without an ID; expected a material of the database");
  std::vector<std::optional<double>> wavelengths{arguments.at_nm};
  if (many) {
    wavelengths.clear();
    for (const double nm : number_list(arguments.wavelengths, "--wavelengths", 1e-3, 1e9)) wavelengths.emplace_back(nm);
  }
  Json answer, by_wavelength = Json::array();
  std::string text;
  for (const auto& nm : wavelengths) {
    arguments.at_nm = nm;
    const FresnelTable table = table_at(arguments, angles, text.empty());
    Json one{{"n", table.index.n}, {"k", table.index.k}, {"wavelength_nm", nm ? Json(*nm) : Json(nullptr)}};
    if (!many && !table.index.name.empty()) one.update({{"id", table.index.name}, {"source", table.index.source}});
    if (!many && arguments.thickness_um) one["thickness_um"] = *arguments.thickness_um;
    one["rows"] = table.rows;
    if (many && answer.empty()) answer = {{"id", table.index.name}, {"source", table.index.source}};
    text += table.text;
    if (many)
      by_wavelength.push_back(one);
    else
      answer = one;
  }
  if (many && arguments.thickness_um) answer["thickness_um"] = *arguments.thickness_um;
  if (many) answer["wavelengths"] = by_wavelength;
  if (arguments.thickness_um)
    text = fmt::format("slab of {:g} um, faces and passes summed as intensities (thicker than the coherence length)\n",
                       *arguments.thickness_um) +
           text;
  std::cout << (json ? answer.dump(2) + '\n' : text);
}

}  // namespace

void add_fresnel(CLI::App& app, Common& common) {
  auto* command = app.add_subcommand("fresnel", "Fresnel reflectances R_s, R_p, R (and T where k is below 1e-4)");
  command->footer(
      "Example: gonio fresnel Au --at 550 --angles 0,30,60,85\n         gonio fresnel --n 1.5 --angles 56.31\n"
      "         gonio fresnel --conductivity 5.96e7 --at 100000\n"
      "         gonio fresnel BK7 --thickness-um 10000 --wavelengths 400,550,700 --angles 0,45   (a slab of glass)");
  add_common(*command, common);
  auto arguments = std::make_shared<FresnelArguments>();
  command->add_option("id", arguments->id, "Database id of the material");
  command->add_option("--n", arguments->n,
                      "Refractive index relative to the incident medium (n < 1: total reflection)");
  command->add_option("--k", arguments->k, "Extinction coefficient relative to the incident medium");
  command->add_option("--from", arguments->from, "Refractive index of the incident medium, for an ID (default 1)");
  command->add_option("--at", arguments->at_nm, "Wavelength in nm, for an ID");
  command->add_option("--conductivity", arguments->conductivity,
                      "Conductivity in S/m, with --at: n and k of that medium instead");
  command->add_option("--permittivity", arguments->permittivity, "Its relative permittivity (default 1)");
  command->add_option("--angles", arguments->angles, "Angles of incidence in degrees, 0 to 90")->capture_default_str();
  command->add_option("--thickness-um", arguments->thickness_um,
                      "R and T of a plane-parallel slab of this thickness, absorption inside included (k up to 1e-4)");
  command->add_option("--wavelengths", arguments->wavelengths,
                      "Several wavelengths in nm, 400,500,600, for an ID (instead of --at)");
  command->callback([&common, arguments] { run_fresnel(*arguments, common.json); });
}

}  // namespace gonio::cli
