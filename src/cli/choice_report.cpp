#include "cli/choice_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <iostream>

#include "base/error.h"
#include "cli/diagnosed.h"
#include "fit/fitted_material.h"

namespace gonio::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Wavelengths at which a fit can be looked at: of the visible range where the database carries it, else its own.
std::vector<double> visible_nm(const FittedMaterial& material) {
  std::vector<double> all;
  for (double nm = 380; nm <= 720; nm += 20) {
    try {
      material.surface(material.wavelength(nm));
      all.push_back(nm);
    } catch (const InputError&) {  // beyond the fit or the material's data
    }
  }
  if (!all.empty()) return all;
  return {material.wavelength({}).value_or(550)};
}

BrdfOfPair function_of(const FittedMaterial& material, const std::vector<double>& wavelengths_nm) {
  std::vector<LobesOnSurface> at;
  for (const double nm : wavelengths_nm) at.push_back(material.at(nm));
  return [at](const UnitVector<double>& i, const UnitVector<double>& o, std::size_t w) {
    return at[w].f_per_sr(reduce(i.x, i.y, i.z, o.x, o.y, o.z));
  };
}

bool retro_of(const LobeSum& model) {
  return std::any_of(model.lobes().begin(), model.lobes().end(), [](const ModelSpec& lobe) { return lobe.retro; });
}

}  // namespace

Json choice_json(const ModelChoice& choice, const std::vector<VisibleError>& seen) {
  Json candidates = Json::array();
  for (std::size_t i = 0; i < choice.candidates.size(); ++i) {
    const Candidate& c = choice.candidates[i];
    candidates.push_back({{"model", c.result.model.name()},
                          {"retro", retro_of(c.result.model)},
                          {"parameters", c.parameters},
                          {"rms_log10", c.result.all.rms_log10},
                          {"held_out_rms_log10", c.held_out_log10},
                          {"worse_than_best", c.worse},
                          {"standard_error", c.uncertain},
                          {"told_apart", c.told_apart},
                          {"aicc", c.aicc},
                          {"bic", c.bic}});
    if (!seen.empty()) candidates.back()["delta_e_2000"] = {{"mean", seen[i].mean}, {"largest", seen[i].largest}};
  }
  return {{"sentence", choice.sentence},
          {"folds", choice.folds},
          {"best", choice.best},
          {"chosen", choice.chosen},
          {"candidates", candidates}};
}

std::string choice_csv(const ModelChoice& choice, const std::vector<VisibleError>& seen) {
  std::string csv =
      "model,retro,parameters,rms_log10,held_out_rms_log10,worse_than_best,standard_error,told_apart,aicc,bic";
  csv += seen.empty() ? "\n" : ",mean_delta_e_2000,largest_delta_e_2000\n";
  for (std::size_t i = 0; i < choice.candidates.size(); ++i) {
    const Candidate& c = choice.candidates[i];
    csv += fmt::format("{},{},{},{:.6g},{:.6g},{:.6g},{:.6g},{},{:.8g},{:.8g}", c.result.model.name(),
                       retro_of(c.result.model) ? "yes" : "no", c.parameters, c.result.all.rms_log10, c.held_out_log10,
                       c.worse, c.uncertain, c.told_apart ? "yes" : "no", c.aicc, c.bic);
    csv += seen.empty() ? "\n" : fmt::format(",{:.4g},{:.4g}\n", seen[i].mean, seen[i].largest);
  }
  return csv;
}

void print_choice(const ModelChoice& choice, const std::vector<VisibleError>& seen) {
  const double aicc = std::min_element(choice.candidates.begin(), choice.candidates.end(), [](auto& a, auto& b) {
                        return a.aicc < b.aicc;
                      })->aicc;
  const double bic = std::min_element(choice.candidates.begin(), choice.candidates.end(), [](auto& a, auto& b) {
                       return a.bic < b.bic;
                     })->bic;
  std::size_t width = 0;
  for (const Candidate& c : choice.candidates) width = std::max(width, c.result.model.described().size());
  std::cout << fmt::format("{:<{}} {:>10} {:>10} {:>10} {:>22} {:>10} {:>10}{}\n", "model", width, "parameters",
                           "rms_log10", "held out", "excess over the best", "AICc", "BIC",
                           seen.empty() ? "" : "  largest dE");
  for (std::size_t i = 0; i < choice.candidates.size(); ++i) {
    const Candidate& c = choice.candidates[i];
    std::cout << fmt::format(
        "{:<{}} {:>10} {:>10.3g} {:>10.3g} {:>22} {:>10.4g} {:>10.4g}{}{}\n", c.result.model.described(), width,
        c.parameters, c.result.all.rms_log10, c.held_out_log10,
        i == choice.best ? std::string("best") : fmt::format("{:.2g} +- {:.2g}", c.worse, c.uncertain), c.aicc - aicc,
        c.bic - bic, seen.empty() ? std::string() : fmt::format(" {:>11.3g}", seen[i].largest),
        i == choice.chosen ? "  <- chosen" : "");
  }
  std::cout << choice.sentence << "\n\n";
}

std::vector<VisibleError> content_with(ModelChoice& choice, double delta_e_2000) {
  const FittedMaterial best = fitted_material(choice.candidates[choice.best].result);
  const std::vector<double> wavelengths_nm = visible_nm(best);
  const BrdfOfPair truth = function_of(best, wavelengths_nm);
  std::vector<VisibleError> seen;
  for (const Candidate& c : choice.candidates)
    seen.push_back(sphere_difference(truth, function_of(fitted_material(c.result), wavelengths_nm), wavelengths_nm));
  const auto enough =
      std::find_if(seen.begin(), seen.end(), [&](const VisibleError& e) { return e.largest <= delta_e_2000; });
  const auto cheapest = static_cast<std::size_t>(enough - seen.begin());
  if (cheapest >= choice.chosen) return seen;
  choice.chosen = cheapest;
  choice.sentence +=
      fmt::format("; for a tolerance of {:g} Delta E 2000 {} will do: on a lit sphere it differs by {:.2g} at most",
                  delta_e_2000, choice.candidates[cheapest].result.model.described(), seen[cheapest].largest);
  return seen;
}

void refuse_own_options(const FitOptions& o) {
  if (!o.settings.empty() || !o.free.empty() || !o.variant.empty())
    throw input_error(
        "--model auto: takes no --set, --free or --variant, which are a model's own; expected it without");
}

ChosenFit chosen_fit(const Measurement& scan, const FitOptions& options, std::uint64_t seed,
                     std::optional<double> tolerance,
                     const std::function<void(const std::string& what, int done, int count)>& progress) {
  refuse_own_options(options);
  ChosenFit chosen;
  chosen.choice =
      choose_model(scan, request_for(options, "lambert", seed, scan.aperture_deg), all_candidates(scan), progress);
  if (tolerance) chosen.seen = content_with(chosen.choice, *tolerance);
  chosen.result = chosen.choice.candidates[chosen.choice.chosen].result;
  chosen.json = diagnosed(scan, options, chosen.result);
  chosen.json["choice"] = choice_json(chosen.choice, chosen.seen);
  return chosen;
}

}  // namespace gonio::cli
