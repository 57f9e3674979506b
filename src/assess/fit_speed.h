#pragma once
// What a fit of samples in memory costs, and how near the truth it comes: this project's solver (derivatives in lanes) beside
// Ceres on the same residuals, with ceres::Jet and with differences.
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "assess/planned_scan.h"
#include "fit/fit.h"
#include "fit/solver.h"

namespace gonio {

/// Where the derivatives come from: dual numbers over lanes (LaneFit), ceres::Jet and central differences (Ceres).
enum class Derivatives { lanes, jet, numeric };
std::string_view name_of(Derivatives derivatives);

/// A scan of known truth, ready for fitting.
struct FitSamples {
  Measurement scan;
  FitRequest request;
  FitProblem problem;
  std::vector<double>
      truth;  ///< of the free parameters, as x; empty where the fitted model is not the one that made the data
};

/// What to make and fit.
struct FitCase {
  std::string model = "torrance-sparrow";
  Metric metric = Metric::log;
  std::size_t directions = 500, wavelengths = 1;
  double noise = 0.02;      ///< standard deviation of ln f
  bool own_scales = false;  ///< kd and ks of each wavelength; else shared
  std::uint64_t seed = 1;
};
/// Values typical of a metal surface, in the model's order; gold between 400 and 700 nm.
std::vector<double> typical_values(const ModelInfo& info);
FitSamples fit_samples(const FitCase& wanted);
/// The same samples for another model.
FitSamples with_model(const FitSamples& samples, const ModelSpec& model);

/// The same residuals by Ceres: a residual block a point, DENSE_QR, bounds, one thread. Models: torrance-sparrow, ggx and
/// beckmann-kirchhoff with shared kd, ks and without n (InputError otherwise).
Solution solve_with_ceres(const FitProblem& problem, std::span<const std::size_t> points, std::vector<double> x,
                          Derivatives derivatives, double tolerance);
/// The residuals at x (Jets and differences share the code that computes them) and their derivatives, row by row.
Linearised linearise_with_ceres(const FitProblem& problem, const std::vector<double>& x, Derivatives derivatives);

/// What many starts find. Starts are those of gonio::fit(), brought near a minimum on a few points (without `search` only kd and
/// ks are); where there are more than 6000 points the starts are solved on 3000 of them and the best end on all.
struct ManyStarts {
  Solution best;
  int agreeing = 0;  ///< starts within 1e-6 of its cost
};
ManyStarts solve_starts(const FitProblem& problem, int starts, Derivatives derivatives = Derivatives::lanes,
                        double tolerance = kSearch, std::uint64_t seed = 1, bool search = true);

/// Root mean square of the residuals, in the metric's unit.
double rms_of(const FitProblem& problem, const Solution& solution);
/// Largest |ln(found/truth)| over the free parameters.
double parameter_error(const FitSamples& samples, const std::vector<double>& x);

/// Runs it with at most so many threads.
void in_threads(int threads, const std::function<void()>& run);

/// The page: README.md, CSV tables, SVG charts.
void write_fit_speed(const std::filesystem::path& folder, const std::function<void(const std::string&)>& progress);

}  // namespace gonio
