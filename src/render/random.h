#pragma once
// render: the path tracer: rays (Embree), sampling strategies, spectral shading, the renderer.
#include <cstdint>

namespace gonio {

/// PCG32 (O'Neill 2014, pcg-random.org: XSH-RR with a 64-bit state), seeded from (seed, stream) by SplitMix64: every
/// pixel has a sequence of its own, so that the image does not depend on which thread renders it.
class Random {
 public:
  Random(std::uint64_t seed, std::uint64_t stream)
      : state_(mixed(seed + 0x9e3779b97f4a7c15U * (stream + 1))), increment_(mixed(state_ ^ stream) | 1U) {}

  std::uint32_t bits() {
    const std::uint64_t old = state_;
    state_ = old * 6364136223846793005U + increment_;
    const auto shifted = static_cast<std::uint32_t>(((old >> 18U) ^ old) >> 27U);
    const auto rotation = static_cast<std::uint32_t>(old >> 59U);
    return (shifted >> rotation) | (shifted << ((32U - rotation) & 31U));
  }

  /// Uniform in (0, 1), 52 bits: never 0 and never 1, so that logarithms and roots of it stay finite.
  double uniform() {
    const std::uint64_t high = bits(), low = bits();
    return (static_cast<double>(((high << 32U) | low) >> 12U) + 0.5) * 0x1p-52;
  }

 private:
  static std::uint64_t mixed(std::uint64_t z) {
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31U);
  }

  std::uint64_t state_, increment_;
};

}  // namespace gonio
