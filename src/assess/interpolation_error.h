#pragma once
// What interpolation loses on the data we have: every second point of a table is left out and predicted from the
// others.
#include <string>
#include <vector>

#include "materials/database.h"
#include "spectrum/interpolation.h"

namespace gonio {

/// One column of one entry under one variant. Errors are relative to the column's range (largest minus least value).
struct LeaveOutError {
  std::string id, data_class,
      column;  ///< data_class: the kind of entry; of optical constants "optical-constants n", " k"
  Interpolation variant;
  std::size_t kept = 0, predicted = 0;
  double max = 0, rms = 0;
};

/// Errors of every tabulated column of at least kLeastPoints points and some range, for every variant it allows
/// (sprague: equidistant points only), in the order of ids. Values not known (NaN) do not count as points.
std::vector<LeaveOutError> leave_out_errors(const Database& database);
inline constexpr std::size_t kLeastPoints = 12;

/// One table alone; `max` and `rms` relative to the range of y.
LeaveOutError leave_out_error(const std::vector<double>& x, const std::vector<double>& y, Interpolation variant);

/// Columns whose linear error is below this share of pchip's were resampled linearly by their sources (no smooth curve
/// does that); they tell nothing about the spectrum and are left out of the classes.
inline constexpr double kResampled = 0.05;
std::vector<const LeaveOutError*> resampled_columns(const std::vector<LeaveOutError>& errors);

/// A data class under a variant, over the columns that every variant compared can take: equidistant ones when
/// `equidistant`, else all, without sprague.
struct ClassError {
  std::string data_class;
  bool equidistant;
  Interpolation variant;
  std::size_t columns = 0;
  double median_rms = 0, p90_rms = 0, worst_max = 0;
};
std::vector<ClassError> errors_by_class(const std::vector<LeaveOutError>& errors);

/// Wall time of a lookup in a table of so many points (equidistant or not), at wavelengths in random order: the least
/// of several runs, in ns.
double nanoseconds_per_lookup(Interpolation variant, int points, bool equidistant);

}  // namespace gonio
