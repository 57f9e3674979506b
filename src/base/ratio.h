#pragma once
#include "base/number.h"

namespace gonio {

/// A fraction not yet divided: the factors of a lobe multiply as fractions, and one division ends them all.
template <class T>
struct Ratio {
  T over, under;
  T value() const { return over / under; }
};

template <class T>
Ratio<T> operator*(const Ratio<T>& a, const Ratio<T>& b) {
  return {a.over * b.over, a.under * b.under};
}

template <class T>
Ratio<T> whole(const T& x) {
  return {x, T(1)};
}

}  // namespace gonio
