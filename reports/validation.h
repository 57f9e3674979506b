#pragma once
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "energy/limits.h"
#include "fit/fit.h"
#include "fit/plots.h"

namespace gonio {

struct ValidationSettings {
  int spp = 512;    ///< paths a pixel of the renders
  int starts = 16;  ///< starts of each fit
  std::uint64_t seed = 1;
  int threads = 0;
  std::function<void(const std::string&)> progress{};  ///< one line a step
};

/// A model tried on a measurement: its fit, or why it could not be fitted.
struct Trial {
  std::string name;
  int free_parameters = 0;
  std::optional<FitResult> fit;
  std::string skipped;
};

/// A picture or plot in the measurement's folder.
struct Picture {
  std::string file, caption;
};

/// All that a validation finds of one measurement; the files lie in DIR/<id>.
struct MaterialReport {
  std::string id;
  Measurement measurement;
  std::vector<Trial> trials;
  std::size_t chosen = 0;
  std::string choice;  ///< why this model, in a sentence
  std::vector<Picture> plots, renders;
  Limits limits;
  double scale_to_limit = 1;  ///< kd and ks times this keep (43); 1 when the fit does

  const FitResult& fit() const { return *trials[chosen].fit; }
};

/// Fit -> limits -> table -> renders of one measurement, written into `folder` (made).
MaterialReport validate_measurement(const Measurement& measurement, const std::filesystem::path& folder,
                                    const ValidationSettings& settings);

/// The self-contained page; `folder` holds one sub-folder a report.
std::string validation_page(const std::vector<MaterialReport>& reports, const std::filesystem::path& folder);

nlohmann::ordered_json to_json(const MaterialReport& report);

}  // namespace gonio
