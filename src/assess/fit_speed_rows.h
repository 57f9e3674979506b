#pragma once
// The measurements behind `gonio assess speed fit`.
#include "assess/fit_speed.h"

namespace gonio {

/// One way to fit one set of samples.
struct FitSpeedRow {
  std::string size, model;
  Metric metric = Metric::log;
  Derivatives derivatives = Derivatives::lanes;
  int starts = 1, threads = 1;
  double tolerance = kSearch;
  std::size_t samples = 0;
  double ms = 0;   ///< of all starts together, the least of several: on one thread its own time, else that of the clock
  double rms = 0;  ///< of the residuals reached, in the metric's unit
  double parameter_error = 0;  ///< largest |ln(found/truth)|; NaN where the data are another model's
  double missed = 0;           ///< share of the sets of starts whose residual exceeds the least known by more than 1 %
  int agreeing = 0;            ///< starts that ended at the best one's minimum
};

/// Times one fit: least of `repeats`.
FitSpeedRow timed_fit(const std::string& size, const FitSamples& samples, int starts, int threads,
                      Derivatives derivatives = Derivatives::lanes, double tolerance = kSearch, int repeats = 5);

/// 500 directions × 16 wavelengths: every metric with every kind of derivatives, 1 start.
std::vector<FitSpeedRow> metric_rows();
/// Data of a lobe with two widths, which one width does not fit: how far from the minimum (`parameter_error`) a solve ends at the
/// tolerance it stops at, each kind of derivatives.
std::vector<FitSpeedRow> tolerance_rows(const std::string& model);
/// 1 to 32 starts, several sets of them: time, `missed`, and in `parameter_error` the worst excess of the residual over the least
/// known.
std::vector<FitSpeedRow> start_rows(const std::string& model, bool search);
/// 20,000 samples of torrance-sparrow, fitted with every model: 16 starts, one thread.
std::vector<FitSpeedRow> model_rows(const std::vector<FitSamples>& every);
std::vector<FitSamples> every_model_of(const FitSamples& samples);

/// One of the sizes that a bar is set for.
struct FitBar {
  std::string what;
  double bar_ms, peer_ms;  ///< peer 0: none given
  std::string peer;
  FitSpeedRow one, two;  ///< on one and on two threads
  double per = 1;        ///< what `ms` is divided by: starts, where the bar is for one
  double whole_ms = 0;   ///< the whole of gonio::fit() on one thread, NaN where it was not run
  double one_ms() const { return one.ms / per; }
  double two_ms() const { return two.ms / per; }
};
std::vector<FitBar> fit_bars(const std::vector<FitSpeedRow>& every_model,
                             const std::function<void(const std::string&)>& progress);

}  // namespace gonio
