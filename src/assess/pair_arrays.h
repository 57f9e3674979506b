#pragma once
#include <random>

#include "brdf/batch.h"

namespace gonio {

/// 512 random pairs of directions, cosines from 0.05, in arrays that lanes load whole and the core keeps near: what costs are measured on.
template <class S>
struct PairArrays {
  static constexpr std::size_t kPairs = 512;
  template <class U>
  using Array = std::vector<U, xsimd::aligned_allocator<U, 64>>;

  std::array<Array<S>, 6> v;
  Array<S> out = Array<S>(kPairs);

  PairArrays() {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (auto& component : v) component.resize(kPairs);
    for (std::size_t p = 0; p < kPairs; ++p)
      for (const std::size_t first : {0, 3}) {
        const double z = 0.05 + 0.95 * uniform(random), phi = 2 * kPi<double> * uniform(random),
                     r = std::sqrt((1 - z) * (1 + z));
        v[first][p] = S(r * std::cos(phi)), v[first + 1][p] = S(r * std::sin(phi)), v[first + 2][p] = S(z);
      }
  }
  DirectionPairs<S> pairs() const { return {v[0], v[1], v[2], v[3], v[4], v[5]}; }
  UnitVector<S> i(std::size_t p) const { return {v[0][p], v[1][p], v[2][p]}; }
  UnitVector<S> o(std::size_t p) const { return {v[3][p], v[4][p], v[5][p]}; }
  Directions<S> reduced(std::size_t p) const { return reduce(v[0][p], v[1][p], v[2][p], v[3][p], v[4][p], v[5][p]); }
  /// A batch from `at` on.
  template <class Lanes>
  Directions<Lanes> lanes(std::size_t at) const {
    const auto of = [&](std::size_t c) { return Lanes::load_aligned(v[c].data() + at); };
    return reduce<Lanes>(of(0), of(1), of(2), of(3), of(4), of(5));
  }
};

}  // namespace gonio
