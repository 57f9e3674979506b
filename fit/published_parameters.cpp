#include "fit/published_parameters.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.h"
#include "base/files.h"
#include "fit/csv.h"

namespace gonio {
namespace {

using Cells = std::map<std::string, double, std::less<>>;

double taken(Cells& cells, std::string_view name) {
  const auto found = cells.find(name);
  const double value = found->second;
  cells.erase(found);
  return value;
}
bool has(const Cells& cells, std::string_view name) { return cells.contains(name); }

double index_of_f0(double f0) { return (1 + std::sqrt(f0)) / (1 - std::sqrt(f0)); }
double f0_of_index(double n) { return (n - 1) * (n - 1) / ((n + 1) * (n + 1)); }

/// The column of a published symbol becomes the parameter of ours with the same meaning.
void to_our_parameters(Cells& cells, const PublishedTable& table, PublishedFit& fit) {
  fit.surface = perfect_interface<double>();
  if (table.model.starts_with("ward")) cells["alpha_x"] = cells["alpha_y"] = taken(cells, "alpha");
  if (table.model == "torrance-sparrow") {  // f = rho_s F D G/(pi cos cos) is 4/pi rho_s of ours; Low's D lacks 1/pi
    cells["m"] = taken(cells, "alpha") / std::sqrt(2.0);
    cells["ks"] = taken(cells, "rho_s") * (has(cells, "f0") ? 4 / kPi<double> : 4.0);
    if (has(cells, "f0")) cells["eta"] = index_of_f0(taken(cells, "f0"));
  }
  if (table.model == "lafortune-1997") cells["c_x"] = cells["c_y"] = taken(cells, "c_xy");
  if (table.model == "ashikhmin-shirley-2000") {
    cells["nu"] = cells["nv"] = taken(cells, "n");
    if (has(cells, "eta")) cells["f0"] = f0_of_index(taken(cells, "eta"));
  }
  if (table.model == "he-1991") {
    cells["sigma0_um"] = taken(cells, "sigma0");
    cells["correlation_um"] = taken(cells, "correlation");
  }
  if (table.model == "sgd-2012") {
    cells["theta_c_rad"] = std::exp(-std::log(taken(cells, "c")) / cells["k"]);
    cells["f_normal"] = cells["f0"] - taken(cells, "f1");
  }
  if (has(cells, "eta")) fit.surface = {taken(cells, "eta"), 0.0, false};
}

void check_box(const PublishedFit& fit, const std::string& file, int line) {
  const auto& parameters = fit.spec.info().parameters;
  for (std::size_t i = 0; i < parameters.size(); ++i)  // scales are whatever the fit made of them
    if (!parameters[i].linear && !(fit.values[i] >= parameters[i].lo && fit.values[i] <= parameters[i].hi))
      throw input_error("{}:{}: {} is {}; expected {} to {}", file, line, parameters[i].name, fit.values[i],
                        parameters[i].lo, parameters[i].hi);
}

PublishedFit fit_of(const PublishedTable& table, const ModelSpec& spec, Cells cells, const std::string& file,
                    int line) {
  PublishedFit fit;
  fit.spec = spec;
  to_our_parameters(cells, table, fit);
  for (const ParameterInfo& p : spec.info().parameters) fit.values.push_back(p.fallback.value_or(0));
  for (const auto& [name, value] : cells) fit.values[spec.info().index_of(name)] = value;
  check_box(fit, file, line);
  return fit;
}

std::vector<std::string_view> parts_of(std::string_view path) {
  std::vector<std::string_view> parts;
  for (std::size_t at = 0; at <= path.size();) {
    const std::size_t slash = std::min(path.find('/', at), path.size());
    parts.push_back(path.substr(at, slash - at));
    at = slash + 1;
  }
  return parts;
}

}  // namespace

const std::vector<PublishedTable>& published_tables() {
  static const std::vector<PublishedTable> all{
      {"ngan-ward", "ward-1992", "", ""},
      {"ngan-ward-duer", "ward-duer-2006", "", ""},
      {"ngan-blinn-phong", "blinn-phong-normalised", "", ""},
      {"ngan-cook-torrance", "torrance-sparrow", "schlick-f", "v-cavity"},
      {"ngan-ashikhmin-shirley", "ashikhmin-shirley-2000", "", ""},
      {"ngan-lafortune", "lafortune-1997", "normalised", ""},
      {"ngan-he", "he-1991", "", ""},
      {"low-cook-torrance-e1", "torrance-sparrow", "", "v-cavity"},
      {"low-cook-torrance-e2", "torrance-sparrow", "", "v-cavity"},
      {"low-ashikhmin-shirley-e1", "ashikhmin-shirley-2000", "fresnel", ""},
      {"low-ashikhmin-shirley-e2", "ashikhmin-shirley-2000", "fresnel", ""},
      {"low-smooth", "low-smooth-2012", "", ""},
      {"low-microfacet", "low-microfacet-2012", "", ""},
      {"bagher-sgd", "sgd-2012", "", ""},
  };
  return all;
}

const PublishedTable& published_table(std::string_view name) {
  std::string known;
  for (const PublishedTable& table : published_tables()) {
    if (table.name == name) return table;
    known += fmt::format("{}{}", known.empty() ? "" : ", ", table.name);
  }
  throw input_error("published:{}: unknown table; expected one of {}", name, known);
}

std::vector<PublishedFit> read_published(const PublishedTable& table) {
  const std::string file = fmt::format("{}.csv", table.name);
  const std::string text = read_file(data_folder("measurements") / "published_parameters" / file);
  const CsvTable csv = read_csv(text, file);
  ModelSpec spec;
  spec.id = model(table.model).id;
  if (!table.variant.empty()) set_variant(spec, table.variant);
  if (!table.shadowing.empty()) set_shadowing(spec, table.shadowing);
  std::vector<PublishedFit> fits;
  for (const CsvRow& row : csv.rows) {
    Cells cells;
    for (std::size_t c = 2; c < row.cells.size(); ++c)
      cells.emplace(csv.header[c], csv_number(row.cells[c], csv.header[c], file, row.line));
    fits.push_back(fit_of(table, spec, cells, file, row.line));
    fits.back().material = row.cells[0];
    fits.back().channel = row.cells[1];
  }
  return fits;
}

PublishedFit published_fit(std::string_view path) {
  const auto parts = parts_of(path);
  if (parts.size() != 3) throw input_error("published:{}: no such fit; expected published:TABLE/MATERIAL/r|g|b", path);
  for (const PublishedFit& fit : read_published(published_table(parts[0])))
    if (fit.material == parts[1] && fit.channel == parts[2]) return fit;
  throw input_error(
      "published:{}: no such row; expected a material of the table (gonio models published:{}) and r, g or b", path,
      parts[0]);
}

}  // namespace gonio
