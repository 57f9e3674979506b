#include "brdf/lobe_sum.h"

#include <algorithm>
#include <mutex>
#include <set>

#include "base/error.h"

namespace gonio {
namespace {

/// Suffixed names live as long as the program, like those of the models.
std::string_view kept(std::string name) {
  static std::set<std::string, std::less<>> names;
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  return *names.insert(std::move(name)).first;
}

bool is_linear(const ParameterInfo& p) { return p.name == "kd" || p.name == "ks"; }

}  // namespace

LobeSum::LobeSum(std::vector<ModelSpec> lobes) : lobes_(std::move(lobes)) {
  if (lobes_.empty() || lobes_.size() > kMostLobes)
    throw input_error("a sum of {} lobes: cannot be; expected 1 to {}", lobes_.size(), kMostLobes);
  if (!is_sum()) {
    parameters_ = first().info().parameters;
    for (std::size_t i = 0; i < parameters_.size(); ++i) places_.push_back({0, i});
    return;
  }
  for (const ModelSpec& lobe : lobes_)
    if (lobe.id == ModelId::lambert || lobe.id == ModelId::mirror)
      throw input_error("{}: {} is no lobe to add (a sum has kd already); expected models with a lobe", name(),
                        lobe.info().name);
  const auto take = [&](std::size_t lobe, std::size_t at, const std::string& suffix) {
    ParameterInfo info = lobes_[lobe].info().parameters[at];
    if (!suffix.empty()) info.name = kept(std::string(info.name) + suffix);
    parameters_.push_back(info), places_.push_back({lobe, at});
  };
  const auto suffix = [](std::size_t lobe) { return fmt::format("_{}", lobe + 1); };
  for (std::size_t j = 0; j < lobes_.size(); ++j)
    for (std::size_t i = 0; i < lobes_[j].info().parameters.size(); ++i)
      if (!is_linear(lobes_[j].info().parameters[i])) take(j, i, suffix(j));
  take(0, first().info().index_of("kd"), "");
  for (std::size_t j = 0; j < lobes_.size(); ++j) take(j, lobes_[j].info().index_of("ks"), suffix(j));
}

std::string LobeSum::name() const {
  std::string names;
  for (const ModelSpec& lobe : lobes_) names += fmt::format("{}{}", names.empty() ? "" : "+", lobe.info().name);
  return names;
}

std::string LobeSum::described() const {
  std::string names;
  for (const ModelSpec& lobe : lobes_)
    names += fmt::format("{}{}{}", names.empty() ? "" : " + ", lobe.info().name, lobe.retro ? " (turned back)" : "");
  return names;
}

std::string LobeSum::variant() const {
  std::string names;
  for (const ModelSpec& lobe : lobes_) names += fmt::format("{}{}", names.empty() ? "" : "+", lobe.variant());
  return names;
}

std::size_t LobeSum::index_of(std::string_view parameter) const {
  std::string known;
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    if (parameters_[i].name == parameter) return i;
    known += fmt::format("{}{}", known.empty() ? "" : ", ", parameters_[i].name);
  }
  throw input_error("{}: unknown parameter of {}; expected {}", parameter, name(), known);
}

bool LobeSum::needs_wavelength() const {
  return std::any_of(lobes_.begin(), lobes_.end(), [](const ModelSpec& lobe) { return lobe.info().needs_wavelength; });
}

std::vector<double> LobeSum::values_of(std::size_t lobe, std::span<const double> values) const {
  std::vector<double> own(lobes_[lobe].info().parameters.size(), 0.0);
  for (std::size_t i = 0; i < places_.size(); ++i)
    if (places_[i].lobe == lobe) own[places_[i].parameter] = values[i];
  return own;
}

void LobeSum::check(std::span<const double> values) const {
  for (std::size_t j = 0; j < lobes_.size(); ++j) check_values(lobes_[j], values_of(j, values));
}

bool LobeSum::set(std::string_view setting, std::string_view value) {
  ModelSpec* lobe = &lobes_.front();
  std::string_view name = setting;
  if (is_sum()) {
    const std::size_t dash = setting.rfind('_');
    name = setting.substr(0, dash);
    const std::string_view number = dash == setting.npos ? std::string_view() : setting.substr(dash + 1);
    lobe = nullptr;
    for (std::size_t j = 0; j < lobes_.size(); ++j)
      if (number == std::to_string(j + 1)) lobe = &lobes_[j];
  }
  if (name != "shadowing" && name != "variant" && name != "retro") return false;
  if (lobe == nullptr)
    throw input_error("{}={}: of which lobe; expected {}_1 to {}_{}", setting, value, name, name, lobes_.size());
  if (name == "shadowing")
    set_shadowing(*lobe, value);
  else if (name == "variant")
    set_variant(*lobe, value);
  else
    set_retro(*lobe, value);
  return true;
}

LobeSum lobe_sum(std::string_view names) {
  std::vector<ModelSpec> lobes;
  for (std::size_t from = 0; from <= names.size();) {
    const std::size_t end = std::min(names.find('+', from), names.size());
    ModelSpec lobe;
    lobe.id = model(names.substr(from, end - from)).id;
    lobes.push_back(lobe);
    from = end + 1;
  }
  return LobeSum(std::move(lobes));
}

std::vector<Brdf<double>> make_brdfs(const LobeSum& sum, std::span<const double> values) {
  std::vector<Brdf<double>> brdfs;
  for (std::size_t j = 0; j < sum.lobes().size(); ++j)
    brdfs.push_back(make_brdf<double>(sum.lobes()[j], sum.values_of(j, values)));
  return brdfs;
}

}  // namespace gonio
