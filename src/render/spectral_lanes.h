#pragma once
#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "base/number.h"

namespace gonio {

inline constexpr std::size_t kLane = FloatLanes::size;

/// One value a wavelength, wavelengths side by side in N batches of float. Lanes beyond the last wavelength repeat it.
template <std::size_t N>
struct SpectralLanes {
  std::array<FloatLanes, N> part;

  SpectralLanes() : SpectralLanes(0.0F) {}
  explicit SpectralLanes(float value) { part.fill(FloatLanes(value)); }

  /// At most N·kLane values, at least one.
  static SpectralLanes from(std::span<const double> values) {
    std::array<float, N * kLane> padded;
    for (std::size_t w = 0; w < padded.size(); ++w)
      padded[w] = static_cast<float>(values[std::min(w, values.size() - 1)]);
    SpectralLanes result;
    for (std::size_t b = 0; b < N; ++b) result.part[b] = FloatLanes::load_unaligned(&padded[b * kLane]);
    return result;
  }

  void store(std::array<float, N * kLane>& values) const {
    for (std::size_t b = 0; b < N; ++b) part[b].store_unaligned(&values[b * kLane]);
  }

  float largest() const {
    std::array<float, N * kLane> values;
    store(values);
    return *std::max_element(values.begin(), values.end());
  }

  SpectralLanes& operator+=(const SpectralLanes& other) {
    for (std::size_t b = 0; b < N; ++b) part[b] += other.part[b];
    return *this;
  }
  SpectralLanes& operator*=(const SpectralLanes& other) {
    for (std::size_t b = 0; b < N; ++b) part[b] *= other.part[b];
    return *this;
  }
  SpectralLanes& operator*=(float factor) {
    for (FloatLanes& lanes : part) lanes *= FloatLanes(factor);
    return *this;
  }
  friend SpectralLanes operator*(SpectralLanes left, const SpectralLanes& right) { return left *= right; }
  friend SpectralLanes operator*(SpectralLanes left, float right) { return left *= right; }
  friend SpectralLanes operator+(SpectralLanes left, const SpectralLanes& right) { return left += right; }
};

}  // namespace gonio
