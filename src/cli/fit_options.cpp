#include "cli/fit_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "cli/arguments.h"
#include "fit/formats/formats.h"
#include "fit/signature.h"

namespace gonio::cli {
namespace {

/// shadowing=…, variant=…, or a parameter to be held at a value (alpha = √2·m).
void apply_setting(const std::string& setting, FitRequest& request) {
  const std::size_t equals = setting.find('=');
  if (equals == setting.npos) throw input_error("{}: no setting; expected name=value", setting);
  const std::string name = setting.substr(0, equals), value = setting.substr(equals + 1);
  if (request.model.set(name, value)) return;
  const double number = number_in(value, name);
  const auto& parameters = request.model.parameters();
  const auto has = [&](std::string_view wanted) {
    return std::any_of(parameters.begin(), parameters.end(), [&](auto& p) { return p.name == wanted; });
  };
  if (name.starts_with("alpha") && !has(name) && has("m" + name.substr(5))) {  // alpha, or alpha_2 of a sum
    if (!request.held.emplace("m" + name.substr(5), number / std::sqrt(2.0)).second)
      throw input_error("{}: m is given too; expected one of the two", name);
    return;
  }
  request.model.index_of(name);  // refuses an unknown one
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
  return fmt::format("{}|{}|{}|{}|{}|{}|{}|{}|{}|{}|{}|{}|{}|{}|{}", metric, loss, weighting, variant, hold_out,
                     material, floor, intervals, aperture, source, noise, fmt::join(settings, ","),
                     fmt::join(free, ","), fmt::join(spectral, ","), starts) +
         (signature.empty() ? "" : fmt::format("|{}|{}", signature, signature_scale));
}

void add_fit_options(CLI::App& command, FitOptions& options) {
  command
      .add_option("--metric", options.metric, "log, linear, cuberoot or likelihood (residuals in standard deviations)")
      ->capture_default_str();
  command.add_option(
      "--noise", options.noise,
      "likelihood: standard deviation as a share of the value, 0.02 (default: as the scan states it, else "
      "from its repeats or reciprocal pairs)");
  command.add_option("--loss", options.loss, "none, huber or cauchy, with a width if it shall not be found: huber=0.1")
      ->capture_default_str();
  command.add_option("--weighting", options.weighting, "none (default of log) or cosine (default of the others)");
  command.add_option("--set", options.settings,
                     "shadowing=NAME, variant=NAME, retro=yes, or PARAMETER=VALUE to hold it");
  command.add_option("--variant", options.variant, "Variant of the model");
  command.add_option("--material", options.material, "Database id instead of the measurement's; `perfect` reflects 1");
  command
      .add_option("--per-wavelength", options.spectral,
                  "kd, ks or kd,ks: a value for each wavelength, the lobe's shape shared by all")
      ->delimiter(',');
  command.add_option("--aperture", options.aperture,
                     "Average the model over the detector's round aperture: full angle in degrees, or `stated`");
  command.add_option("--source", options.source, "The same of the source's disc: full angle in degrees");
  command.add_option(
      "--signature", options.signature,
      "Scan of the instrument's own beam (no sample, or a mirror), subtracted by the angle from the mirror direction");
  command
      .add_option("--signature-scale", options.signature_scale,
                  "What the signature is multiplied by: the sample's specular reflectance over that of the signature's")
      ->capture_default_str();
  command
      .add_option("--free", options.free,
                  "n: fit the refractive index (k = 0) where no material is known; n,k: both, as of a metal")
      ->delimiter(',');
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

Measurement cleaned(Measurement scan, const FitOptions& options) {
  if (options.signature.empty()) return scan;
  return without_signature(scan, Signature(read_any(options.signature)), options.signature_scale);
}

FitRequest request_for(const FitOptions& options, const std::string& model_name, std::uint64_t seed,
                       std::optional<double> aperture_deg) {
  FitRequest request;
  request.model = lobe_sum(model_name);
  request.metric = metric_from(options.metric);
  const std::size_t equals = options.loss.find('=');
  request.loss = loss_from(options.loss.substr(0, equals));
  if (equals != std::string::npos) {
    request.loss_width = number_in(options.loss.substr(equals + 1), "--loss");
    if (!(request.loss_width > 0)) throw input_error("--loss {}: no width; expected more than 0", options.loss);
  }
  if (!options.weighting.empty()) request.weighting = weighting_from(options.weighting);
  if (!options.floor.empty()) request.floor_per_sr = number_in(options.floor, "--floor");
  if (!options.variant.empty()) request.model.set("variant", options.variant);
  if (!options.material.empty()) request.material = options.material;
  for (const std::string& setting : options.settings) apply_setting(setting, request);
  for (const std::string& parameter : options.free) {
    if (parameter != "n" && parameter != "k")
      throw input_error("--free {}: cannot be freed; expected n, or n,k", parameter);
    (parameter == "n" ? request.free_n : request.free_k) = true;
  }
  request.spectral = options.spectral;
  if (!options.noise.empty()) {
    request.relative_sd = number_in(options.noise, "--noise");
    if (!(request.relative_sd > 0 && request.relative_sd < 10))
      throw input_error("--noise {}: no share; expected more than 0, less than 10", options.noise);
    if (request.metric != Metric::likelihood)
      throw input_error("--noise {}: metric {} does not look at it; expected --metric likelihood", options.noise,
                        options.metric);
  }
  if (options.aperture == "stated") {
    if (!aperture_deg)
      throw input_error("--aperture stated: the measurement states none; expected aperture_deg in measurement.yaml");
    request.aperture.detector_deg = *aperture_deg;
  } else if (!options.aperture.empty()) {
    request.aperture.detector_deg = number_in(options.aperture, "--aperture");
  }
  if (!options.source.empty()) request.aperture.source_deg = number_in(options.source, "--source");
  apply_hold_out(options.hold_out, request);
  request.starts = options.starts;
  request.seed = seed;
  request.profile_intervals = options.intervals == "profile";
  return request;
}

}  // namespace gonio::cli
