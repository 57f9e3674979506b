#pragma once
// Number types a formula is written over: double (reference), xsimd batches (fast), ceres::Jet (derivatives), 50 digits
// (judge). These few functions are what a formula needs beyond the arithmetic that all four share.
#include <cmath>
#include <limits>
#include <type_traits>
#include <xsimd/xsimd.hpp>

namespace gonio {

using FloatLanes = xsimd::batch<float>;
using DoubleLanes = xsimd::batch<double>;

template <class T>
struct is_lanes : std::false_type {};
template <class S, class A>
struct is_lanes<xsimd::batch<S, A>> : std::true_type {};
template <class T>
inline constexpr bool is_lanes_v = is_lanes<T>::value;

/// The type behind lanes (float or double); the type itself otherwise.
template <class T>
struct scalar {
  using type = T;
};
template <class S, class A>
struct scalar<xsimd::batch<S, A>> {
  using type = S;
};
template <class T>
using scalar_t = typename scalar<T>::type;

template <class T>
T select(bool yes, const T& a, const T& b) {
  return yes ? a : b;
}
using xsimd::select;

inline bool any(bool yes) { return yes; }
using xsimd::any;

template <class T>
T square(const T& x) {
  return x * x;
}

template <class T>
T fifth_power(const T& x) {
  return square(T(square(x))) * x;
}

/// a·b + c. Lanes and double round once where the machine can (xsimd 8 rounds twice there, and the build contracts nothing);
/// the other types as written.
template <class T>
T multiply_add(const T& a, const T& b, const T& c) {
  if constexpr (is_lanes_v<T>) {
#ifdef __AVX512F__
    if constexpr (sizeof(T) == 64 && std::is_same_v<scalar_t<T>, float>) return _mm512_fmadd_ps(a, b, c);
    if constexpr (sizeof(T) == 64 && std::is_same_v<scalar_t<T>, double>) return _mm512_fmadd_pd(a, b, c);
#endif
    return xsimd::fma(a, b, c);
  } else {
#ifdef __FMA__
    if constexpr (std::is_floating_point_v<T>) return std::fma(a, b, c);
#endif
    return a * b + c;
  }
}

/// The same of mixed types (a number with derivatives, one without).
template <class A, class B, class C>
auto multiply_add(const A& a, const B& b, const C& c) {
  return a * b + c;
}

template <class T>
T smaller_of(const T& a, const T& b) {
  if constexpr (is_lanes_v<T>)
    return xsimd::min(a, b);
  else
    return select(a < b, a, b);
}
template <class T>
T larger_of(const T& a, const T& b) {
  if constexpr (is_lanes_v<T>)
    return xsimd::max(a, b);
  else
    return select(a > b, a, b);
}

/// The number without its derivatives (for choosing branches and nodes, which carry none); specialised in base/jet.h.
template <class T>
struct ValueOf {
  static T of(const T& x) { return x; }
};
template <class T>
auto value_of(const T& x) {
  return ValueOf<T>::of(x);
}

// Constants of a formula; the 50-digit type has its own (src/reference).
template <class T>
inline const T kPi = T(3.141592653589793238462643383279502884L);
template <class T>
inline const T kSqrtPi = T(1.772453850905516027298167483341145183L);
template <class T>
inline const T kSqrt2Pi = T(2.506628274631000502415765284811045253L);
template <class T>
inline const T kSqrt2 = T(1.414213562373095048801688724209698079L);

}  // namespace gonio
