#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files.h"
#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/eval_row.h"

namespace gonio::cli {
namespace {

using Json = nlohmann::ordered_json;

struct EvalArguments {
  ModelArguments model;
  SurfaceArguments surface;
  std::optional<double> at_nm;
  std::string input = "-", polarisation;
  EvalRequest request;
};

/// m11 as it is, the others divided by it (the convention of files); empty where f is 0 and says nothing.
std::vector<std::string> mueller_cells(const Mueller<double>& mueller) {
  const double m11 = mueller.m[0][0];
  std::vector<std::string> cells;
  for (const auto& row : mueller.m)
    for (const double element : row) cells.push_back(m11 > 0 ? fmt::format("{}", element / m11 + 0.0) : "");
  cells[0] = fmt::format("{}", m11);
  return cells;
}

std::string mueller_names(char separator) {
  std::string names;
  for (int row = 1; row <= 4; ++row)
    for (int column = 1; column <= 4; ++column) names += fmt::format("{}m{}{}", separator, row, column);
  return names;
}

void add_mueller(Json& json, const Mueller<double>& mueller) {
  const double m11 = mueller.m[0][0];
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      json[fmt::format("m{}{}", row + 1, column + 1)] =
          m11 > 0 ? Json(mueller.m[row][column] / m11 + 0.0) : Json(nullptr);
  json["m11"] = m11;
}

void run_eval(const EvalArguments& arguments, const Common& common) {
  EvalRequest request = arguments.request;
  if (!arguments.polarisation.empty()) {
    if (request.mueller) throw input_error("--mueller and --polarisation: both given; expected one of the two");
    request.light = linear_light(arguments.polarisation);
  }
  const Subject subject = make_subject(arguments.model, arguments.surface);
  const bool from_stdin = arguments.input == "-";
  const std::string file = from_stdin ? "stdin" : arguments.input;
  const std::string text =
      from_stdin ? std::string(std::istreambuf_iterator<char>(std::cin), {}) : read_file(arguments.input);
  const CsvTable table = read_csv(text, file);
  const std::vector<Brdf<double>> lobes = make_brdfs(subject.model.sum, subject.model.values);
  const std::vector<EvalRow> rows = eval_rows(table, file, lobes.size() == 1 && transmits(lobes[0]));

  Json json_rows = Json::array();
  std::string out =
      fmt::format("{},f_r_per_sr{}\n", fmt::join(table.header, ","), request.mueller ? mueller_names(',') : "");
  const bool delta = std::any_of(lobes.begin(), lobes.end(), [](const auto& one) { return has_delta(one.lobe); });
  for (const EvalRow& row : rows) {
    const double wavelength_nm = subject.wavelength_for(row.wavelength_nm ? row.wavelength_nm : arguments.at_nm);
    const EvalResult result = evaluate_row(subject, row, wavelength_nm, request);
    out += fmt::format("{},{}", fmt::join(row.row->cells, ","), result.f_r_per_sr);
    if (result.mueller) out += fmt::format(",{}", fmt::join(mueller_cells(*result.mueller), ","));
    out += '\n';
    Json one{{"theta_i_deg", row.theta_i_deg}, {"theta_o_deg", row.theta_o_deg}, {"phi_deg", row.phi_deg}};
    if (wavelength_nm > 0) one["wavelength_nm"] = wavelength_nm;
    one["f_r_per_sr"] = result.f_r_per_sr;
    if (row.transmitted()) one["transmitted"] = true;
    if (result.mueller) add_mueller(one, *result.mueller);
    if (delta) one["coherent_energy"] = result.coherent_energy;
    json_rows.push_back(one);
  }
  if (common.json) {
    Json answer{{"model", subject.model.sum.name()},
                {"variant", subject.model.sum.variant()},
                {"material", subject.surface.name()},
                {"precision", request.precision}};
    if (request.light) answer["polarisation"] = arguments.polarisation;
    answer["rows"] = json_rows;
    std::cout << answer.dump(2) << '\n';
  } else {
    std::cout << out;
  }
  if (subject.surface.material().from_reflectance()) std::cerr << "note: F from reflectance (n from R0, k = 0)\n";
}

}  // namespace

void add_eval(CLI::App& app, Common& common) {
  auto* command =
      app.add_subcommand("eval", "Evaluate a model or a fit: rows of angles in, the same rows + f_r_per_sr out");
  command->footer(
      "Example: printf 'theta_i_deg,theta_o_deg,phi_deg\\n30,40,180\\n' | gonio eval torrance-sparrow --set m=0.2 "
      "--material Au --at 550\nColumns: theta_i_deg, theta_o_deg (or theta_r_deg), phi_deg = phi_o - phi_i (180: "
      "mirror "
      "side)[, phi_i_deg from the grain, for anisotropic lobes][, wavelength_nm];\nor unit vectors towards light and "
      "eye, ix,iy,iz,ox,oy,oz (z: normal).\nf_r is a BRDF in 1/sr, without cosine. Without --material the surface is "
      "`perfect`.\n"
      "A sum of up to three lobes over one diffuse part: gonio eval ggx+phong-1975 --set alpha_1=0.3 --set n_2=40 "
      "--set "
      "kd=0.1 --set ks_2=0.5.\n"
      "rough-dielectric: with theta_o_deg above 90, up to 180, it is f_t of the transmitted radiance; n is that of the "
      "far over the near side.\n"
      "Polarised light: s = k x n, p = k x s for the propagation direction k and the mean normal n; --polarisation "
      "gives f_r of linearly\n"
      "polarised light at an angle from s towards p, received in any polarisation; --mueller appends m11 (= f_r) and "
      "m12 .. m44, divided\n"
      "by m11, of Stokes vectors I, Q = s - p, U = +45 - -45, V = right - left. Faceted models and diffuse parts "
      "(depolarising) only.");
  add_common(*command, common);
  auto arguments = std::make_shared<EvalArguments>();
  arguments->model.add_to(*command);
  arguments->surface.add_to(*command);
  command->add_option("--at", arguments->at_nm, "Wavelength in nm, where the rows have none");
  command->add_option("--precision", arguments->request.precision, "float (SIMD), double or reference (50 digits)")
      ->check(CLI::IsMember({"float", "double", "reference"}))
      ->capture_default_str();
  command->add_option("--polarisation", arguments->polarisation,
                      "Incident linear polarisation: s, p or degrees from s towards p");
  command->add_flag("--mueller", arguments->request.mueller, "The whole Mueller matrix: columns m11 .. m44");
  command->add_option("--input", arguments->input, "CSV file, - for standard input")->capture_default_str();
  command->callback([&common, arguments] { run_eval(*arguments, common); });
}

}  // namespace gonio::cli
