#pragma once
#include "brdf/transmission.h"

namespace gonio {

/// A pair of directions, or a surface, spread over SIMD lanes (the fast path evaluates many at once).
template <class Lanes>
Directions<Lanes> spread(const Directions<double>& w) {
  using S = scalar_t<Lanes>;
  const auto all = [](double x) { return Lanes(S(x)); };
  return {all(w.cos_i), all(w.cos_o), all(w.cos_d), all(w.tan2_h), all(w.tan2_i), all(w.tan2_o),
          all(w.ix),    all(w.iy),    all(w.ox),    all(w.oy),     all(w.hx),     all(w.hy)};
}

template <class Lanes>
Interface<Lanes> spread(const Interface<double>& surface) {
  using S = scalar_t<Lanes>;
  return {Lanes(S(surface.n)), Lanes(S(surface.k)), surface.perfect};
}

template <class Lanes>
Azimuth<Lanes> spread(const Azimuth<double>& azimuth) {
  using S = scalar_t<Lanes>;
  return {Lanes(S(azimuth.sin_phi)), Lanes(S(azimuth.one_plus_cos))};
}
template <class Lanes>
UnitVector<Lanes> spread(const UnitVector<double>& v) {
  using S = scalar_t<Lanes>;
  return {Lanes(S(v.x)), Lanes(S(v.y)), Lanes(S(v.z))};
}

template <class Lanes>
Brdf<Lanes> spread_brdf(const ModelSpec& spec, std::span<const double> values) {
  std::vector<Lanes> lanes;
  for (const double value : values) lanes.push_back(Lanes(scalar_t<Lanes>(value)));
  return make_brdf<Lanes>(spec, lanes);
}

}  // namespace gonio
