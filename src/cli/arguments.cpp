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
  command.add_option("model", model, "Model name (see `gonio models`), a sum NAME+NAME, or a fit.json")->required();
  command
      .add_option("--set", settings, "Parameter or option, name=value (of a sum's lobes name_1=value, …); repeatable")
      ->allow_extra_args(false);
  command.add_option("--variant", variant,
                     "Variant of the model (see `gonio models NAME`); of a sum: --set variant_1=…");
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

/// m and alpha name the same roughness of a Gaussian slope law; alpha sets both of alpha_x and alpha_y. A sum's names
/// end in the suffix of the lobe.
void settle_alpha(std::map<std::string, double>& given, const ModelInfo& info, const std::string& suffix) {
  const std::string name = "alpha" + suffix, x = "alpha_x" + suffix, y = "alpha_y" + suffix, m = "m" + suffix;
  const auto alpha = given.find(name);
  if (alpha == given.end()) return;
  if (info.parameters.front().name == "alpha_x") {
    if (given.contains(x) || given.contains(y))
      throw input_error("{0}: given beside {1} or {2}; expected {0} alone, or {1} and {2}", name, x, y);
    given[x] = given[y] = alpha->second;
    given.erase(name);
    return;
  }
  if (info.parameters.front().name != "m") return;
  if (given.contains(m)) throw input_error("{} and {}: both given; expected exactly one (alpha = sqrt(2) m)", m, name);
  given[m] = alpha->second / std::sqrt(2.0);
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
  if (chosen.sum.is_sum() || chosen.sum.first().id != ModelId::beckmann_kirchhoff) return;
  chosen.patch_x_um = take(given, "patch_x_um");
  chosen.patch_y_um = take(given, "patch_y_um");
  if (chosen.patch_x_um.has_value() != chosen.patch_y_um.has_value())
    throw input_error("patch_x_um and patch_y_um: only one given; expected both or none");
  for (const auto& half : {chosen.patch_x_um, chosen.patch_y_um})
    if (half && !(*half > 0 && *half <= 1e7)) throw input_error("patch_x_um={}: out of range; expected 0 to 1e7 um", *half);
}

/// The numbers among the settings; shadowing, variant and retro go to the lobes.
std::map<std::string, double> numbers_of(const std::vector<std::string>& settings, LobeSum& sum) {
  std::map<std::string, double> given;
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos) throw input_error("--set {}: has no `=`; expected name=value", setting);
    const std::string name = setting.substr(0, equals), value = setting.substr(equals + 1);
    if (sum.set(name, value)) continue;
    if (!given.emplace(name, number_in(value, "--set " + name)).second)
      throw input_error("--set {}: given twice; expected once", name);
  }
  return given;
}

std::vector<double> values_of(const std::map<std::string, double>& given, const LobeSum& sum) {
  std::vector<double> values;
  for (const ParameterInfo& p : sum.parameters()) {
    const auto found = given.find(std::string(p.name));
    if (found == given.end() && !p.fallback) {
      const std::string_view alpha = p.name == "m" ? " or alpha" : "", unit = p.unit == "1" ? "" : p.unit;
      throw input_error("{}: {} is missing; expected --set {}=VALUE ({} to {}{}{}){}", sum.name(), p.name, p.name, p.lo,
                        p.hi, unit.empty() ? "" : " ", unit, alpha);
    }
    values.push_back(found == given.end() ? *p.fallback : found->second);
  }
  return values;
}

}  // namespace

ChosenModel choose_model(const ModelArguments& arguments) {
  ChosenModel chosen{lobe_sum(arguments.model), {}, {}, {}};
  LobeSum& sum = chosen.sum;
  if (sum.is_sum() && !arguments.variant.empty())
    throw input_error("--variant {}: of which lobe of {}; expected --set variant_1=NAME", arguments.variant,
                      sum.name());
  std::map<std::string, double> given = numbers_of(arguments.settings, sum);
  if (!arguments.variant.empty()) sum.set("variant", arguments.variant);
  for (std::size_t j = 0; j < sum.lobes().size(); ++j)
    settle_alpha(given, sum.lobes()[j].info(), sum.is_sum() ? fmt::format("_{}", j + 1) : "");
  take_patch(chosen, given);
  for (const auto& [name, value] : given) (void)sum.index_of(name);
  chosen.values = values_of(given, sum);
  sum.check(chosen.values);
  return chosen;
}

}  // namespace gonio::cli
