#pragma once
// Chromatic adaptation: the colour that looks, under another white, as this one does under its own.
#include "spectrum/color.h"

namespace gonio {

/// Bradford's linear transform (K. M. Lam 1985; ICC.1:2022, annex E): each cone-like response is scaled from one white
/// to the other. White goes to white exactly.
template <class T>
Xyz<T> bradford_adapted(const Xyz<T>& c, const Xyz<T>& from_white, const Xyz<T>& to_white) {
  const auto response = [](const Xyz<T>& p) {
    return Xyz<T>{T(0.8951) * p.x + T(0.2664) * p.y - T(0.1614) * p.z,
                  T(-0.7502) * p.x + T(1.7135) * p.y + T(0.0367) * p.z,
                  T(0.0389) * p.x - T(0.0685) * p.y + T(1.0296) * p.z};
  };
  const Xyz<T> seen = response(c), from = response(from_white), to = response(to_white);
  const T l = seen.x * to.x / from.x, m = seen.y * to.y / from.y, s = seen.z * to.z / from.z;
  return {T(0.9869929054667123) * l - T(0.14705425642099013) * m + T(0.15996265166373125) * s,
          T(0.43230526972339456) * l + T(0.5183602715367776) * m + T(0.04929122821285561) * s,
          T(-0.008528664575177328) * l + T(0.04004282165408487) * m + T(0.9684866957875502) * s};
}

/// The white of sRGB: D65 as IEC 61966-2-1 rounds it (x = 0.3127, y = 0.3290), Y = 1.
template <class T>
Xyz<T> srgb_white() {
  return {T(0.3127) / T(0.3290), T(1), T(0.3583) / T(0.3290)};
}

}  // namespace gonio
