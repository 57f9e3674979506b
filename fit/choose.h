#pragma once
#include <functional>
#include <string>
#include <vector>

#include "fit/fit.h"

namespace gonio {

/// A candidate as the choice sees it.
struct Candidate {
  FitResult result;  ///< fitted to all of the scan
  int parameters = 0;
  /// Mean squared log10 error of each scan (an incidence and 30 degrees of azimuth), fitted without its incidence.
  std::vector<double> scan_error;
  double held_out_log10 = 0;        ///< root of their mean
  double worse = 0, uncertain = 0;  ///< mean excess of scan_error over the best candidate's, and its standard error
  double aicc = 0,
         bic = 0;  ///< of the fit to all of the scan, errors taken as normal in the metric; for comparison only
  bool told_apart =
      false;  ///< worse by more than one standard error and by more than 1 % of the error: the data prefer the best one
};

struct ModelChoice {
  std::vector<Candidate>
      candidates;  ///< in order of cost: fewer parameters first, then those without a series, then the list's order
  std::size_t best = 0, chosen = 0;  ///< least held-out error; the first that the data cannot tell from it
  int folds = 0;
  double best_uncertain = 0;     ///< standard error of the best candidate's mean squared error, between scans
  std::vector<int> scan_points;  ///< of each scan: the weights of the means
  std::string sentence;
};

/// Mean squared log10 error of left-out scans by which one candidate exceeds another, and its standard error between scans.
struct Excess {
  double mean, error;
};
Excess excess_over(const ModelChoice& choice, const Candidate& worse, const Candidate& better);

/// Every model that a scan can be fitted with: the whole list but the mirror and, without a wavelength, those that need one; lobes with
/// facets or a mirror direction also turned back towards the light.
std::vector<ModelSpec> all_candidates(const Measurement& measurement);

/// No more model than the data need. Fits all candidates, then judges them by cross-validation over whole scans: one incidence angle
/// (or one of up to 8 groups of them) is left out in turn, the rest fitted again from where the whole fit ended, and the log10 error of
/// what was left out is compared scan by scan with the best candidate's. Chosen is the cheapest one whose excess lies within its own
/// standard error and within that of the best error itself (Breiman et al. 1984, the one-standard-error rule; an excess that only a few scans
/// show is uncertain, but it is there), or makes less than 1 % of the error. Lobes with a scale of their own keep ks = 1. With `request.sums` the lobes that predict best alone are then tried in pairs, and the best pairs with
/// a third. `request.model` and `hold_out` are not looked at. InputError below 3 incidence angles.
ModelChoice choose_model(const Measurement& measurement, const FitRequest& request, std::vector<ModelSpec> specs,
                         const std::function<void(const std::string& what, int done, int count)>& progress = {});

}  // namespace gonio
