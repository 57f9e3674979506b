#pragma once
// What tables of directional reflectance are judged by: some surfaces, some places, and E there by quadrature.
#include <span>
#include <string>
#include <vector>

#include "energy/energy_grid.h"
#include "energy/lobe_measure.h"

namespace gonio {

struct JudgingSurface {
  std::string name;
  Interface<double> interface;
};

/// From water to silver at 550 nm, with the steepest of metals and white facets: what tables promise to hold.
const std::vector<JudgingSurface>& common_surfaces();

/// Beyond what twenty fixed cosines hold, or next to it: reflectances that turn within a degree of grazing.
const std::vector<JudgingSurface>& extreme_surfaces();

struct TablePlace {
  double cos_theta, alpha;
  double theta_deg() const;
};

/// A third even in θ, in cos θ and in ln cos θ (1e-5 to 1), all even in ln alpha from kNarrowestAlpha.
std::vector<TablePlace> random_table_places(double widest, std::size_t count);

/// E of each surface: Σ weight·R(cos_d), R itself at every point of the measure.
std::vector<double> summed(const LobeMeasure& measure, std::span<const JudgingSurface> surfaces);

/// E of each surface at each place, the measure to 1e-7 of the whole; in parallel.
std::vector<std::vector<double>> true_reflectances(const LobeFamily& family, std::span<const TablePlace> places,
                                                   std::span<const JudgingSurface> surfaces);

/// Over places: the largest, its index, and the median.
struct ErrorSpread {
  double largest = 0, median = 0;
  std::size_t worst = 0;
};
ErrorSpread spread_of(std::vector<double> errors);

}  // namespace gonio
