#include "fit/fitted_material.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files.h"
#include "fit/fit.h"

namespace gonio {
namespace {

using nlohmann::json;

/// One fit.json being read: every complaint names the file and what was expected.
struct FitReader {
  const std::string& file;

  const json& at(const json& object, const char* key, const char* expected) const {
    if (!object.is_object() || !object.contains(key))
      throw input_error("{}: {} is missing; expected {}", file, key, expected);
    return object.at(key);
  }
  std::string text(const json& object, const char* key) const {
    const json& value = at(object, key, "a name");
    if (!value.is_string()) throw input_error("{}: {} is no text; expected a name", file, key);
    return value.get<std::string>();
  }
  double number(const json& value, std::string_view what) const {
    if (!value.is_number() || !std::isfinite(value.get<double>()))
      throw input_error("{}: {} is no number; expected a finite one", file, what);
    return value.get<double>();
  }
  void options(const json& root, FittedMaterial& material) const {
    if (root.contains("variant")) variants(text(root, "variant"), material);
    if (!root.contains("options")) return;
    const json& options = root.at("options");
    if (!options.is_object()) throw input_error("{}: options is no list of names; expected {{\"shadowing\": …}}", file);
    for (const auto& [name, value] : options.items())
      if (!material.model.set(name, text(options, name.c_str())))
        throw input_error("{}: options has {}; expected shadowing, retro", file, name);
  }
  /// One name a lobe, joined by +.
  void variants(std::string_view names, FittedMaterial& material) const {
    const std::size_t lobes = material.model.lobes().size();
    for (std::size_t j = 0, from = 0; j < lobes; ++j) {
      const std::size_t end = j + 1 < lobes ? std::min(names.find('+', from), names.size()) : names.size();
      material.model.set(lobes > 1 ? fmt::format("variant_{}", j + 1) : "variant", names.substr(from, end - from));
      from = std::min(end + 1, names.size());
    }
  }
  /// A number, or one for each wavelength.
  std::vector<double> values(const json& given, const ParameterInfo& info, bool relative) const {
    const std::string name(info.name);
    const json& value = at(at(given, name.c_str(), "a parameter of the model"), "value", "a number");
    std::vector<double> all;
    if (value.is_array())
      for (const json& one : value) all.push_back(number(one, name));
    else
      all.push_back(number(value, name));
    if (all.empty()) throw input_error("{}: {} is empty; expected a number, or one for each wavelength", file, name);
    for (const double one : all)
      if (!(one >= info.lo && (one <= info.hi || (info.linear && relative))))
        throw input_error("{}: {} is {}; expected {} to {}", file, name, one, info.lo, info.hi);
    return all;
  }
  /// Fitted n or k, unless it is the name of a model's own parameter.
  std::optional<double> of_surface(const json& given, const std::vector<ParameterInfo>& own, const char* name) const {
    if (std::any_of(own.begin(), own.end(), [&](const ParameterInfo& p) { return p.name == name; }))
      return std::nullopt;
    if (!given.contains(name)) return std::nullopt;
    const double value = number(at(given.at(name), "value", "a number"), name);
    if (!(value > 0)) throw input_error("{}: {} is {}; expected more than 0", file, name, value);
    return value;
  }
  void parameters(const json& root, FittedMaterial& material) const {
    const json& given = at(root, "parameters", "the fitted values");
    if (!given.is_object())
      throw input_error("{}: parameters is no list of names; expected name and value of each", file);
    const bool relative = root.contains("source") && root.at("source").is_object() &&
                          root.at("source").value("quantity", json()) == "relative";
    const auto& own = material.model.parameters();
    for (std::size_t i = 0; i < own.size(); ++i) {
      const std::vector<double> all = values(given, own[i], relative);
      material.values.push_back(all.front());
      if (!given.at(std::string(own[i].name)).at("value").is_array()) continue;
      if (!material.model.is_diffuse(i) && !material.model.is_scale(i))
        throw input_error("{}: {} is a list; expected one number (kd and ks alone differ between wavelengths)", file,
                          own[i].name);
      if (all.size() != material.wavelength_nm.size())
        throw input_error("{}: {} has {} values; expected one for each of {} wavelengths", file, own[i].name,
                          all.size(), material.wavelength_nm.size());
      if (all.size() == 1) continue;  // of one wavelength: as good as shared
      material.by_wavelength.resize(own.size());
      material.by_wavelength[i] = all;
    }
    material.n = of_surface(given, own, "n"), material.k = of_surface(given, own, "k");
    if (material.k && !material.n) throw input_error("{}: k without n; expected both, or n alone", file);
  }
  void wavelengths(const json& root, FittedMaterial& material) const {
    const json& given = at(root, "wavelength_nm", "a list (empty = not stated)");
    if (!given.is_array()) throw input_error("{}: wavelength_nm is no list; expected one (empty = not stated)", file);
    for (const json& value : given) material.wavelength_nm.push_back(number(value, "wavelength_nm"));
    if (!std::is_sorted(material.wavelength_nm.begin(), material.wavelength_nm.end(), std::less_equal<>()))
      throw input_error("{}: wavelength_nm does not rise; expected it to, value by value", file);
    if (root.contains("assumed_wavelength_nm") && !root.at("assumed_wavelength_nm").is_null())
      material.assumed_wavelength_nm = number(root.at("assumed_wavelength_nm"), "assumed_wavelength_nm");
  }
};

}  // namespace

std::optional<double> FittedMaterial::wavelength(std::optional<double> asked_nm) const {
  const bool from_database = material && *material != "perfect" && !n && !is_spectral();
  if (asked_nm) {
    constexpr double kSame = 1e-6;  // nm
    const bool inside = wavelength_nm.empty() || from_database ||
                        (*asked_nm >= wavelength_nm.front() - kSame && *asked_nm <= wavelength_nm.back() + kSame);
    if (!inside)
      throw input_error("{} nm: outside the fitted wavelengths; expected {} to {} nm", *asked_nm, wavelength_nm.front(),
                        wavelength_nm.back());
    return asked_nm;
  }
  if (wavelength_nm.size() == 1) return wavelength_nm.front();
  if (assumed_wavelength_nm) return assumed_wavelength_nm;
  if (!from_database && !model.needs_wavelength() && !is_spectral()) return std::nullopt;
  if (wavelength_nm.empty()) throw input_error("the wavelength of the fit is not stated; expected --at");
  throw input_error("the fit has {} wavelengths; expected --at with one of {}", wavelength_nm.size(),
                    fmt::join(wavelength_nm, ", "));
}

Interface<double> FittedMaterial::surface(std::optional<double> at_nm) const {
  if (n) return {*n, k.value_or(0.0), false};
  if (!material || model.first().id == ModelId::lambert) return perfect_interface<double>();
  const SurfaceMaterial surface(*material);
  if (surface.is_perfect()) return perfect_interface<double>();
  if (!at_nm) throw input_error("n and k of {} need a wavelength; expected --at", *material);
  return surface.at(*at_nm);
}

std::vector<double> FittedMaterial::values_at(std::optional<double> at_nm) const {
  std::vector<double> all = values;
  if (!is_spectral() || !at_nm) return all;
  const auto next = std::lower_bound(wavelength_nm.begin() + 1, wavelength_nm.end() - 1, *at_nm);
  const auto after = static_cast<std::size_t>(next - wavelength_nm.begin());
  const double lo = wavelength_nm[after - 1], share = std::clamp((*at_nm - lo) / (*next - lo), 0.0, 1.0);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (const auto& own = by_wavelength[i]; !own.empty())
      all[i] = own[after - 1] + share * (own[after] - own[after - 1]);
  return all;
}

FittedMaterial fitted_material(const FitResult& result) {
  FittedMaterial material{result.model,
                          result.values(),
                          {},
                          result.material,
                          result.index(),
                          result.absorption(),
                          result.wavelength_nm,
                          result.assumed_wavelength_nm};
  for (std::size_t i = 0; i < material.values.size(); ++i) {
    const std::vector<double> own = result.by_wavelength(result.model.parameters()[i].name);
    if (own.size() < 2) continue;
    material.by_wavelength.resize(material.values.size());
    material.by_wavelength[i] = own;
  }
  return material;
}

FittedMaterial parse_fit(std::string_view text, const std::string& file) {
  const json root = json::parse(text, nullptr, false);
  if (root.is_discarded()) throw input_error("{}: is no complete JSON; expected a fit.json", file);
  const FitReader reader{file};
  const json& version = reader.at(root, "gonio_fit", "a fit.json of version 1");
  if (version != 1) throw input_error("{}: gonio_fit is not 1; expected a fit.json of version 1", file);
  FittedMaterial material;
  try {
    material.model = lobe_sum(reader.text(root, "model"));
    reader.options(root, material);
  } catch (const InputError& error) {
    const std::string_view message = error.what();
    if (message.starts_with(file)) throw;
    throw input_error("{}: {}", file, message);
  }
  reader.wavelengths(root, material);
  reader.parameters(root, material);
  const json& id = reader.at(root, "material", "a database id or null");
  if (!id.is_null()) {
    if (!id.is_string()) throw input_error("{}: material is no text; expected a database id or null", file);
    material.material = SurfaceMaterial(id.get<std::string>()).id();
  }
  return material;
}

FittedMaterial read_fit(const std::filesystem::path& path) { return parse_fit(read_file(path), path.string()); }

}  // namespace gonio
