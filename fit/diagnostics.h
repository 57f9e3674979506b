#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "fit/scan_quality.h"

namespace gonio {

struct FitResult;

/// A point that the fit misses by far more than it misses the others.
struct Outlier {
  std::size_t point = 0;   ///< in FitResult::points
  double log10_ratio = 0;  ///< log10((fitted + f0)/(measured + f0))
  double deviations = 0;   ///< from the median of all, in robust standard deviations
};

/// Residuals of the used points with positive values, by medians, and those beyond 5 standard deviations (of normal
/// errors 5.7e-7).
struct Outliers {
  static constexpr double kDeviations = 5, kFalseAlarm = 5.733e-7;  // erfc(5/√2)
  static constexpr std::size_t kListed = 20;

  double median_log10 = 0, spread_log10 = 0;  ///< spread: 1.4826 times the median absolute deviation
  int points = 0, count = 0;
  std::vector<Outlier> largest;  ///< at most kListed, the furthest first

  double expected() const { return kFalseAlarm * points; }  ///< of normal errors
  bool far(double log10_ratio) const;                       ///< whether a residual lies beyond
};

/// log10((fitted + f0)/(measured + f0)) of a point; none where the measured value is not positive.
std::optional<double> log10_residual(const FitResult& result, std::size_t point);

Outliers find_outliers(const FitResult& result);

/// Largest share of the light that a fit reflects, kd·ρd + Σ ks·(E + coherent), over the scan's incidences and
/// wavelengths.
struct FitEnergy {
  double largest = 0, error = 0;
  double theta_i_deg = 0;
  std::optional<double> wavelength_nm;
};

/// Up to 4 incidences (the first and the last among them) and 3 wavelengths, E to 1e-4. None for a relative scan, or
/// where a lobe's E is infinite.
std::optional<FitEnergy> fit_energy(const Measurement& measurement, const FitResult& result);

/// What to ask of a fit before its numbers are used.
struct FitDiagnostics {
  Outliers outliers;
  std::optional<FitEnergy> energy;
  PairStatistics repeats, reciprocal;  ///< of the measurement
  bool model_reciprocal = true;        ///< every lobe of the model claims it
  std::vector<std::string> warnings;   ///< a sentence each, where there is something to say
};

/// A call of its own after a fit, not a part of it: choosing among models fits hundreds of times. `named_material`:
/// what n is compared with where it was fitted; else the measurement's.
FitDiagnostics diagnose(const Measurement& measurement, const FitResult& result,
                        const std::optional<std::string>& named_material = std::nullopt);

}  // namespace gonio
