#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gonio {

struct Measurement;

/// How pairs of positive values that ought to be equal differ.
struct PairStatistics {
  int pairs = 0;
  double rms_log10 = 0;     ///< root mean square of log10(first/second)
  double spread_log10 = 0;  ///< 1.4826 times the median of its size: a standard deviation that outliers do not move
  double median_log10 = 0;  ///< of reciprocal pairs: the value lit from closer to the normal over the other
  double median_error_log10 = 0;  ///< its standard error, for normal errors
  double one_sided = 0;  ///< pairs above 1 less pairs below, over the root of their number: a normal deviate by chance
};

/// Share of the light that the values themselves send back, ∫ f·cos_o dω_o, where a scan covers the hemisphere.
struct ScanEnergy {
  double theta_i_deg = 0, phi_i_deg = 0, wavelength_nm = 0;  ///< NaN wavelength: not stated
  double reflectance = 0;
  double error = 0;  ///< difference of what every second row alone gives: a sign of the sampling's own, no bound
  int points = 0;
};

/// What a scan says of itself, before any model.
struct ScanQuality {
  PairStatistics repeats;     ///< rows of the same directions and wavelength, each with the one before
  PairStatistics reciprocal;  ///< (i, o) and (o, i)
  std::vector<ScanEnergy> energies;
  std::vector<std::string> warnings;
};

/// Rows of the same directions and wavelength. Angles less than 0.05° apart count as the same unless a rounding
/// boundary (at odd thousandths of a degree, where no scan puts its angles) lies between them.
PairStatistics repeats_of(const Measurement& measurement);

/// Helmholtz pairs. Where every row has the same phi_i the sample is taken for isotropic: same relative azimuth, up to
/// its sign. Where phi_i varies, both azimuths must be exchanged, which holds for samples with a grain as well.
PairStatistics reciprocal_pairs_of(const Measurement& measurement);

/// Each incidence and wavelength whose rows lie no further than 0.15 in direction cosines from 98 % of the projected
/// hemisphere (cuts in the plane of incidence do not); mirror symmetry about that plane is assumed. Empty for relative
/// scans.
std::vector<ScanEnergy> scan_energies(const Measurement& measurement);

/// All of these, and a warning for what cannot be: values that are not reciprocal, or reflect more than the light.
ScanQuality scan_quality(const Measurement& measurement);

/// A sentence when reciprocal pairs differ one way (by more than 2 % and 5 standard errors of their median), or 2.5
/// times as much as repeats do.
std::optional<std::string> reciprocity_broken(const PairStatistics& repeats, const PairStatistics& reciprocal);

/// Relative standard deviation of one value.
struct NoiseEstimate {
  double relative_sd = 0;
  std::string_view from;  ///< "repeats" or "reciprocity"
  int pairs = 0;          ///< its own relative error is about 1.17/√pairs, for normal errors
};

/// From repeats, else from reciprocal pairs; none below 8 of them, or when they agree to the last digit (copies, no
/// repeats).
std::optional<NoiseEstimate> noise_estimate(const Measurement& measurement);

}  // namespace gonio
