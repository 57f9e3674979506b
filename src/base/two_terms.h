#pragma once
// base: sums and products kept with their rounding errors (Dekker 1971; Ogita, Rump & Oishi 2005, doi:10.1137/030601818).
#include "base/number.h"

namespace gonio {

/// a·b + c rounded once where the hardware can; number types of more digits or with derivatives round twice.
template <class T>
T fused(const T& a, const T& b, const T& c) {
  if constexpr (std::is_floating_point_v<T>) return std::fma(a, b, c);
  else if constexpr (is_lanes_v<T>) return xsimd::fma(a, b, c);
  else return a * b + c;
}

/// value + rest, rest the rounding error of value.
template <class T>
struct TwoTerms {
  T value, rest;
};

template <class T>
TwoTerms<T> product_of(const T& a, const T& b) {
  const T value = a * b;
  return {value, fused(a, b, T(-value))};
}
template <class T>
TwoTerms<T> product_of(const T& a, const T& b, const T& c) {
  const TwoTerms<T> ab = product_of(a, b), abc = product_of(ab.value, c);
  return {abc.value, T(abc.rest + ab.rest * c)};
}
template <class T>
TwoTerms<T> sum_of(const TwoTerms<T>& a, const TwoTerms<T>& b) {
  const T value = a.value + b.value, of_b = value - a.value;
  const T error = (a.value - (value - of_b)) + (b.value - of_b);
  return {value, T(error + (a.rest + b.rest))};
}

}  // namespace gonio
