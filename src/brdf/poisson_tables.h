#pragma once
// What the diffraction series takes from tables: 1/j, the step from one weight to the next, ln(j!·j), and the deviance as a polynomial.
#include <array>
#include <cmath>
#include <cstddef>

namespace gonio {

inline constexpr int kSeriesTable = 128;  ///< more terms than any lane below the turn has

template <class S>
inline const std::array<S, kSeriesTable> kSeriesInverse = [] {
  std::array<S, kSeriesTable> all{};
  for (int j = 1; j < kSeriesTable; ++j) all[std::size_t(j)] = S(1.0 / j);
  return all;
}();
/// g^j/(j!·j) over g^(j-1)/((j-1)!·(j-1)), but for g.
template <class S>
inline const std::array<S, kSeriesTable> kSeriesStep = [] {
  std::array<S, kSeriesTable> all{};
  for (int j = 2; j < kSeriesTable; ++j) all[std::size_t(j)] = S((j - 1.0) / (double(j) * j));
  return all;
}();
template <class S>
inline const std::array<S, kSeriesTable> kSeriesLog = [] {
  std::array<S, kSeriesTable> all{};
  long double factorial = 0;
  for (int j = 1; j < kSeriesTable; ++j) {
    factorial += std::log(static_cast<long double>(j));
    all[std::size_t(j)] = S(factorial + std::log(static_cast<long double>(j)));
  }
  return all;
}();

// [u·ln u - u + 1]/δ², u = (1+δ)²: minimax (Lawson's iteration, 45 digits), errors weighted by the term they belong to.
inline constexpr std::array<double, 12> kDeviance{
    1.999999999999620316,     0.6666666665224913613,   -0.1666666664502231579,  0.06666670078440334314,
    -0.03333334450067832096,  0.01904539546205491731,  -0.01190520811814897426, 0.007993710144888348094,
    -0.005525226997694092598, 0.003414847540636388289, -0.00348347009318290283, 0.004882598404374817359};
inline constexpr std::array<float, 6> kDevianceFloat{1.9999995173f,    0.6666827990611f,  -0.1665865451992f,
                                                     0.0659008526087f, -0.0353695095077f, 0.0263049964866f};

}  // namespace gonio
