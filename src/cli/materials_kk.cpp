#include <fmt/format.h>

#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files.h"
#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/curves.h"
#include "materials/database.h"
#include "optics/kramers_kronig.h"

namespace gonio::cli {
namespace {

using Json = nlohmann::ordered_json;

struct KkArguments {
  std::string id, longer = "constant", known, out;
  double lo_nm = 0, hi_nm = 1e9;
  KramersKronigAssumption assumption;
};

constexpr int kPointsOfAFormula = 200;

/// The wavelengths at which a material is known: its table's, or an even sequence over a formula's range.
std::vector<double> wavelengths_of(const Entry& entry) {
  if (entry.formula.empty()) return entry.wavelength_nm;
  std::vector<double> nm;
  for (int i = 0; i <= kPointsOfAFormula; ++i)
    nm.push_back(entry.range_lo_nm + (entry.range_hi_nm - entry.range_lo_nm) * i / kPointsOfAFormula);
  return nm;
}

/// NaN where the source gives no k.
double known_r0(const SurfaceMaterial& material, double nm) {
  try {
    return material.at(nm).r0();
  } catch (const InputError&) {
    return std::nan("");
  }
}

/// Reflectance at normal incidence of an id, or the column `reflectance` of a file, within the band asked for.
Spectrum reflectance_of(const KkArguments& arguments) {
  if (!(arguments.lo_nm < arguments.hi_nm))
    throw input_error("--lo {}, --hi {}: no range; expected two wavelengths, the second greater", arguments.lo_nm,
                      arguments.hi_nm);
  Spectrum all;
  if (names_a_file(arguments.id)) {
    const Curves curves = read_curves(arguments.id);
    if (curves.name != std::vector<std::string>{"reflectance"})
      throw input_error("{}:1: columns {}; expected wavelength_nm,reflectance", arguments.id,
                        fmt::join(curves.name, ", "));
    all = {curves.wavelength_nm, curves.value[0]};
  } else {
    const SurfaceMaterial material(arguments.id);
    if (material.is_perfect()) throw input_error("perfect: has no index; expected a material of the database");
    all.wavelength_nm = wavelengths_of(*material.entry());
    for (const double nm : all.wavelength_nm)
      all.value.push_back(material.from_reflectance() ? material.entry()->at(nm) : known_r0(material, nm));
  }
  Spectrum band;
  for (std::size_t i = 0; i < all.value.size(); ++i)
    if (all.wavelength_nm[i] >= arguments.lo_nm && all.wavelength_nm[i] <= arguments.hi_nm && !std::isnan(all.value[i]))
      band.wavelength_nm.push_back(all.wavelength_nm[i]), band.value.push_back(all.value[i]);
  return band;
}

struct Row {
  double wavelength_nm;
  KramersKronigIndex index;
};

struct Result {
  double decay_exponent;
  std::vector<Row> rows;
};

Result transformed(const Spectrum& band, const KramersKronigAssumption& assumption) {
  const KramersKronig transform(band, assumption);
  Result result{transform.decay_exponent(), {}};
  for (const double nm : band.wavelength_nm) result.rows.push_back({nm, transform.at(nm)});
  return result;
}

KnownIndex known_index(const std::string& text) {
  const std::vector<double> numbers = number_list(text, "--known", 0, 1e6);
  if (numbers.size() != 3) throw input_error("--known {}: {} numbers; expected NM,N,K", text, numbers.size());
  return {numbers[0], numbers[1], numbers[2]};
}

std::string csv_of(const std::vector<Row>& rows) {
  std::string csv = "wavelength_nm,R,phase_rad,n,k,phase_lo_rad,phase_hi_rad,n_lo,n_hi,k_lo,k_hi\n";
  for (const auto& [nm, x] : rows)
    csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{}\n", nm, x.reflectance, x.phase, x.n, x.k, x.phase_lo,
                       x.phase_hi, x.n_lo, x.n_hi, x.k_lo, x.k_hi);
  return csv;
}

std::string assumption_text(const KkArguments& a, double decay_exponent) {
  return fmt::format(
      "assumed outside: {} at longer wavelengths, R ~ frequency^-{:.3g} at shorter ones{}; the intervals allow R from "
      "{:g} "
      "to 1 and from {:g} falling to 1",
      a.longer == "constant" ? "R as it was" : "1 - R ~ frequency^(1/2)", decay_exponent,
      a.known.empty() ? "" : " (from the known point)", a.assumption.least_longer, a.assumption.least_shorter);
}

Json json_of(const KkArguments& arguments, const Result& result) {
  const std::vector<Row>& rows = result.rows;
  Json json{{"id", arguments.id},
            {"range_nm", {rows.front().wavelength_nm, rows.back().wavelength_nm}},
            {"assumption",
             {{"longer", arguments.longer},
              {"decay_exponent", result.decay_exponent},
              {"least_longer", arguments.assumption.least_longer},
              {"least_shorter", arguments.assumption.least_shorter}}},
            {"rows", Json::array()}};
  for (const auto& [nm, x] : rows)
    json["rows"].push_back({{"wavelength_nm", nm},
                            {"R", x.reflectance},
                            {"phase_rad", x.phase},
                            {"n", x.n},
                            {"k", x.k},
                            {"phase_interval_rad", {x.phase_lo, x.phase_hi}},
                            {"n_interval", {x.n_lo, x.n_hi}},
                            {"k_interval", {x.k_lo, x.k_hi}}});
  return json;
}

std::string text_of(const KkArguments& arguments, const Result& result) {
  const std::vector<Row>& rows = result.rows;
  std::string text =
      fmt::format("{}: n, k from reflectance, {:g} to {:g} nm\n{}\n", arguments.id, rows.front().wavelength_nm,
                  rows.back().wavelength_nm, assumption_text(arguments, result.decay_exponent));
  text +=
      fmt::format("{:>13} {:>8} {:>8} {:>8} {:>18} {:>18}\n", "wavelength_nm", "R", "n", "k", "n within", "k within");
  for (const auto& [nm, x] : rows)
    text += fmt::format("{:>13g} {:>8.4f} {:>8.4f} {:>8.4f} {:>8.4f} {:>9.4f} {:>8.4f} {:>9.4f}\n", nm, x.reflectance,
                        x.n, x.k, x.n_lo, x.n_hi, x.k_lo, x.k_hi);
  return text;
}

}  // namespace

void add_materials_kk(CLI::App& materials, Common& common) {
  auto* command = materials.add_subcommand(
      "kk", "n and k from normal reflectance alone (Kramers-Kronig), with what the cut band leaves open");
  command->footer(
      "The reflectance of an ID, or a CSV of wavelength_nm,reflectance. From the visible alone the intervals are "
      "wide:\n"
      "that is the truth about such data.\n"
      "Example: gonio materials kk Au --longer hagen-rubens --least-longer 0.9\n"
      "         gonio materials kk mirror.csv --known 589.3,0.27,2.9 --out mirror-nk.csv");
  add_common(*command, common);
  auto arguments = std::make_shared<KkArguments>();
  command->add_option("id", arguments->id, "Database id or alias, or FILE.csv")->required();
  command->add_option("--lo", arguments->lo_nm, "Use no wavelength below, nm");
  command->add_option("--hi", arguments->hi_nm, "Use no wavelength above, nm");
  command->add_option("--longer", arguments->longer, "Beyond the longest wavelength: R constant, or a conductor's")
      ->check(CLI::IsMember({"constant", "hagen-rubens"}))
      ->capture_default_str();
  command
      ->add_option("--decay", arguments->assumption.decay_exponent,
                   "Below the shortest wavelength R falls as this power of the frequency, 0 to 4")
      ->capture_default_str();
  command->add_option("--known", arguments->known,
                      "NM,N,K: the index at one wavelength within the band, which then chooses the power");
  command
      ->add_option("--least-longer", arguments->assumption.least_longer,
                   "The smallest R possible at longer wavelengths")
      ->capture_default_str();
  command->add_option("--least-shorter", arguments->assumption.least_shorter, "The smallest R possible at shorter ones")
      ->capture_default_str();
  command->add_option("-o,--out", arguments->out, "A CSV of every column");
  command->callback([&common, arguments] {
    arguments->assumption.hagen_rubens = arguments->longer == "hagen-rubens";
    if (!arguments->known.empty()) arguments->assumption.known = known_index(arguments->known);
    const Result result = transformed(reflectance_of(*arguments), arguments->assumption);
    if (!arguments->out.empty()) write_file(arguments->out, csv_of(result.rows));
    std::cout << (common.json ? json_of(*arguments, result).dump(2) + "\n" : text_of(*arguments, result));
  });
}

}  // namespace gonio::cli
