#pragma once
#include "base/number.h"

namespace gonio {

/// A complex number over any number type (std::complex is only defined over float and double).
template <class T>
struct Complex {
  T re, im;
};

template <class T>
Complex<T> operator+(const Complex<T>& a, const Complex<T>& b) {
  return {a.re + b.re, a.im + b.im};
}
template <class T>
Complex<T> operator-(const Complex<T>& a, const Complex<T>& b) {
  return {a.re - b.re, a.im - b.im};
}
template <class T>
Complex<T> operator*(const Complex<T>& a, const Complex<T>& b) {
  return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}
template <class T>
Complex<T> operator*(const T& a, const Complex<T>& b) {
  return {a * b.re, a * b.im};
}
template <class T>
Complex<T> conj(const Complex<T>& a) {
  return {a.re, -a.im};
}
/// |a|².
template <class T>
T norm(const Complex<T>& a) {
  return square(a.re) + square(a.im);
}
template <class T>
Complex<T> operator/(const Complex<T>& a, const Complex<T>& b) {
  return T(T(1) / norm(b)) * (a * conj(b));
}

}  // namespace gonio
