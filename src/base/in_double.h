#pragma once
#include <array>

#include "base/number.h"

namespace gonio {

/// f(x...) with float lanes widened to two halves of double lanes (f is a template over its number type); any other
/// number type as it is. For the steep parts of a formula that float's rounding alone would spoil: half the speed of
/// double lanes, no more.
template <class F, class A, class... X>
xsimd::batch<float, A> in_double(const F& f, const xsimd::batch<float, A>& first, const X&... rest) {
  using Float = xsimd::batch<float, A>;
  using Double = xsimd::batch<double, A>;
  constexpr std::size_t kLanes = Float::size, kHalf = Double::size;
  alignas(64) std::array<float, kLanes> result;
  for (std::size_t at = 0; at < kLanes; at += kHalf) {
    const auto wide = [at](const Float& x) {
      alignas(64) std::array<float, kLanes> all;
      alignas(64) std::array<double, kHalf> half;
      x.store_aligned(all.data());
      for (std::size_t lane = 0; lane < kHalf; ++lane) half[lane] = double(all[at + lane]);
      return Double::load_aligned(half.data());
    };
    const Double y = f(wide(first), wide(rest)...);
    alignas(64) std::array<double, kHalf> half;
    y.store_aligned(half.data());
    for (std::size_t lane = 0; lane < kHalf; ++lane) result[at + lane] = float(half[lane]);
  }
  return Float::load_aligned(result.data());
}
template <class F, class T, class... X>
T in_double(const F& f, const T& first, const X&... rest) {
  return f(first, rest...);
}

}  // namespace gonio
