#pragma once
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "brdf/lobe_sum.h"
#include "fit/aperture.h"
#include "fit/next_measurement.h"
#include "fit/problem.h"
#include "fit/scan.h"

namespace gonio {

/// What is left out of the fit, to judge it by.
enum class HoldOut { middle_incidence, none, chosen };

struct FitRequest {
  LobeSum model;
  Metric metric = Metric::log;
  std::optional<Weighting> weighting;  ///< default: none under log, cosine under linear and cuberoot
  std::optional<double>
      floor_per_sr;  ///< f0; default: the smallest stated standard deviation, else 1e-3 of the smallest value
  int starts = 16;
  bool sums = true;  ///< whether a choice of model (fit/choose.h) tries sums of lobes
  std::uint64_t seed = 1;
  HoldOut hold_out = HoldOut::middle_incidence;  ///< middle_incidence leaves nothing out below three incidence angles
  double hold_out_deg = 0;                       ///< for HoldOut::chosen: the nearest incidence angle
  std::optional<std::string> material;           ///< instead of the measurement's; `perfect` reflects 1
  std::vector<std::string> spectral;             ///< "kd", "ks": parameters of their own at each wavelength
  Aperture aperture;                             ///< what the model is averaged over before it is compared
  /// Metric::likelihood: standard deviation as a share s of |y| + f0 (values that came out low count for more: f comes
  /// out low by about s²); 0: as the scan states it, else from its repeats or reciprocal pairs.
  double relative_sd = 0;
  bool free_n = false;                 ///< fits n (k = 0, box 1.01 to 3) instead of taking a material
  bool free_k = false;                 ///< fits k too (n 0.02 to 10, k 1e-3 to 15)
  std::map<std::string, double> held;  ///< parameters held at a value
  std::vector<double> begin;           ///< values of the model's parameters where one more start begins
  Loss loss = Loss::none;              ///< what becomes of large residuals
  double loss_width =
      0;  ///< in the residuals' unit; 0: Huber's 1.345 or Cauchy's 2.385 times their spread in a first fit
  bool profile_intervals = false;  ///< intervals of the profile likelihood (fit/profile_likelihood.h)
  std::function<void(int done, int count)> progress;  ///< called from any thread, one call at a time
};

/// A fitted number. Intervals are 95 %: Student's in the logarithm of the parameter, or those of the profile likelihood.
struct FittedParameter {
  std::string name, unit;
  double value = 0;
  std::optional<double> standard_error;  ///< absent when held, at a bound or not identifiable
  double lo95 = 0, hi95 = 0;             ///< the search box where there is no standard error
  bool held = false, at_bound = false, identifiable = true;
  std::string interval95_kind = "curvature";  ///< or "profile": of the profile likelihood
  bool lo_open = false, hi_open = false;      ///< of a profile: the search box ended first
  std::size_t group = kShared;  ///< the place in wavelength_nm that it belongs to, where kd or ks are spectral

  static constexpr std::size_t kShared = FreeParameter::kShared;
};

/// Errors of a set of points: rms in the metric's own unit, rms_log10 of log10((f + f0)/(y + f0)) over positive y.
struct Residuals {
  int points = 0;
  double rms = 0, rms_log10 = 0, mean_log10 = 0;  ///< mean_log10 > 0: the model is too bright
};
struct IncidenceResiduals : Residuals {
  double theta_i_deg = 0;
  bool held_out = false;
};

/// A point as fitted, for plots and tables.
struct FittedPoint {
  double theta_i_deg = 0, theta_o_deg = 0, phi_deg = 0, wavelength_nm = kNotStated;
  double measured_per_sr = 0, fitted_per_sr = 0;
  std::size_t incidence = 0;
  bool used = false, held_out = false;
};

struct FitResult {
  LobeSum model;
  Metric metric = Metric::log;
  Weighting weighting = Weighting::none;
  Aperture aperture;
  double relative_sd = 0;  ///< of the request, or as estimated
  std::optional<double>
      chi2_reduced;  ///< Metric::likelihood: Σ residual²/(points - parameters), 1 where model and errors are right
  Loss loss = Loss::none;
  double loss_width = 0;
  double floor_per_sr = 0;

  std::optional<std::string> material;  ///< full database id
  std::vector<double> wavelength_nm;    ///< empty: not stated
  std::optional<double> assumed_wavelength_nm;
  std::vector<FittedParameter>
      parameters;  ///< in the model's order, those of each wavelength in a row; then n and k where they were fitted
  bool converged = false;

  Residuals all;
  std::vector<IncidenceResiduals> by_incidence;
  bool incidences_binned = false;  ///< theta_i_deg are the middles of 10° bins
  std::optional<IncidenceResiduals> held_out;
  double neighbour_correlation = 0;  ///< of residuals next to each other in the scan; 0 for independent errors
  std::vector<std::string> correlation_names;
  std::vector<std::vector<double>> correlation;
  double condition = 0;  ///< largest singular value of the column-scaled Jacobian over its smallest

  int starts = 0, starts_converged = 0, distinct_minima = 0, refused_evaluations = 0;
  int points_used = 0;
  std::map<std::string, int> left_out;
  std::vector<std::string> warnings;
  std::optional<NextMeasurement> next_measurement;  ///< where one more point would help most
  std::vector<FittedPoint> points;                  ///< all of the scan, in its order

  std::string measurement_id, name, source, licence, quantity;

  const FittedParameter* find(std::string_view parameter) const;  ///< the first of the name
  double value(std::string_view parameter) const;                 ///< InputError when there is none
  std::vector<double> values() const;  ///< in the order of the model's parameters, of the first wavelength
  std::vector<double> by_wavelength(std::string_view parameter) const;  ///< all of the name
  std::optional<double> index() const { return of_surface("n"); }       ///< where it was fitted
  std::optional<double> absorption() const { return of_surface("k"); }  ///< likewise
  std::optional<double> of_surface(std::string_view name) const;
  /// Where a row was evaluated: at its wavelength, else the assumed one (1000 nm where none matters).
  double evaluated_at_nm(double stated_nm) const;
};

/// Fits a model to a scan. InputError for what cannot be fitted (no wavelength where one is needed, an unknown
/// material, a wavelength outside the material's range, no point left).
FitResult fit(const Measurement& measurement, const FitRequest& request);

/// The fitted f_r at the angles given (degrees, zenith angles below 90, phi = phi_o - phi_i): curves for plots. The
/// wavelength is that of the fit (the first one, or the assumed one).
std::vector<double> predict(const FitResult& result, double theta_i_deg, std::span<const double> theta_o_deg,
                            double phi_deg);
/// The same at the rows of a scan, at their wavelengths.
std::vector<double> predict(const FitResult& result, std::span<const ScanPoint> points);

}  // namespace gonio
