#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files.h"
#include "brdf/lanes.h"
#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/subject.h"
#include "fit/csv.h"
#include "reference/reference.h"

namespace gonio::cli {
namespace {

using Json = nlohmann::ordered_json;

struct EvalArguments {
  ModelArguments model;
  SurfaceArguments surface;
  std::optional<double> at_nm;
  std::string precision = "double", input = "-";
};

/// Unit vectors towards light and eye.
struct VectorPair {
  UnitVector<double> i, o;
};

/// One row of the input: angles in degrees, and the wavelength where a column gives it.
struct EvalRow {
  double theta_i_deg, theta_o_deg, phi_deg;
  std::optional<double> wavelength_nm;
  double phi_i_deg;  ///< from the grain; what anisotropic lobes look at
  const CsvRow* row;
  std::optional<VectorPair> vectors = std::nullopt;  ///< in place of the angles, where the columns are components
};

/// The column under any of its names; -1 where optional and absent.
int column(const CsvTable& table, std::initializer_list<std::string_view> names, const std::string& file, bool required = true) {
  for (std::size_t c = 0; c < table.header.size(); ++c)
    for (const auto name : names)
      if (table.header[c] == name) return static_cast<int>(c);
  if (required) throw input_error("{}:{}: column {} is missing; expected theta_i_deg,theta_o_deg,phi_deg[,wavelength_nm]", file,
                                  table.header_line, *names.begin());
  return -1;
}

double zenith(std::string_view cell, std::string_view name, const std::string& file, int line) {
  const double value = csv_number(cell, name, file, line);
  if (!(value >= 0 && value < 90)) throw input_error("{}:{}: {} is {}; expected 0 <= angle < 90", file, line, name, value);
  return value;
}

/// A row of components: z > 0, and unit length to float's rounding. They are used as they are; the angles are for the report.
EvalRow vector_row(const std::array<int, 6>& columns, const CsvRow& row, const std::string& file) {
  constexpr std::array kNames{"ix", "iy", "iz", "ox", "oy", "oz"};
  std::array<double, 6> v;
  for (std::size_t c = 0; c < 6; ++c) v[c] = csv_number(row.cells[columns[c]], kNames[c], file, row.line);
  for (const std::size_t first : {0, 3}) {
    const double length2 = square(v[first]) + square(v[first + 1]) + square(v[first + 2]);
    if (!(v[first + 2] > 0 && std::abs(length2 - 1) < 1e-5))
      throw input_error("{}:{}: {},{},{} is {},{},{}; expected a unit vector above the surface", file, row.line, kNames[first],
                        kNames[first + 1], kNames[first + 2], v[first], v[first + 1], v[first + 2]);
  }
  const double degree = kPi<double> / 180;
  const auto theta = [&](std::size_t first) { return std::atan2(std::hypot(v[first], v[first + 1]), v[first + 2]) / degree; };
  const double phi_i = std::atan2(v[1], v[0]) / degree, phi_o = std::atan2(v[4], v[3]) / degree;
  return {theta(0), theta(3), phi_o - phi_i, std::nullopt, phi_i, &row, VectorPair{{v[0], v[1], v[2]}, {v[3], v[4], v[5]}}};
}

std::vector<EvalRow> eval_rows(const CsvTable& table, const std::string& file) {
  if (column(table, {"ix"}, file, false) >= 0) {
    std::array<int, 6> columns;
    for (std::size_t c = 0; const auto name : {"ix", "iy", "iz", "ox", "oy", "oz"}) columns[c++] = column(table, {name}, file);
    const int wavelength = column(table, {"wavelength_nm"}, file, false);
    std::vector<EvalRow> rows;
    for (const CsvRow& row : table.rows) {
      rows.push_back(vector_row(columns, row, file));
      if (wavelength >= 0 && !row.cells[wavelength].empty())
        rows.back().wavelength_nm = csv_number(row.cells[wavelength], "wavelength_nm", file, row.line);
    }
    if (rows.empty()) throw input_error("{}:{}: has no rows; expected at least one pair of directions", file, table.header_line);
    return rows;
  }
  const int theta_i = column(table, {"theta_i_deg"}, file), theta_o = column(table, {"theta_o_deg", "theta_r_deg"}, file);
  const int phi = column(table, {"phi_deg"}, file), wavelength = column(table, {"wavelength_nm"}, file, false);
  const int phi_i = column(table, {"phi_i_deg"}, file, false);
  std::vector<EvalRow> rows;
  for (const CsvRow& row : table.rows) {
    EvalRow one{zenith(row.cells[theta_i], "theta_i_deg", file, row.line), zenith(row.cells[theta_o], "theta_o_deg", file, row.line),
                csv_number(row.cells[phi], "phi_deg", file, row.line), std::nullopt,
                phi_i >= 0 ? csv_number(row.cells[phi_i], "phi_i_deg", file, row.line) : 0.0, &row};
    if (wavelength >= 0 && !row.cells[wavelength].empty())
      one.wavelength_nm = csv_number(row.cells[wavelength], "wavelength_nm", file, row.line);
    rows.push_back(one);
  }
  if (rows.empty()) throw input_error("{}:{}: has no rows; expected at least one pair of directions", file, table.header_line);
  return rows;
}

/// The sinc² of a patch takes h's components in and across the plane of incidence.
double coherent_patch(const ChosenModel& chosen, const EvalRow& row, const Directions<double>& w, double reflectance,
                      double wavelength_um) {
  if (!chosen.patch_x_um) return 0;
  const BeckmannKirchhoff<double> kirchhoff{chosen.values[0], chosen.values[1]};
  const double delta = (row.phi_deg - 180) * kPi<double> / 180, sin_o = sin_deg(row.theta_o_deg);
  const double h_x = sin_deg(row.theta_i_deg) - sin_o * std::cos(delta), h_y = -sin_o * std::sin(delta);
  return chosen.values[3] * reflectance *
         kirchhoff.coherent_patch(w, h_x, h_y, *chosen.patch_x_um, *chosen.patch_y_um, wavelength_um);
}

struct EvalResult {
  double f_r_per_sr, coherent_energy;
};

/// Directions from what the row gives, in the number type that evaluates them.
template <class T>
Directions<T> row_directions(const EvalRow& row) {
  using S = scalar_t<T>;
  if (!row.vectors) {
    const auto w = directions_from_deg(row.theta_i_deg, row.theta_o_deg, row.phi_deg, row.phi_i_deg);
    if constexpr (is_lanes_v<T>) return spread<T>(w);
    else return w;
  }
  const auto& [i, o] = *row.vectors;
  return reduce(T(S(i.x)), T(S(i.y)), T(S(i.z)), T(S(o.x)), T(S(o.y)), T(S(o.z)));
}

EvalResult evaluate_row(const Subject& subject, const EvalRow& row, double wavelength_nm, const std::string& precision) {
  const ChosenModel& chosen = subject.model;
  const double wavelength_um = wavelength_nm / 1000;
  const Interface<double> surface = subject.surface.at(wavelength_nm);
  const Directions<double> w = row_directions<double>(row);
  const Brdf<double> brdf = make_brdf<double>(chosen.spec, chosen.values);
  double f;
  if (precision == "float") {
    const auto lanes = spread_brdf<FloatLanes>(chosen.spec, chosen.values);
    f = evaluate(lanes, row_directions<FloatLanes>(row), spread<FloatLanes>(surface), FloatLanes(float(wavelength_um))).get(0);
  } else if (precision == "reference" && row.vectors) {
    f = reference_value(chosen.spec, chosen.values, row.vectors->i, row.vectors->o, surface, wavelength_um);
  } else if (precision == "reference") {
    f = reference_evaluate(chosen.spec, chosen.values, row.theta_i_deg, row.theta_o_deg, row.phi_deg, surface, wavelength_um,
                           row.phi_i_deg)
            .value;
  } else {
    f = evaluate(brdf, w, surface, wavelength_um);
  }
  f += coherent_patch(chosen, row, w, surface.reflectance(w.cos_d), wavelength_um);
  return {f, coherent_energy(brdf, w.cos_i, surface, wavelength_um)};
}

void run_eval(const EvalArguments& arguments, const Common& common) {
  const Subject subject = make_subject(arguments.model, arguments.surface);
  const bool from_stdin = arguments.input == "-";
  const std::string file = from_stdin ? "stdin" : arguments.input;
  const std::string text = from_stdin ? std::string(std::istreambuf_iterator<char>(std::cin), {}) : read_file(arguments.input);
  const CsvTable table = read_csv(text, file);
  const std::vector<EvalRow> rows = eval_rows(table, file);

  Json json_rows = Json::array();
  std::string out = fmt::format("{},f_r_per_sr\n", fmt::join(table.header, ","));
  const bool delta = has_delta(make_lobe<double>(subject.model.spec, subject.model.values));
  for (const EvalRow& row : rows) {
    const double wavelength_nm = subject.wavelength_for(row.wavelength_nm ? row.wavelength_nm : arguments.at_nm);
    const EvalResult result = evaluate_row(subject, row, wavelength_nm, arguments.precision);
    out += fmt::format("{},{}\n", fmt::join(row.row->cells, ","), result.f_r_per_sr);
    Json one{{"theta_i_deg", row.theta_i_deg}, {"theta_o_deg", row.theta_o_deg}, {"phi_deg", row.phi_deg}};
    if (wavelength_nm > 0) one["wavelength_nm"] = wavelength_nm;
    one["f_r_per_sr"] = result.f_r_per_sr;
    if (delta) one["coherent_energy"] = result.coherent_energy;
    json_rows.push_back(one);
  }
  if (common.json)
    std::cout << Json{{"model", subject.model.spec.info().name}, {"variant", subject.model.spec.variant()},
                      {"material", subject.surface.name()}, {"precision", arguments.precision}, {"rows", json_rows}}
                     .dump(2)
              << '\n';
  else
    std::cout << out;
  if (subject.surface.material().from_reflectance()) std::cerr << "note: F from reflectance (n from R0, k = 0)\n";
}

}  // namespace

void add_eval(CLI::App& app, Common& common) {
  auto* command = app.add_subcommand("eval", "Evaluate a model or a fit: rows of angles in, the same rows + f_r_per_sr out");
  command->footer("Example: printf 'theta_i_deg,theta_o_deg,phi_deg\\n30,40,180\\n' | gonio eval torrance-sparrow --set m=0.2 "
                  "--material Au --at 550\nColumns: theta_i_deg, theta_o_deg (or theta_r_deg), phi_deg = phi_o - phi_i (180: mirror "
                  "side)[, phi_i_deg from the grain, for anisotropic lobes][, wavelength_nm];\nor unit vectors towards light and eye, ix,iy,iz,ox,oy,oz (z: normal).\nf_r is a BRDF in 1/sr, without cosine. Without --material the surface is `perfect`.");
  add_common(*command, common);
  auto arguments = std::make_shared<EvalArguments>();
  arguments->model.add_to(*command);
  arguments->surface.add_to(*command);
  command->add_option("--at", arguments->at_nm, "Wavelength in nm, where the rows have none");
  command->add_option("--precision", arguments->precision, "float (SIMD), double or reference (50 digits)")
      ->check(CLI::IsMember({"float", "double", "reference"}))
      ->capture_default_str();
  command->add_option("--input", arguments->input, "CSV file, - for standard input")->capture_default_str();
  command->callback([&common, arguments] { run_eval(*arguments, common); });
}

}  // namespace gonio::cli
