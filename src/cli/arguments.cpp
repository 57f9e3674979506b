#include "cli/arguments.h"

#include <charconv>
#include <cmath>
#include <map>

#include "base/error.h"

namespace gonio::cli {

void SurfaceArguments::add_to(CLI::App& command) {
  command.add_option("--material", material, "Database id of the material, or `perfect` (reflects 1 at every angle)");
  command.add_option("--n", n, "Refractive index instead of a material");
  command.add_option("--k", k, "Extinction coefficient (default 0)");
}

Surface::Surface(const SurfaceArguments& arguments) {
  if (arguments.n || arguments.k) {
    if (!arguments.material.empty()) throw input_error("--material and --n: both given; expected one of the two");
    if (!arguments.n) throw input_error("--k: given without --n; expected both");
    const double n = *arguments.n, k = arguments.k.value_or(0);
    if (!(n > 0 && n <= 1000)) throw input_error("--n {}: out of range; expected 0 < n <= 1000", n);
    if (!(k >= 0 && k <= 1000)) throw input_error("--k {}: out of range; expected 0 <= k <= 1000", k);
    fixed_ = Interface<double>{n, k, false};
  } else if (!arguments.material.empty()) {
    material_ = SurfaceMaterial(arguments.material);
  }
}

std::string Surface::name() const { return fixed_ ? fmt::format("n={} k={}", fixed_->n, fixed_->k) : material_.id(); }

void ModelArguments::add_to(CLI::App& command) {
  command.add_option("model", model, "Model name (see `gonio models`) or a fit.json")->required();
  command.add_option("--set", settings, "Parameter or option, name=value; repeatable")->allow_extra_args(false);
  command.add_option("--variant", variant, "Variant of the model (see `gonio models NAME`)");
}

double number_in(const std::string& text, std::string_view option) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    throw input_error("{} {}: is no finite number; expected one", option, text);
  return value;
}

std::vector<double> number_list(const std::string& text, std::string_view option, double lo, double hi) {
  std::vector<double> values;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    values.push_back(number_in(text.substr(at, comma - at), option));
    if (!(values.back() >= lo && values.back() <= hi))
      throw input_error("{} {}: outside the range; expected {} to {}", option, values.back(), lo, hi);
    at = comma + 1;
  }
  return values;
}

namespace {

/// m and alpha name the same roughness of a Gaussian slope law; alpha sets both of alpha_x and alpha_y.
void settle_alpha(std::map<std::string, double>& given, const ModelInfo& info) {
  const auto alpha = given.find("alpha");
  if (alpha == given.end()) return;
  if (info.parameters.front().name == "alpha_x") {
    if (given.contains("alpha_x") || given.contains("alpha_y"))
      throw input_error("alpha: given beside alpha_x or alpha_y; expected alpha alone, or alpha_x and alpha_y");
    given["alpha_x"] = given["alpha_y"] = alpha->second;
    given.erase("alpha");
    return;
  }
  if (info.parameters.front().name != "m") return;
  if (given.contains("m")) throw input_error("m and alpha: both given; expected exactly one (alpha = sqrt(2) m)");
  given["m"] = alpha->second / std::sqrt(2.0);
  given.erase(alpha);
}

std::optional<double> take(std::map<std::string, double>& given, const std::string& name) {
  const auto found = given.find(name);
  if (found == given.end()) return std::nullopt;
  const double value = found->second;
  given.erase(found);
  return value;
}

void take_patch(ChosenModel& chosen, std::map<std::string, double>& given) {
  if (chosen.spec.id != ModelId::beckmann_kirchhoff) return;
  chosen.patch_x_um = take(given, "patch_x_um");
  chosen.patch_y_um = take(given, "patch_y_um");
  if (chosen.patch_x_um.has_value() != chosen.patch_y_um.has_value())
    throw input_error("patch_x_um and patch_y_um: only one given; expected both or none");
  for (const auto& half : {chosen.patch_x_um, chosen.patch_y_um})
    if (half && !(*half > 0 && *half <= 1e7)) throw input_error("patch_x_um={}: out of range; expected 0 to 1e7 um", *half);
}

}  // namespace

ChosenModel choose_model(const ModelArguments& arguments) {
  ChosenModel chosen;
  const ModelInfo& info = model(arguments.model);
  chosen.spec.id = info.id;
  std::map<std::string, double> given;
  for (const std::string& setting : arguments.settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos) throw input_error("--set {}: has no `=`; expected name=value", setting);
    const std::string name = setting.substr(0, equals), value = setting.substr(equals + 1);
    if (name == "shadowing") {
      set_shadowing(chosen.spec, value);
      continue;
    }
    if (name == "retro") {
      set_retro(chosen.spec, value);
      continue;
    }
    if (!given.emplace(name, number_in(value, "--set " + name)).second)
      throw input_error("--set {}: given twice; expected once", name);
  }
  if (!arguments.variant.empty()) set_variant(chosen.spec, arguments.variant);
  settle_alpha(given, info);
  take_patch(chosen, given);
  for (const auto& [name, value] : given) (void)info.index_of(name);
  for (const ParameterInfo& p : info.parameters) {
    const auto found = given.find(std::string(p.name));
    if (found == given.end() && !p.fallback)
      throw input_error("{}: {} is missing; expected --set {}=VALUE ({} to {} {}){}", info.name, p.name, p.name, p.lo, p.hi,
                        p.unit == "1" ? "" : p.unit, p.name == "m" ? " or alpha" : "");
    chosen.values.push_back(found == given.end() ? *p.fallback : found->second);
  }
  check_values(chosen.spec, chosen.values);
  return chosen;
}

}  // namespace gonio::cli
