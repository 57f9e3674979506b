#include "cli/fit_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "cli/arguments.h"

namespace gonio::cli {
namespace {

/// shadowing=…, variant=…, or a parameter to be held at a value (alpha = √2·m).
void apply_setting(const std::string& setting, FitRequest& request) {
  const std::size_t equals = setting.find('=');
  if (equals == setting.npos) throw input_error("{}: no setting; expected name=value", setting);
  const std::string name = setting.substr(0, equals), value = setting.substr(equals + 1);
  if (name == "shadowing") return set_shadowing(request.model, value);
  if (name == "variant") return set_variant(request.model, value);
  if (name == "retro") return set_retro(request.model, value);
  const double number = number_in(value, name);
  const auto& parameters = request.model.info().parameters;
  const bool has_m = std::any_of(parameters.begin(), parameters.end(), [](auto& p) { return p.name == "m"; });
  if (name == "alpha" && has_m) {
    if (!request.held.emplace("m", number / std::sqrt(2.0)).second)
      throw input_error("alpha: m is given too; expected one of the two");
    return;
  }
  request.model.info().index_of(name);  // refuses an unknown one
  if (!request.held.emplace(name, number).second)
    throw input_error("{}: given twice; expected once (alpha = sqrt(2) m)", name);
}

void apply_hold_out(const std::string& text, FitRequest& request) {
  if (text == "middle") return;
  request.hold_out = text == "none" ? HoldOut::none : HoldOut::chosen;
  if (text != "none") request.hold_out_deg = number_in(text, "--hold-out");
}

}  // namespace

std::string FitOptions::words() const {
  return fmt::format("{}|{}|{}|{}|{}|{}|{}|{}|{}|{}|{}", metric, loss, weighting, variant, hold_out, material, floor,
                     intervals, fmt::join(settings, ","), fmt::join(free, ","), starts);
}

void add_fit_options(CLI::App& command, FitOptions& options) {
  command.add_option("--metric", options.metric, "log, linear or cuberoot")->capture_default_str();
  command.add_option("--loss", options.loss, "none, huber or cauchy, with a width if it shall not be found: huber=0.1")
      ->capture_default_str();
  command.add_option("--weighting", options.weighting, "none (default of log) or cosine (default of the others)");
  command.add_option("--set", options.settings,
                     "shadowing=NAME, variant=NAME, retro=yes, or PARAMETER=VALUE to hold it");
  command.add_option("--variant", options.variant, "Variant of the model");
  command.add_option("--material", options.material, "Database id instead of the measurement's; `perfect` reflects 1");
  command.add_option("--free", options.free, "n: fit the refractive index (k = 0) where no material is known");
  command.add_option(
      "--floor", options.floor,
      "f0 per sr of the log metric (default: smallest stated deviation, else 1e-3 of the smallest value)");
  command.add_option("--starts", options.starts, "Number of starts")->check(CLI::Range(1, 4096))->capture_default_str();
  command
      .add_option("--hold-out", options.hold_out, "Incidence angle in degrees to leave out of the fit; middle; none")
      ->capture_default_str();
  command
      .add_option("--intervals", options.intervals,
                  "curvature (Student's, of the logarithm) or profile (of the likelihood)")
      ->check(CLI::IsMember({"curvature", "profile"}))
      ->capture_default_str();
}

FitRequest request_for(const FitOptions& options, const std::string& model_name, std::uint64_t seed) {
  FitRequest request;
  request.model.id = model(model_name).id;
  request.metric = metric_from(options.metric);
  const std::size_t equals = options.loss.find('=');
  request.loss = loss_from(options.loss.substr(0, equals));
  if (equals != std::string::npos) {
    request.loss_width = number_in(options.loss.substr(equals + 1), "--loss");
    if (!(request.loss_width > 0)) throw input_error("--loss {}: no width; expected more than 0", options.loss);
  }
  if (!options.weighting.empty()) request.weighting = weighting_from(options.weighting);
  if (!options.floor.empty()) request.floor_per_sr = number_in(options.floor, "--floor");
  if (!options.variant.empty()) set_variant(request.model, options.variant);
  if (!options.material.empty()) request.material = options.material;
  for (const std::string& setting : options.settings) apply_setting(setting, request);
  for (const std::string& parameter : options.free) {
    if (parameter != "n") throw input_error("--free {}: cannot be freed; expected n", parameter);
    request.free_n = true;
  }
  apply_hold_out(options.hold_out, request);
  request.starts = options.starts;
  request.seed = seed;
  request.profile_intervals = options.intervals == "profile";
  return request;
}

}  // namespace gonio::cli
