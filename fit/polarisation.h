#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "fit/fit.h"

namespace gonio {

/// One element of the normalised Mueller matrix, measured and as the fit has it: f_r alone was fitted, so that this judges it by what it has
/// not seen.
struct MuellerResidual {
  std::string element;  ///< "m12" … "m44"
  int points = 0;
  double rms_measured = 0, rms_residual = 0;  ///< of the element; of fitted less measured
};

struct MuellerJudgement {
  bool stated = false;  ///< whether every lobe says what becomes of polarisation; no residuals if not
  std::vector<MuellerResidual> elements;
  double rms_measured = 0, rms_residual = 0;  ///< over all elements
};

/// Of the points that were fitted or held out; empty where the scan has no Mueller elements.
MuellerJudgement judge_polarisation(const Measurement& scan, const FitResult& result);

/// One line for people; empty where there is nothing to say.
std::string sentence(const MuellerJudgement& judgement);
/// null where the scan has no Mueller elements.
nlohmann::ordered_json to_json(const MuellerJudgement& judgement, const Measurement& scan);

}  // namespace gonio
