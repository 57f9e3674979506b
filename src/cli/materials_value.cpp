#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "cli/commands.h"
#include "materials/interpolated_entry.h"

namespace gonio::cli {
namespace {

struct ValueArguments {
  std::string id, interpolation, extension;
  double at_nm = 0;
};

std::optional<Extension> extension_of(const std::string& name) {
  if (name.empty()) return std::nullopt;
  if (name == "nearest") return Extension::nearest;
  if (name == "linear") return Extension::linear;
  throw input_error("--extrapolate: {}; expected nearest or linear", name);
}

Interpolation variant_of(const std::string& name, const std::string& data_class) {
  if (name.empty()) return default_interpolation(data_class);
  if (const auto variant = interpolation_named(name)) return *variant;
  throw input_error(
      "--interpolation: {}; expected linear, pchip, akima, natural-cubic, barycentric-rational or sprague", name);
}

void print_values(const ValueArguments& arguments, bool json) {
  const Entry& entry = Database::bundled().find(arguments.id);
  const std::optional<Extension> extension = extension_of(arguments.extension);
  nlohmann::ordered_json out{
      {"id", entry.id}, {"wavelength_nm", arguments.at_nm}, {"values", nlohmann::ordered_json::array()}};
  std::string text;
  for (std::size_t c = 0; c < entry.column_names.size(); ++c) {
    const bool formula = !entry.formula.empty() && c == 0;
    const Interpolation variant = variant_of(arguments.interpolation, data_class_of(entry, c));
    const Interpolated found = interpolated(entry, arguments.at_nm, c, variant, extension);
    const std::string how = formula ? entry.formula : std::string(name_of(variant));
    out["values"].push_back({{"name", entry.column_names[c]},
                             {"value", found.value},
                             {"interpolation", how},
                             {"extrapolated", found.extrapolated}});
    text += fmt::format("{} = {:.6g} ({}{})\n", entry.column_names[c], found.value, how,
                        found.extrapolated ? ", EXTRAPOLATED: outside the data" : "");
  }
  std::cout << (json ? out.dump(2) + "\n" : fmt::format("{} at {} nm\n{}", entry.id, arguments.at_nm, text));
}

}  // namespace

void add_materials_value(CLI::App& materials, Common& common) {
  auto* command = materials.add_subcommand(
      "value",
      "Values of an entry between its points by any interpolation variant (default: the one reports/interpolation "
      "justifies for the class of data), and beyond them only with --extrapolate, marked. Colours and everything else "
      "stay linear between points");
  command->footer(
      "Example: gonio materials value Au --at 555 --interpolation akima\n         gonio materials value D65 --at 790 "
      "--extrapolate nearest");
  add_common(*command, common);
  auto arguments = std::make_shared<ValueArguments>();
  command->add_option("id", arguments->id, "Id or alias")->required();
  command->add_option("--at", arguments->at_nm, "Wavelength in nm")->required();
  command->add_option("--interpolation", arguments->interpolation,
                      "linear, pchip, akima, natural-cubic, barycentric-rational or sprague");
  command->add_option("--extrapolate", arguments->extension, "nearest or linear: what stands beyond the data");
  command->callback([&common, arguments] { print_values(*arguments, common.json); });
}

}  // namespace gonio::cli
