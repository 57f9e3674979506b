#pragma once
#include <algorithm>
#include <array>

#include "surface/shadowing.h"

namespace gonio {

/// G1 = 1/(1 + Λ) of Gaussian slopes from a table: cubic Hermite in v = s/(1 + s), s = alpha·tan θ, of H = G1·(1 + s), which is
/// finite at both ends (1 at the normal, 2√π at grazing), with the slopes of its closed form. 64 intervals: largest relative error of G1
/// 4e-8, measured (tests/surface/surface_test.cpp). Looked up lane by lane.
struct SmithTable {
  static constexpr int kIntervals = 64;
  std::array<double, kIntervals + 1> value, slope;  ///< of H, by v

  SmithTable() {
    for (int i = 0; i <= kIntervals; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const double v = static_cast<double>(i) / kIntervals;
      if (i == 0 || i == kIntervals) {
        // Λ vanishes at one end and is s/(2√π) - ½ + … at the other.
        value[at] = i == 0 ? 1 : 2 * kSqrtPi<double>;
        slope[at] = i == 0 ? 1 : 2 * kSqrtPi<double> * (kSqrtPi<double> - 1);
        continue;
      }
      const double s = v / (1 - v), g = 1 / (1 + smith_lambda_core(s));
      value[at] = g * (1 + s);
      // dΛ/ds = exp(-1/s²)/(2√π), ds/dv = (1 + s)².
      slope[at] = (g - (1 + s) * g * g * std::exp(-1 / (s * s)) / (2 * kSqrtPi<double>)) * square(1 + s);
    }
  }
  static const SmithTable& get() {
    static const SmithTable table;
    return table;
  }
};

/// The four numbers of an interval, and its lower end, for a v (its value) in [0, 1].
template <class V>
struct SmithInterval {
  V lo, value_lo, value_hi, slope_lo, slope_hi;
};

template <class V>
SmithInterval<V> smith_interval(const V& v) {
  const SmithTable& table = SmithTable::get();
  const auto index_of = [](double x) {
    return static_cast<std::size_t>(std::clamp(x * SmithTable::kIntervals, 0.0, SmithTable::kIntervals - 1.0));
  };
  if constexpr (is_lanes_v<V>) {
    using S = scalar_t<V>;
    alignas(64) std::array<S, V::size> at;
    alignas(64) std::array<std::array<S, V::size>, 5> of;
    v.store_aligned(at.data());
    for (std::size_t lane = 0; lane < V::size; ++lane) {
      const std::size_t i = index_of(static_cast<double>(at[lane]));
      of[0][lane] = S(static_cast<double>(i) / SmithTable::kIntervals);
      of[1][lane] = S(table.value[i]), of[2][lane] = S(table.value[i + 1]), of[3][lane] = S(table.slope[i]),
      of[4][lane] = S(table.slope[i + 1]);
    }
    const auto load = [&](std::size_t k) { return V::load_aligned(of[k].data()); };
    return {load(0), load(1), load(2), load(3), load(4)};
  } else {
    const std::size_t i = index_of(static_cast<double>(v));
    return {V(static_cast<double>(i) / SmithTable::kIntervals), V(table.value[i]), V(table.value[i + 1]),
            V(table.slope[i]), V(table.slope[i + 1])};
  }
}

template <class T>
T smith_g1_tabulated(const T& tan2, const T& alpha) {
  using std::sqrt;
  const T s = alpha * sqrt(larger_of(tan2, T(1e-30))), lower = T(1) / (T(1) + s), v = s * lower;
  const auto e = smith_interval(value_of(v));
  const T t = (v - T(e.lo)) * T(SmithTable::kIntervals), t2 = square(t), step = T(1.0 / SmithTable::kIntervals);
  const T h = T(e.value_lo) + t2 * (T(3) - T(2) * t) * (T(e.value_hi) - T(e.value_lo)) +
              step * (t * square(T(1) - t) * T(e.slope_lo) - t2 * (T(1) - t) * T(e.slope_hi));
  return h * lower;
}

}  // namespace gonio
