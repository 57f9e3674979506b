#pragma once
// base: sums and products kept with their rounding errors (Dekker 1971; Ogita, Rump & Oishi 2005, doi:10.1137/030601818).
#include "base/number.h"

namespace gonio {

/// value + rest, rest the rounding error of value.
template <class T>
struct TwoTerms {
  T value, rest;
};

template <class T>
TwoTerms<T> product_of(const T& a, const T& b) {
  const T value = a * b;
  return {value, multiply_add(a, b, T(-value))};
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
