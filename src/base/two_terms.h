#pragma once
// base: sums and products kept with their rounding errors (Dekker 1971; Ogita, Rump & Oishi 2005, doi:10.1137/030601818).
#include <array>

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

/// a·b summed over its components as if in three times the precision, rounded once (Dot3 of Ogita, Rump & Oishi): what is left of
/// terms that cancel is right to a last place even where it is 1e-12 of them, in float.
template <class T, std::size_t N>
T sum_of_products(const std::array<T, N>& a, const std::array<T, N>& b) {
  std::array<T, 2 * N> terms;
  for (std::size_t k = 0; k < N; ++k) {
    const TwoTerms<T> product = product_of(a[k], b[k]);
    terms[k] = product.rest, terms[N + k] = product.value;
  }
  for (int pass = 0; pass < 2; ++pass)
    for (std::size_t k = 1; k < 2 * N; ++k) {
      const TwoTerms<T> sum = sum_of(TwoTerms<T>{terms[k - 1], T(0)}, TwoTerms<T>{terms[k], T(0)});
      terms[k - 1] = sum.rest, terms[k] = sum.value;
    }
  T sum = terms[0];
  for (std::size_t k = 1; k < 2 * N; ++k) sum = sum + terms[k];
  return sum;
}

}  // namespace gonio
