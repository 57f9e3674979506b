#pragma once
#include "base/unit_vector.h"
#include "brdf/directions.h"

namespace gonio {

// What every sampler of this room offers, over its number type (scalars or lanes): `sample(o, u0, u1, u2)` draws a direction i towards
// the light for the eye o above the horizon, u0, u1, u2 in (0, 1), and `pdf(i, o)` is its density per steradian. u0 chooses between lobes and
// nothing else; within a lobe the direction is continuous in (u1, u2).

/// pdf_per_sr = 0: empty, the drawn direction lies below the horizon. pdf is that of the rounded direction.
template <class T>
struct DirectionSample {
  UnitVector<T> direction;
  T pdf_per_sr;
};

/// o's mirror image in the facet of normal h, and whether facet and image face upwards.
template <class T>
UnitVector<T> mirrored(const UnitVector<T>& o, const UnitVector<T>& h) {
  const T twice = T(2) * dot(o, h);
  return {twice * h.x - o.x, twice * h.y - o.y, twice * h.z - o.z};
}

/// A direction as drawn, its density not yet taken; `lit` where it counts if it lies above the horizon.
template <class T, class Mask = decltype(T() < T())>
struct DrawnDirection {
  UnitVector<T> direction;
  Mask lit;
};

/// The sample of a sampler whose density is its pdf(); empty unless `lit` and above the horizon.
template <class T, class Sampler, class Mask>
DirectionSample<T> with_density(const Sampler& sampler, const UnitVector<T>& i, const UnitVector<T>& o,
                                const Mask& lit) {
  const auto valid = lit && i.z > T(0);
  // A direction that is dropped is replaced by the eye's, so that its density has nothing to overflow with.
  const UnitVector<T> safe{select(valid, i.x, o.x), select(valid, i.y, o.y), select(valid, i.z, o.z)};
  return {i, select(valid, sampler.pdf(safe, o), T(0))};
}
template <class T, class Sampler>
DirectionSample<T> with_density(const Sampler& sampler, const DrawnDirection<T>& drawn, const UnitVector<T>& o) {
  return with_density(sampler, drawn.direction, o, drawn.lit);
}

}  // namespace gonio
