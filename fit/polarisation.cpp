#include "fit/polarisation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "brdf/polarised.h"
#include "fit/fitted_material.h"

namespace gonio {
namespace {

/// The Mueller matrix of lobes that add up, normalised by its first element.
Mueller<double> normalised(const LobesOnSurface& at, const ScanPoint& p) {
  const Directions<double> w = directions_from_deg(p.theta_i_deg, p.theta_o_deg, p.phi_deg(), p.phi_i_deg);
  const Azimuth<double> azimuth = azimuth_from_deg(p.phi_deg());
  Mueller<double> sum = evaluate_mueller(at.lobes[0], w, azimuth, at.surface, at.wavelength_um);
  for (std::size_t l = 1; l < at.lobes.size(); ++l)
    sum += evaluate_mueller(at.lobes[l], w, azimuth, at.surface, at.wavelength_um);
  const double all = sum.m[0][0];
  for (auto& row : sum.m)
    for (double& element : row) element = all > 0 ? element / all : 0;
  return sum;
}

double root_mean(double squares, int points) { return points > 0 ? std::sqrt(squares / points) : 0; }

}  // namespace

MuellerJudgement judge_polarisation(const Measurement& scan, const FitResult& result) {
  MuellerJudgement judgement;
  if (scan.mueller_names.empty()) return judgement;
  const FittedMaterial material = fitted_material(result);
  std::map<double, LobesOnSurface> known;
  std::vector<double> measured(scan.mueller_names.size(), 0.0), residual = measured;
  std::vector<int> points(scan.mueller_names.size(), 0);
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const ScanPoint& p = scan.points[i];
    if (!result.points[i].used && !result.points[i].held_out) continue;
    const double nm = result.evaluated_at_nm(p.wavelength_nm);
    if (!known.contains(nm)) known.emplace(nm, material.at(nm));
    const LobesOnSurface& at = known.at(nm);
    judgement.stated = std::all_of(at.lobes.begin(), at.lobes.end(),
                                   [](const Brdf<double>& lobe) { return lobe.ks == 0 || states_polarisation(lobe); });
    if (!judgement.stated) return judgement;
    const Mueller<double> fitted = normalised(at, p);
    for (std::size_t e = 0; e < p.mueller.size(); ++e) {
      if (std::isnan(p.mueller[e])) continue;
      const std::string& name = scan.mueller_names[e];
      measured[e] += square(p.mueller[e]), residual[e] += square(fitted.m[name[1] - '1'][name[2] - '1'] - p.mueller[e]);
      ++points[e];
    }
  }
  double all_measured = 0, all_residual = 0;
  int all = 0;
  for (std::size_t e = 0; e < points.size(); ++e) {
    judgement.elements.push_back(
        {scan.mueller_names[e], points[e], root_mean(measured[e], points[e]), root_mean(residual[e], points[e])});
    all_measured += measured[e], all_residual += residual[e], all += points[e];
  }
  judgement.rms_measured = root_mean(all_measured, all), judgement.rms_residual = root_mean(all_residual, all);
  return judgement;
}

std::string sentence(const MuellerJudgement& j) {
  if (j.elements.empty()) return "";
  return fmt::format("polarisation, which was not fitted: Mueller elements of rms {:.3g} are predicted to {:.3g}",
                     j.rms_measured, j.rms_residual);
}

nlohmann::ordered_json to_json(const MuellerJudgement& j, const Measurement& scan) {
  using Json = nlohmann::ordered_json;
  if (scan.mueller_names.empty()) return nullptr;
  Json elements = Json::array();
  for (const MuellerResidual& e : j.elements)
    elements.push_back({{"element", e.element},
                        {"points", e.points},
                        {"rms_measured", e.rms_measured},
                        {"rms_residual", e.rms_residual}});
  return {
      {"stated", j.stated}, {"rms_measured", j.rms_measured}, {"rms_residual", j.rms_residual}, {"elements", elements}};
}

}  // namespace gonio
