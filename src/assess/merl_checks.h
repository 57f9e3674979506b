#pragma once
#include "assess/merl_tables.h"
#include "assess/published_comparisons.h"

namespace gonio {

/// Deviations of one table at one position of kMerlHalfDeg.
std::vector<double> decades_of(const std::vector<MerlDeviation>& deviations, std::size_t table, std::size_t half);
/// 0 <= share <= 1; linear between ranks.
double quantile(std::vector<double> values, double share);

/// What must be so if the tables' conventions are read aright, and what the papers' fits disagree on.
std::vector<Claim> merl_claims(const std::vector<MerlFit>& fits, const std::vector<MerlDeviation>& deviations);

/// A material whose tables lie apart: log10 of highest over lowest f at a position of kMerlHalfDeg.
struct MerlSpread {
  std::string material;
  std::size_t half;
  double decades;
  std::size_t lowest, highest;
  std::string why;
};
/// The five widest at the mirror direction, at 5° and at 20°.
std::vector<MerlSpread> merl_spreads(const std::vector<MerlFit>& fits, const std::vector<MerlDeviation>& deviations);

/// The bundled scan of aluminium at kMerlThetaI, interpolated in log f at kMerlHalfDeg.
std::vector<double> measured_aluminium();

}  // namespace gonio
