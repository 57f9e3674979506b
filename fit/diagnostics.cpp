#include "fit/diagnostics.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "energy/directional_reflectance.h"
#include "fit/fit.h"
#include "fit/fitted_material.h"
#include "fit/plausibility.h"
#include "fit/robust.h"

namespace gonio {
namespace {

constexpr double kLeastSpread = 1e-4;  // 0.02 %, below which no instrument tells anything: exact data have no outliers

/// At most `count` of the values, the first and the last among them.
std::vector<double> few_of(const std::vector<double>& values, std::size_t count) {
  if (values.size() <= count) return values;
  std::vector<double> few;
  for (std::size_t k = 0; k < count; ++k) few.push_back(values[k * (values.size() - 1) / (count - 1)]);
  return few;
}

/// The light's azimuth from the grain, of the first row at an incidence.
double azimuth_at(const Measurement& scan, double theta_i_deg) {
  const auto row = std::find_if(scan.points.begin(), scan.points.end(),
                                [&](const ScanPoint& p) { return std::abs(p.theta_i_deg - theta_i_deg) < 1e-3; });
  return row == scan.points.end() ? 0 : row->phi_i_deg;
}

std::string place(const FittedPoint& p) {
  return fmt::format("theta_i {:g}, theta_o {:g}, phi {:g} degrees{}", p.theta_i_deg, p.theta_o_deg, p.phi_deg,
                     p.wavelength_nm == p.wavelength_nm ? fmt::format(", {:g} nm", p.wavelength_nm) : "");
}

void say_outliers(const FitResult& result, FitDiagnostics& found) {
  const Outliers& outliers = found.outliers;
  if (outliers.count == 0) return;
  const Outlier& worst = outliers.largest.front();
  found.warnings.push_back(
      fmt::format("{} of {} points lie further than {:g} robust standard deviations ({:.2g} in log10) from the rest "
                  "({:.1g} expected of "
                  "normal errors); the furthest, {:.3g} of them, at {}",
                  outliers.count, outliers.points, Outliers::kDeviations, outliers.spread_log10, outliers.expected(),
                  worst.deviations, place(result.points[worst.point])));
}

void say_energy(FitDiagnostics& found) {
  if (!found.energy || !(found.energy->largest > 1 + found.energy->error)) return;
  const FitEnergy& e = *found.energy;
  found.warnings.push_back(
      fmt::format("the fit reflects more than the light, kd + ks E = {:.4g} at incidence {:g} degrees{}", e.largest,
                  e.theta_i_deg, e.wavelength_nm ? fmt::format(" and {:g} nm", *e.wavelength_nm) : ""));
}

void say_reciprocity(const FitResult& result, FitDiagnostics& found) {
  auto broken = reciprocity_broken(found.repeats, found.reciprocal);
  if (!broken) return;
  if (found.model_reciprocal)
    *broken += fmt::format("; {} is reciprocal and can follow neither side", result.model.name());
  found.warnings.push_back(*broken);
}

}  // namespace

std::optional<double> log10_residual(const FitResult& result, std::size_t point) {
  const FittedPoint& p = result.points[point];
  const double measured = p.measured_per_sr + result.floor_per_sr, fitted = p.fitted_per_sr + result.floor_per_sr;
  if (!(p.measured_per_sr > 0 && fitted > 0)) return std::nullopt;
  return std::log10(fitted / measured);
}

bool Outliers::far(double log10_ratio) const {
  return std::abs(log10_ratio - median_log10) > kDeviations * std::max(spread_log10, kLeastSpread);
}

Outliers find_outliers(const FitResult& result) {
  std::vector<double> residuals;
  std::vector<std::size_t> places;
  for (std::size_t k = 0; k < result.points.size(); ++k)
    if (const auto residual = log10_residual(result, k); residual && result.points[k].used)
      residuals.push_back(*residual), places.push_back(k);
  Outliers found;
  found.points = static_cast<int>(residuals.size());
  found.median_log10 = median(residuals);
  found.spread_log10 = robust_spread(residuals, found.median_log10);
  for (std::size_t k = 0; k < residuals.size(); ++k)
    if (found.far(residuals[k]))
      found.largest.push_back(
          {places[k], residuals[k],
           std::abs(residuals[k] - found.median_log10) / std::max(found.spread_log10, kLeastSpread)});
  found.count = static_cast<int>(found.largest.size());
  std::stable_sort(found.largest.begin(), found.largest.end(),
                   [](const Outlier& a, const Outlier& b) { return a.deviations > b.deviations; });
  found.largest.resize(std::min(found.largest.size(), Outliers::kListed));
  return found;
}

std::optional<FitEnergy> fit_energy(const Measurement& scan, const FitResult& result) {
  if (result.quantity == "relative") return std::nullopt;
  const FittedMaterial material = fitted_material(result);
  std::vector<std::optional<double>> wavelengths{result.assumed_wavelength_nm};
  if (!result.wavelength_nm.empty()) {
    const std::vector<double> few = few_of(result.wavelength_nm, 3);
    wavelengths.assign(few.begin(), few.end());
  }
  FitEnergy worst;
  for (const double theta : few_of(scan.incidences_deg, 4))
    for (const std::optional<double>& nm : wavelengths) {
      const Interface<double> surface = material.surface(nm);
      const double um = nm ? *nm * 1e-3 : 1;
      const std::vector<Brdf<double>> lobes = material.brdfs(nm);
      FitEnergy here{kPi<double> * evaluate_diffuse(lobes.front(), surface), 0, theta, nm};
      for (const Brdf<double>& brdf : lobes) {
        if (!(brdf.ks > 0)) continue;
        try {
          const Estimate e =
              directional_reflectance(brdf.lobe, theta, {{surface}, {um}}, 1e-4, azimuth_at(scan, theta)).front();
          here.largest += brdf.ks * e.value + coherent_energy(brdf, cos_deg(theta), surface, um);
          here.error += brdf.ks * e.error;
        } catch (const InputError&) {  // infinite
          return std::nullopt;
        }
      }
      if (here.largest - here.error > worst.largest - worst.error) worst = here;
    }
  return worst;
}

FitDiagnostics diagnose(const Measurement& scan, const FitResult& result,
                        const std::optional<std::string>& named_material) {
  FitDiagnostics found;
  found.outliers = find_outliers(result);
  found.energy = fit_energy(scan, result);
  found.repeats = repeats_of(scan), found.reciprocal = reciprocal_pairs_of(scan);
  const auto& lobes = result.model.lobes();
  found.model_reciprocal =
      std::all_of(lobes.begin(), lobes.end(), [](const ModelSpec& lobe) { return lobe.reciprocal(); });
  say_outliers(result, found), say_energy(found), say_reciprocity(result, found);
  for (const auto& list :
       {implausible_lobes(result), implausible_index(result, named_material ? named_material : scan.material)})
    found.warnings.insert(found.warnings.end(), list.begin(), list.end());
  return found;
}

}  // namespace gonio
