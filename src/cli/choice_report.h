#pragma once
// What `gonio fit --model auto` says of its choice.
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "assess/sphere_difference.h"
#include "fit/choose.h"

namespace gonio::cli {

/// Moves the choice to the cheapest candidate whose lit sphere nowhere differs by more than `delta_e_2000` from that of the best one, where
/// that is cheaper than what the data ask for, and says so. Returns what each candidate looks like beside the best.
std::vector<VisibleError> content_with(ModelChoice& choice, double delta_e_2000);

/// `seen` is empty where no tolerance was asked for.
nlohmann::ordered_json choice_json(const ModelChoice& choice, const std::vector<VisibleError>& seen);
std::string choice_csv(const ModelChoice& choice, const std::vector<VisibleError>& seen);
void print_choice(const ModelChoice& choice, const std::vector<VisibleError>& seen);

}  // namespace gonio::cli
