#pragma once
// Where reflection models fail, as maps: the textbook form in plain float and double beside this project's, against 50
// digits.
#include <array>
#include <filesystem>
#include <functional>

#include "assess/brdf_error.h"

namespace gonio {

/// An axis of a map: its label, and the decimal logarithm of what it shows where `decades`.
struct MapAxis {
  std::string label;
  double lo, hi;
  bool decades = true;
  double at(double share) const { return lo + (hi - lo) * share; }
};

/// A sweep of a model over two quantities.
struct StabilitySweep {
  std::string name, title, published;  ///< what the published form is, in words
  ModelSpec spec;
  MapAxis x, y;
  /// The evaluation at a point of the axes, before rounding.
  std::function<BrdfPoint(double x, double y)> point;
  std::function<double(const BrdfPoint&)> published_single, published_double;
};
const std::vector<StabilitySweep>& stability_sweeps();

/// Relative errors of a cell: -1 where f vanishes (nothing to compare), infinite where f is no number or negative.
struct StabilityCell {
  double x, y;
  std::array<double, 4> error;  ///< published float, ours float, published double, ours double
};
struct StabilityMap {
  std::size_t columns = 0, rows = 0;
  std::vector<StabilityCell> cells;  ///< row by row
};
inline constexpr std::array kMapPanels{"published, float", "ours, float", "published, double", "ours, double"};
/// The point of a cell, each number rounded to the precision.
BrdfPoint sweep_point(const StabilitySweep& sweep, double x, double y, Precision precision);
StabilityMap stability_map(const StabilitySweep& sweep, std::size_t columns, std::size_t rows);
/// Whether a cell fails: beyond the bar (float: that of faint lobes).
bool fails(const StabilitySweep& sweep, const StabilityCell& cell, std::size_t panel);

/// E(θ, m) of lobes that may exceed 1, F = 1.
struct EnergyMap {
  std::string name;
  MapAxis x;
  std::size_t columns = 0, rows = 0;
  std::vector<std::array<double, 3>> cells;  ///< x, θ in degrees, E
};
std::vector<EnergyMap> energy_maps();

/// Everything into a folder: maps (SVG, CSV), worst points, README.md. Only what is the same on every machine where
/// `published`.
void write_brdf_stability(const std::filesystem::path& folder, bool published = false);

/// A `gonio eval` line that evaluates this point again.
std::string eval_line(const ModelSpec& spec, const BrdfPoint& point, std::string_view precision);

}  // namespace gonio
