#pragma once
// What `gonio fit --model auto` says of its choice.
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "assess/sphere_difference.h"
#include "cli/fit_options.h"
#include "fit/choose.h"

namespace gonio::cli {

/// Moves the choice to the cheapest candidate whose lit sphere nowhere differs by more than `delta_e_2000` from that of the best one, where
/// that is cheaper than what the data ask for, and says so. Returns what each candidate looks like beside the best.
std::vector<VisibleError> content_with(ModelChoice& choice, double delta_e_2000);

/// What --model auto comes to: the fit, what is to be written of it, and the choice.
struct ChosenFit {
  FitResult result;
  nlohmann::ordered_json json;
  ModelChoice choice;
  std::vector<VisibleError> seen;  ///< empty without a tolerance
};
/// InputError for options that are one model's own (--set, --free, --variant).
ChosenFit chosen_fit(const Measurement& scan, const FitOptions& options, std::uint64_t seed,
                     std::optional<double> tolerance,
                     const std::function<void(const std::string& what, int done, int count)>& progress = {});
/// The same for a batch's first look at its options.
void refuse_own_options(const FitOptions& options);

/// `seen` is empty where no tolerance was asked for.
nlohmann::ordered_json choice_json(const ModelChoice& choice, const std::vector<VisibleError>& seen);
std::string choice_csv(const ModelChoice& choice, const std::vector<VisibleError>& seen);
void print_choice(const ModelChoice& choice, const std::vector<VisibleError>& seen);

}  // namespace gonio::cli
