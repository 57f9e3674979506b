#pragma once
// Where a fit can be trusted: maps of what is recovered, which starts end where, and an atlas of scans that mislead.
#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "assess/brdf_stability.h"
#include "assess/planned_scan.h"
#include "fit/fit.h"

namespace gonio {

/// A fit counts as failed when a parameter is off by more than this (10 %, in decades), or fewer intervals than this hold.
inline constexpr double kFailedDecades = 0.0414, kFailedShare = 0.8;

/// What a sweep varies against the true roughness.
enum class RecoverySweep { noise, largest_theta_o, step };
inline constexpr std::array kRecoverySweeps{RecoverySweep::noise, RecoverySweep::largest_theta_o, RecoverySweep::step};
std::string_view name_of(RecoverySweep sweep);

/// A cell: true roughness (its decimal logarithm) against what is swept, over several noisy repeats.
struct RecoveryCell {
  double x = 0, y = 0;
  double decades = 0;       ///< median over the repeats of the largest |log10(found/true)| of a parameter; at most 3
  double share_inside = 0;  ///< of parameters whose 95 % interval holds the truth
  double share_silent = 0;  ///< of repeats with a parameter beyond 10 % and its interval, and no warning
  bool recovered() const { return decades <= kFailedDecades; }
};
struct RecoveryMap {
  std::string model;
  RecoverySweep sweep;
  MapAxis x, y;
  std::size_t columns = 0, rows = 0;
  std::vector<RecoveryCell> cells;  ///< row by row
};
/// torrance-sparrow (m), ggx (alpha), beckmann-kirchhoff (sigma_um at T = 5 um) on gold, kd 0.05, ks 0.9; five incidences. 3 %
/// noise of ln f, to 80° by 5°, where these are not what is swept. ggx is seen across the plane of incidence too: in it alone alpha_y
/// and ks cannot be told apart.
RecoveryMap recovery_map(const std::string& model, RecoverySweep sweep, std::size_t columns, std::size_t rows,
                         int repeats);

/// Where the starts of a grid end.
struct BasinMap {
  std::string model;
  std::string first, second;  ///< the two parameters started from
  MapAxis x, y;               ///< their decimal logarithms
  std::size_t columns = 0, rows = 0;
  std::vector<int> plain,
      improved;  ///< minimum reached (0: the best), -1: not converged; solver alone, and after the search on few points
  struct Minimum {
    double rms, x, y;     ///< of the residuals; where it lies
    int plain, improved;  ///< starts that ended here
  };
  std::vector<Minimum> minima;  ///< by cost
};
/// beckmann-kirchhoff over (sigma, T); cook-torrance-1981-two-widths over its two widths; 2 % noise. Ends whose residual is not
/// near the least are one minimum when the residual is the same: plateaus have no place of their own.
BasinMap basin_map(const std::string& model, std::size_t columns, std::size_t rows);

/// A parameter of a fit that was misled.
struct MisledParameter {
  std::string name;
  double truth, value, lo95, hi95;
  bool outside() const { return !(lo95 <= truth && truth <= hi95); }
};
/// A scan with a flaw, its fit, and what gonio said.
struct Misled {
  std::string name, title, flaw;
  FitResult result;
  std::vector<MisledParameter> parameters;
  std::vector<std::string> warnings;  ///< of the fit, without those that a sound scan of this surface draws as well
  bool wrong() const;                 ///< a parameter lies outside its interval
  bool explained() const;             ///< the fit follows the scan to its noise
  bool noticed() const { return !warnings.empty() || !result.converged; }
};
std::vector<Misled> failure_atlas();

/// Everything into a folder: maps, pictures, README.md; tables only where not `published` (they hold where chance decides).
void write_fit_stability(const std::filesystem::path& folder, const std::function<void(const std::string&)>& progress,
                         bool published = false);

}  // namespace gonio
