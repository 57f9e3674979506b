#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/number.h"
#include "energy/lobe_families.h"

namespace gonio {

/// Where tables and curves of E are known: rows over the width, evenly in ln alpha, columns over the incidence, close next to grazing.
/// Between them Lagrange's cubic. With h = 1 - √(1 - cos θ), which is cos θ/2 at grazing and 1 - θ/√2 at the normal, column ∝ 0.75·asinh(h/b)/asinh(1/b) + 0.25·h.
struct EnergyGrid {
  std::size_t rows = 60, columns = 68;
  double widest = std::sqrt(8);  ///< alpha of the last row; the first has kNarrowestAlpha

  double alpha(std::size_t row) const {
    return kNarrowestAlpha * std::exp(log_range() * static_cast<double>(row) / static_cast<double>(rows - 1));
  }
  /// cos θ of a column; 1e-6 at the first, from where on E is level.
  double cos_theta(std::size_t column) const;

  /// Place among the rows; alpha beyond them takes the last.
  template <class T>
  T row_of(const T& alpha) const {
    using std::log;
    // The bound first: what is no number passes both, and is none in the end.
    const T inside = smaller_of(T(widest), larger_of(T(kNarrowestAlpha), alpha));
    return T(log(T(inside * T(1 / kNarrowestAlpha)))) * T(static_cast<double>(rows - 1) / log_range());
  }
  template <class T>
  T column_of(const T& cos_theta) const {
    return column_share(smaller_of(T(1.0), larger_of(T(0.0), cos_theta))) * T(static_cast<double>(columns - 1));
  }

 private:
  static constexpr double kBend = 5e-4, kLinear = 0.25, kGrazing = 1e-6;
  double log_range() const { return std::log(widest / kNarrowestAlpha); }

  template <class T>
  static T share_of_rise(const T& rise) {
    using std::log, std::sqrt;
    const T x = rise * T(1 / kBend);
    return T((1 - kLinear) / std::asinh(1 / kBend)) * T(log(T(x + sqrt(T(x * x + T(1.0)))))) + T(kLinear) * rise;
  }
  template <class T>
  static T column_share(const T& cosine) {
    using std::sqrt;
    return share_of_rise(T(cosine / (T(1.0) + sqrt(T(T(1.0) - cosine)))));
  }
};

inline double EnergyGrid::cos_theta(std::size_t column) const {
  const double share = static_cast<double>(column) / static_cast<double>(columns - 1);
  double lo = 0, hi = 1;
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = 0.5 * (lo + hi);
    (share_of_rise(middle) < share ? lo : hi) = middle;
  }
  const double rise = 0.5 * (lo + hi);
  return column + 1 == columns ? 1.0 : std::clamp(rise * (2 - rise), kGrazing, 1.0);
}

/// Four neighbours of a place, and their weights in Lagrange's cubic; at the ends of the grid the place lies between the outer two.
template <class T>
struct CubicTaps {
  static constexpr std::size_t kCount = 4;
  std::size_t first;
  std::array<T, kCount> weight;

  CubicTaps(T place, std::size_t count) {
    // A place that is no number takes the first taps: its value is none either.
    const T below = place > T(1) ? std::min(std::floor(place) - T(1), static_cast<T>(count - kCount)) : T(0);
    first = static_cast<std::size_t>(below);
    const T t = place - below, a = t - 1, b = t - 2, c = t - 3;
    weight = {-a * b * c / 6, t * b * c / 2, -t * a * c / 2, t * a * b / 6};
  }
};

}  // namespace gonio
