#include "assess/interpolation_error.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <random>
#include <set>

namespace gonio {
namespace {

struct Column {
  std::string id, data_class, name;
  std::vector<double> x, y;
};

std::vector<Column> columns_of(const Entry& entry) {
  std::vector<Column> list;
  for (std::size_t c = 0; c < entry.columns.size(); ++c) {
    if (entry.columns[c].size() != entry.wavelength_nm.size()) continue;  // n of a formula
    const std::string& name = entry.column_names[c];
    Column column{entry.id, entry.kind == "optical-constants" ? entry.kind + " " + name : entry.kind, name, {}, {}};
    for (std::size_t i = 0; i < entry.wavelength_nm.size(); ++i)
      if (std::isfinite(entry.columns[c][i]))
        column.x.push_back(entry.wavelength_nm[i]), column.y.push_back(entry.columns[c][i]);
    if (column.x.size() < kLeastPoints) continue;
    const auto [least, most] = std::minmax_element(column.y.begin(), column.y.end());
    if (*most > *least) list.push_back(std::move(column));
  }
  return list;
}

bool allowed(const Column& column, Interpolation variant) {
  return variant != Interpolation::sprague || is_equidistant(column.x);
}

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

}  // namespace

LeaveOutError leave_out_error(const std::vector<double>& x, const std::vector<double>& y, Interpolation variant) {
  std::vector<double> kept_x, kept_y;
  for (std::size_t i = 0; i < x.size(); i += 2) kept_x.push_back(x[i]), kept_y.push_back(y[i]);
  const auto [least, most] = std::minmax_element(y.begin(), y.end());
  LeaveOutError error;
  error.variant = variant, error.kept = kept_x.size();
  const double range = *most - *least, end = kept_x.back();
  const Interpolator table(variant, std::move(kept_x), std::move(kept_y));
  double squares = 0;
  for (std::size_t i = 1; i < x.size() && x[i] < end; i += 2) {
    const double off = std::abs(table.at(x[i]) - y[i]) / range;
    error.max = std::max(error.max, off);
    squares += off * off;
    ++error.predicted;
  }
  error.rms = std::sqrt(squares / static_cast<double>(std::max<std::size_t>(error.predicted, 1)));
  return error;
}

std::vector<LeaveOutError> leave_out_errors(const Database& database) {
  const std::vector<const Entry*> entries = database.all();
  std::vector<std::vector<LeaveOutError>> found(entries.size());
  tbb::parallel_for(std::size_t{0}, entries.size(), [&](std::size_t e) {
    if (entries[e]->user) return;
    for (const Column& column : columns_of(*entries[e]))
      for (const Interpolation variant : kInterpolations) {
        if (!allowed(column, variant)) continue;
        LeaveOutError error = leave_out_error(column.x, column.y, variant);
        error.id = column.id, error.data_class = column.data_class, error.column = column.name;
        found[e].push_back(std::move(error));
      }
  });
  std::vector<LeaveOutError> all;
  for (auto& list : found) all.insert(all.end(), list.begin(), list.end());
  return all;
}

std::vector<const LeaveOutError*> resampled_columns(const std::vector<LeaveOutError>& errors) {
  std::vector<const LeaveOutError*> columns;
  double linear = 0;  // of the same column: its variants follow each other, linear first, then pchip
  for (const LeaveOutError& e : errors) {
    if (e.variant == Interpolation::linear) linear = e.rms;
    if (e.variant == Interpolation::pchip && linear < kResampled * e.rms) columns.push_back(&e);
  }
  return columns;
}

std::vector<ClassError> errors_by_class(const std::vector<LeaveOutError>& errors) {
  std::set<std::string> equidistant, resampled;  // the first: columns that sprague takes
  for (const LeaveOutError* e : resampled_columns(errors)) resampled.insert(e->id + " " + e->column);
  for (const LeaveOutError& e : errors)
    if (e.variant == Interpolation::sprague) equidistant.insert(e.id + " " + e.column);
  std::map<std::pair<std::string, bool>, std::map<Interpolation, std::vector<const LeaveOutError*>>> groups;
  for (const LeaveOutError& e : errors) {
    if (resampled.contains(e.id + " " + e.column)) continue;
    if (equidistant.contains(e.id + " " + e.column)) groups[{e.data_class, true}][e.variant].push_back(&e);
    if (e.variant != Interpolation::sprague) groups[{e.data_class, false}][e.variant].push_back(&e);
  }
  std::vector<ClassError> classes;
  for (const auto& [key, variants] : groups)
    for (const auto& [variant, list] : variants) {
      ClassError c{key.first, key.second, variant, list.size()};
      std::vector<double> rms;
      for (const LeaveOutError* e : list) rms.push_back(e->rms), c.worst_max = std::max(c.worst_max, e->max);
      c.median_rms = quantile(rms, 0.5), c.p90_rms = quantile(rms, 0.9);
      classes.push_back(std::move(c));
    }
  return classes;
}

double nanoseconds_per_lookup(Interpolation variant, int points, bool equidistant) {
  std::vector<double> x, y, at;
  for (int i = 0; i < points; ++i) {
    const double t = static_cast<double>(i) / (points - 1);
    x.push_back(380 + 400 * (equidistant ? t : t * (1 + t) / 2)), y.push_back(std::sin(0.1 * i));
  }
  std::mt19937 random(1);
  for (int i = 0; i < 4096; ++i) at.push_back(380 + 400 * (static_cast<double>(random()) / 4294967296.0));
  const Interpolator table(variant, x, y);
  double least = 1e9, sum = 0;
  for (int run = 0; run < 25; ++run) {
    const auto start = std::chrono::steady_clock::now();
    for (const double nm : at) sum += table.at(nm);
    const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - start;
    least = std::min(least, time.count() / static_cast<double>(at.size()));
  }
  return std::isfinite(sum) ? least : 0;  // the sum keeps the loop
}

}  // namespace gonio
