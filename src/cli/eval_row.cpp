#include "cli/eval_row.h"

#include <array>
#include <cmath>

#include "base/error.h"
#include "brdf/lanes.h"
#include "reference/reference.h"

namespace gonio::cli {
namespace {

/// Up to here a medium counts as transparent (glasses have k of 1e-9 to 1e-5).
constexpr double kTransparentK = 1e-4;

/// The column under any of its names; -1 where optional and absent.
int column(const CsvTable& table, std::initializer_list<std::string_view> names, const std::string& file,
           bool required = true) {
  for (std::size_t c = 0; c < table.header.size(); ++c)
    for (const auto name : names)
      if (table.header[c] == name) return static_cast<int>(c);
  if (required)
    throw input_error("{}:{}: column {} is missing; expected theta_i_deg,theta_o_deg,phi_deg[,wavelength_nm]", file,
                      table.header_line, *names.begin());
  return -1;
}

double zenith(std::string_view cell, std::string_view name, const std::string& file, int line, bool below_too) {
  const double value = csv_number(cell, name, file, line);
  if (below_too && value > 90 && value <= 180) return value;
  if (!(value >= 0 && value < 90))
    throw input_error("{}:{}: {} is {}; expected 0 <= angle < 90{}", file, line, name, value,
                      below_too ? ", or 90 < angle <= 180 for transmitted light" : "");
  return value;
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

/// One row, one lobe of the model and its surface, for each number type in turn.
struct Evaluation {
  const ChosenModel& chosen;
  const ModelSpec& spec;
  std::vector<double> values;  ///< the lobe's own
  const EvalRow& row;
  Interface<double> surface;
  double wavelength_um;
  Brdf<double> brdf;

  Azimuth<double> azimuth() const { return azimuth_from_deg(row.phi_deg); }
  UnitVector<double> i() const { return direction_from_deg(row.theta_i_deg, Azimuth<double>{0, 2}); }
  UnitVector<double> o() const { return direction_from_deg(row.theta_o_deg, azimuth()); }
  Directions<double> above() const { return directions<double>(); }
  /// Directions from what the row gives; vectors are rounded to the number type that evaluates them, then reduced in it.
  template <class T>
  Directions<T> directions() const {
    using S = scalar_t<T>;
    if (row.vectors) {
      const auto& [i, o] = *row.vectors;
      return reduce(T(S(i.x)), T(S(i.y)), T(S(i.z)), T(S(o.x)), T(S(o.y)), T(S(o.z)));
    }
    const auto w = directions_from_deg(row.theta_i_deg, row.theta_o_deg, row.phi_deg, row.phi_i_deg);
    if constexpr (is_lanes_v<T>)
      return spread<T>(w);
    else
      return w;
  }
  double patch() const {
    if (row.transmitted()) return 0;
    const Directions<double> w = above();
    return coherent_patch(chosen, row, w, surface.reflectance(w.cos_d), wavelength_um);
  }
};

double unpolarised(const Evaluation& e, const std::string& precision) {
  const EvalRow& row = e.row;
  if (precision == "reference" && row.vectors)
    return reference_value(e.spec, e.values, row.vectors->i, row.vectors->o, e.surface, e.wavelength_um);
  if (precision == "reference" && !row.transmitted())
    return reference_evaluate(e.spec, e.values, row.theta_i_deg, row.theta_o_deg, row.phi_deg, e.surface,
                              e.wavelength_um, row.phi_i_deg)
        .value;
  if (precision == "reference")
    return reference_polarised(e.spec, e.values, row.theta_i_deg, row.theta_o_deg, row.phi_deg, e.surface,
                               e.wavelength_um)
        .mueller.m[0][0];
  if (precision == "double")
    return row.transmitted() ? evaluate_transmission(e.brdf, e.i(), e.o(), e.surface)
                             : evaluate(e.brdf, e.above(), e.surface, e.wavelength_um);
  const auto lanes = spread_brdf<FloatLanes>(e.spec, e.values);
  const auto surface = spread<FloatLanes>(e.surface);
  if (row.transmitted())
    return evaluate_transmission(lanes, spread<FloatLanes>(e.i()), spread<FloatLanes>(e.o()), surface).get(0);
  return evaluate(lanes, e.directions<FloatLanes>(), surface, FloatLanes(float(e.wavelength_um))).get(0);
}

/// The matrix, and f of the light asked for; the coherent part of a patch included.
PolarisedValue in_double(const Evaluation& e, const LinearLight<double>& light) {
  if (e.row.transmitted())
    return {transmission_mueller(e.brdf, e.i(), e.o(), e.azimuth(), e.surface),
            transmission_linear(e.brdf, e.i(), e.o(), e.azimuth(), e.surface, light)};
  const Directions<double> w = e.above();
  return {evaluate_mueller(e.brdf, w, e.azimuth(), e.surface, e.wavelength_um, e.patch()),
          evaluate_linear(e.brdf, w, e.azimuth(), e.surface, e.wavelength_um, light, e.patch())};
}

PolarisedValue first_lane(const Mueller<FloatLanes>& lanes, const FloatLanes& linear) {
  PolarisedValue first{{}, linear.get(0)};
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c) first.mueller.m[r][c] = lanes.m[r][c].get(0);
  return first;
}

PolarisedValue in_float(const Evaluation& e, const LinearLight<double>& light) {
  const auto lanes = spread_brdf<FloatLanes>(e.spec, e.values);
  const auto surface = spread<FloatLanes>(e.surface);
  const auto azimuth = spread<FloatLanes>(e.azimuth());
  const auto all = [](double x) { return FloatLanes(float(x)); };
  const LinearLight<FloatLanes> field{all(light.cos_alpha), all(light.sin_alpha)};
  if (e.row.transmitted()) {
    const auto i = spread<FloatLanes>(e.i()), o = spread<FloatLanes>(e.o());
    return first_lane(transmission_mueller(lanes, i, o, azimuth, surface),
                      transmission_linear(lanes, i, o, azimuth, surface, field));
  }
  const auto w = spread<FloatLanes>(e.above());
  const FloatLanes um = all(e.wavelength_um), patch = all(e.patch());
  return first_lane(evaluate_mueller(lanes, w, azimuth, surface, um, patch),
                    evaluate_linear(lanes, w, azimuth, surface, um, field, patch));
}

PolarisedValue polarised(const Evaluation& e, const std::string& precision, const LinearLight<double>& light) {
  if (precision == "double") return in_double(e, light);
  if (precision == "float") return in_float(e, light);
  return reference_polarised(e.spec, e.values, e.row.theta_i_deg, e.row.theta_o_deg, e.row.phi_deg, e.surface,
                             e.wavelength_um, e.row.phi_i_deg, light, e.patch());
}

void check_polarisation(const Evaluation& e) {
  if (e.row.vectors)
    throw input_error("ix,iy,iz,ox,oy,oz: no azimuth is taken from unit vectors; expected angles with polarised light");
  if (states_polarisation(e.brdf) || e.brdf.ks == 0) return;
  throw input_error(
      "{}{}: does not state what becomes of polarisation; expected a faceted model (R of its facets), not turned back",
      e.spec.info().name, e.brdf.retro ? " with retro=yes" : "");
}

void check_transparent(const Evaluation& e) {
  if (e.surface.perfect)
    throw input_error("theta_o_deg {}: `perfect` lets nothing through; expected --n or a transparent --material",
                      e.row.theta_o_deg);
  if (e.surface.k > kTransparentK)
    throw input_error("theta_o_deg {}: the surface absorbs (k = {}); expected k up to {} for transmitted light",
                      e.row.theta_o_deg, e.surface.k, kTransparentK);
}

/// A row of components: z > 0, and unit length to float's rounding. They are used as they are; the angles are for the report.
EvalRow vector_row(const std::array<int, 6>& columns, const CsvRow& row, const std::string& file) {
  constexpr std::array kNames{"ix", "iy", "iz", "ox", "oy", "oz"};
  std::array<double, 6> v;
  for (std::size_t c = 0; c < 6; ++c) v[c] = csv_number(row.cells[columns[c]], kNames[c], file, row.line);
  for (const std::size_t first : {0, 3}) {
    const double length2 = square(v[first]) + square(v[first + 1]) + square(v[first + 2]);
    if (!(v[first + 2] > 0 && std::abs(length2 - 1) < 1e-5))
      throw input_error("{}:{}: {},{},{} is {},{},{}; expected a unit vector above the surface", file, row.line,
                        kNames[first], kNames[first + 1], kNames[first + 2], v[first], v[first + 1], v[first + 2]);
  }
  const double degree = kPi<double> / 180;
  const auto theta = [&](std::size_t first) {
    return std::atan2(std::hypot(v[first], v[first + 1]), v[first + 2]) / degree;
  };
  const double phi_i = std::atan2(v[1], v[0]) / degree, phi_o = std::atan2(v[4], v[3]) / degree;
  return {
      theta(0), theta(3), phi_o - phi_i, std::nullopt, phi_i, &row, VectorPair{{v[0], v[1], v[2]}, {v[3], v[4], v[5]}}};
}

std::vector<EvalRow> vector_rows(const CsvTable& table, const std::string& file) {
  std::array<int, 6> columns;
  for (std::size_t c = 0; const auto name : {"ix", "iy", "iz", "ox", "oy", "oz"})
    columns[c++] = column(table, {name}, file);
  const int wavelength = column(table, {"wavelength_nm"}, file, false);
  std::vector<EvalRow> rows;
  for (const CsvRow& row : table.rows) {
    rows.push_back(vector_row(columns, row, file));
    if (wavelength >= 0 && !row.cells[wavelength].empty())
      rows.back().wavelength_nm = csv_number(row.cells[wavelength], "wavelength_nm", file, row.line);
  }
  if (rows.empty())
    throw input_error("{}:{}: has no rows; expected at least one pair of directions", file, table.header_line);
  return rows;
}

/// What one lobe adds.
EvalResult evaluate_one(const Evaluation& e, const EvalRequest& request) {
  if (e.row.transmitted()) check_transparent(e);
  const double cos_i = cos_deg(e.row.theta_i_deg);
  EvalResult result{0, coherent_energy(e.brdf, cos_i, e.surface, e.wavelength_um), std::nullopt};
  if (!request.light && !request.mueller) {
    result.f_r_per_sr = unpolarised(e, request.precision) + e.patch();
    return result;
  }
  check_polarisation(e);
  const PolarisedValue values = polarised(e, request.precision, request.light.value_or(LinearLight<double>{1, 0}));
  if (request.mueller) result.mueller = values.mueller;
  result.f_r_per_sr = request.light ? values.linear : values.mueller.m[0][0];
  if (request.light)
    result.coherent_energy = (coherent_mueller(e.brdf, cos_i, e.surface, e.wavelength_um) * request.light->stokes())[0];
  return result;
}

void add_to(std::optional<Mueller<double>>& sum, const std::optional<Mueller<double>>& one) {
  if (!sum || !one) {
    if (one) sum = one;
    return;
  }
  *sum += *one;
}

}  // namespace

std::vector<EvalRow> eval_rows(const CsvTable& table, const std::string& file, bool transmits) {
  if (column(table, {"ix"}, file, false) >= 0) return vector_rows(table, file);
  const int theta_i = column(table, {"theta_i_deg"}, file),
            theta_o = column(table, {"theta_o_deg", "theta_r_deg"}, file);
  const int phi = column(table, {"phi_deg"}, file), wavelength = column(table, {"wavelength_nm"}, file, false);
  const int phi_i = column(table, {"phi_i_deg"}, file, false);
  std::vector<EvalRow> rows;
  for (const CsvRow& row : table.rows) {
    EvalRow one{zenith(row.cells[theta_i], "theta_i_deg", file, row.line, false),
                zenith(row.cells[theta_o], "theta_o_deg", file, row.line, transmits),
                csv_number(row.cells[phi], "phi_deg", file, row.line),
                std::nullopt,
                phi_i >= 0 ? csv_number(row.cells[phi_i], "phi_i_deg", file, row.line) : 0.0,
                &row};
    if (wavelength >= 0 && !row.cells[wavelength].empty())
      one.wavelength_nm = csv_number(row.cells[wavelength], "wavelength_nm", file, row.line);
    rows.push_back(one);
  }
  if (rows.empty())
    throw input_error("{}:{}: has no rows; expected at least one pair of directions", file, table.header_line);
  return rows;
}

LinearLight<double> linear_light(const std::string& text) {
  if (text == "s") return {1, 0};
  if (text == "p") return {0, 1};
  if (text.find_first_not_of("0123456789.+-eE") != text.npos)
    throw input_error("--polarisation {}: unknown; expected s, p or an angle in degrees from s towards p", text);
  const double alpha_deg = number_in(text, "--polarisation");
  if (!(std::abs(alpha_deg) <= 360))
    throw input_error("--polarisation {}: out of range; expected -360 to 360 degrees", text);
  const Azimuth<double> alpha = azimuth_from_deg(alpha_deg);
  return {alpha.cos_phi(), alpha.sin_phi};
}

EvalResult evaluate_row(const Subject& subject, const EvalRow& row, double wavelength_nm, const EvalRequest& request) {
  const LobeSum& sum = subject.model.sum;
  const std::vector<double> values = subject.values_at(wavelength_nm);
  const Interface<double> surface = subject.surface.at(wavelength_nm);
  EvalResult total;
  for (std::size_t j = 0; j < sum.lobes().size(); ++j) {
    const std::vector<double> own = sum.values_of(j, values);
    const Brdf<double> brdf = make_brdf<double>(sum.lobes()[j], own);
    const EvalResult one =
        evaluate_one({subject.model, sum.lobes()[j], own, row, surface, wavelength_nm / 1000, brdf}, request);
    total.f_r_per_sr += one.f_r_per_sr;
    total.coherent_energy += one.coherent_energy;
    add_to(total.mueller, one.mueller);
  }
  return total;
}

}  // namespace gonio::cli
