#include "optics/kramers_kronig.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.h"
#include "base/number.h"

namespace gonio {
namespace {

/// ∫_0^x ln|(t + 1)/(t - 1)| dt/t: what a power law from 0 to x weighs in the phase at 1.
double kernel_integral(double x) {
  return x <= 1 ? 2 * legendre_chi2(x) : square(kPi<double>) / 2 - 2 * legendre_chi2(1 / x);
}

/// The same from x to infinity.
double tail_integral(double x) { return square(kPi<double>) / 2 - kernel_integral(x); }

/// The points 1 - R ~ √ω adds below the band, from low to high: four an octave, down to where R has reached 1.
void extend_hagen_rubens(std::vector<double>& frequency, std::vector<double>& log_amplitude) {
  const double first = frequency.front(), loss = 1 - std::exp(2 * log_amplitude.front());
  std::vector<double> x, l;
  for (int step = 120; step >= 1; --step) {
    const double ratio = std::exp2(-0.25 * step);
    x.push_back(first * ratio), l.push_back(0.5 * std::log1p(-loss * std::sqrt(ratio)));
  }
  frequency.insert(frequency.begin(), x.begin(), x.end());
  log_amplitude.insert(log_amplitude.begin(), l.begin(), l.end());
}

/// The range of k over an interval of phases: it has one maximum, where cos φ = 2√R/(1+R).
std::pair<double, double> range_of_k(double reflectance, double phase_lo, double phase_hi) {
  const double a = index_of_reflection(reflectance, phase_lo).k, b = index_of_reflection(reflectance, phase_hi).k;
  const double peak = std::acos(std::min(1.0, 2 * std::sqrt(reflectance) / (1 + reflectance)));
  const bool inside = phase_lo < peak && peak < phase_hi;
  return {std::min(a, b), inside ? index_of_reflection(reflectance, peak).k : std::max(a, b)};
}

void check(const Spectrum& data, const KramersKronigAssumption& assumption) {
  if (data.wavelength_nm.size() < 3)
    throw input_error("Kramers-Kronig: {} points of reflectance; expected at least three", data.wavelength_nm.size());
  for (std::size_t i = 0; i < data.value.size(); ++i)
    if (!(data.value[i] > 0 && data.value[i] <= 1))
      throw input_error("Kramers-Kronig: R = {} at {} nm; expected 0 < R <= 1", data.value[i], data.wavelength_nm[i]);
  if (!(assumption.decay_exponent >= 0 && assumption.decay_exponent <= 4))
    throw input_error("Kramers-Kronig: decay exponent {}; expected 0 to 4", assumption.decay_exponent);
  for (const double least : {assumption.least_longer, assumption.least_shorter})
    if (!(least > 0 && least <= 1))
      throw input_error("Kramers-Kronig: least reflectance {} outside the band; expected 0 < R <= 1", least);
}

}  // namespace

double legendre_chi2(double z) {
  if (z >= 1) return square(kPi<double>) / 8;
  if (z > 0.4142135623730951)  // its mirror (1-z)/(1+z) is smaller there, so that the series needs at most 25 terms
    return square(kPi<double>) / 8 + std::log(z) * std::atanh(z) - legendre_chi2((1 - z) / (1 + z));
  double sum = 0, power = z;
  for (int j = 1; power > 1e-18 * z; j += 2, power *= z * z) sum += power / (double(j) * j);
  return sum;
}

double phase_of_index(double n, double k) { return std::atan2(2 * k, (n - 1) * (n + 1) + k * k); }

IndexOfReflection index_of_reflection(double reflectance, double phase) {
  const double root = std::sqrt(reflectance), half = std::sin(phase / 2);
  const double below = square(1 - root) + 4 * root * square(half);  // 1 - 2√R·cos φ + R
  return {(1 - reflectance) / below, 2 * root * std::sin(phase) / below};
}

KramersKronig::KramersKronig(const Spectrum& reflectance, const KramersKronigAssumption& assumption)
    : assumption_(assumption), decay_exponent_(assumption.decay_exponent) {
  check(reflectance, assumption);
  for (std::size_t i = reflectance.value.size(); i-- > 0;) {
    band_.frequency.push_back(1 / reflectance.wavelength_nm[i]);
    band_.log_amplitude.push_back(0.5 * std::log(reflectance.value[i]));
  }
  const std::size_t count = band_.frequency.size();
  for (std::size_t i = 0; i < count; ++i)
    for (Curve* half : {&even_, &odd_})
      if ((i % 2 == 1) == (half == &odd_) || i == 0 || i + 1 == count)
        half->frequency.push_back(band_.frequency[i]), half->log_amplitude.push_back(band_.log_amplitude[i]);
  extended_ = band_;
  if (assumption.hagen_rubens)
    for (Curve* curve : {&extended_, &even_, &odd_}) extend_hagen_rubens(curve->frequency, curve->log_amplitude);
  if (assumption.known) decay_exponent_ = exponent_through(*assumption.known);
}

double KramersKronig::exponent_through(const KnownIndex& known) const {
  if (!(known.wavelength_nm >= lo_nm() && known.wavelength_nm <= hi_nm()) || !(known.n > 0) || !(known.k >= 0))
    throw input_error("Kramers-Kronig: known n = {}, k = {} at {} nm; expected n > 0, k >= 0 within {:g} to {:g} nm",
                      known.n, known.k, known.wavelength_nm, lo_nm(), hi_nm());
  const double w = 1 / known.wavelength_nm;
  return (phase_of_index(known.n, known.k) - band_phase(extended_, w)) * 2 * kPi<double> /
         tail_integral(band_.frequency.back() / w);
}

double KramersKronig::lo_nm() const { return 1 / band_.frequency.back(); }
double KramersKronig::hi_nm() const { return 1 / band_.frequency.front(); }

KramersKronigIndex KramersKronig::at(double wavelength_nm) const {
  const double w = std::clamp(1 / wavelength_nm, band_.frequency.front(), band_.frequency.back());
  const Interval possible = possible_phase(w);

  KramersKronigIndex result;
  result.reflectance = std::exp(2 * log_amplitude_at(band_, w));
  result.phase_lo = possible.lo, result.phase_hi = possible.hi;
  result.phase = std::clamp(assumed_phase(extended_, w), possible.lo, possible.hi);
  const IndexOfReflection index = index_of_reflection(result.reflectance, result.phase);
  result.n = index.n, result.k = index.k;
  result.n_lo = result.k_lo = std::numeric_limits<double>::infinity();
  result.n_hi = result.k_hi = 0;
  const double unsure = amplitude_error(w);
  for (const double shift : {-unsure, unsure}) {
    const double r = std::min(1.0, result.reflectance * std::exp(2 * shift));
    result.n_lo = std::min(result.n_lo, index_of_reflection(r, result.phase_hi).n);  // n falls with the phase
    result.n_hi = std::max(result.n_hi, index_of_reflection(r, result.phase_lo).n);
    const auto [k_lo, k_hi] = range_of_k(r, result.phase_lo, result.phase_hi);
    result.k_lo = std::min(result.k_lo, k_lo), result.k_hi = std::max(result.k_hi, k_hi);
  }
  return result;
}

double KramersKronig::amplitude_error(double frequency) const {
  for (const double point : band_.frequency)
    if (std::abs(point - frequency) <= 1e-12 * frequency) return 0;
  const double here = log_amplitude_at(band_, frequency);
  return std::abs(here - log_amplitude_at(even_, frequency)) + std::abs(here - log_amplitude_at(odd_, frequency));
}

double KramersKronig::log_amplitude_at(const Curve& curve, double frequency) {
  const auto& x = curve.frequency;
  const auto above = std::upper_bound(x.begin(), x.end(), frequency);
  const std::size_t hi = std::clamp<std::size_t>(static_cast<std::size_t>(above - x.begin()), 1, x.size() - 1);
  const double share = std::log(frequency / x[hi - 1]) / std::log(x[hi] / x[hi - 1]);
  return (1 - share) * curve.log_amplitude[hi - 1] + share * curve.log_amplitude[hi];
}

double KramersKronig::band_phase(const Curve& curve, double frequency) const {
  double sum = 0, below = kernel_integral(curve.frequency.front() / frequency);
  for (std::size_t i = 1; i < curve.frequency.size(); ++i) {
    const double above = kernel_integral(curve.frequency[i] / frequency);
    sum += (curve.log_amplitude[i] - curve.log_amplitude[i - 1]) /
           std::log(curve.frequency[i] / curve.frequency[i - 1]) * (above - below);
    below = above;
  }
  return -sum / kPi<double>;
}

double KramersKronig::assumed_phase(const Curve& curve, double frequency) const {
  return band_phase(curve, frequency) +
         decay_exponent_ / (2 * kPi<double>)*tail_integral(curve.frequency.back() / frequency);
}

KramersKronig::Outside KramersKronig::outside(double frequency) const {
  const double first = band_.frequency.front(), last = band_.frequency.back();
  return {std::log((frequency + first) / (frequency - first)) / kPi<double>,  // infinite at the ends, where R may jump
          std::log((last + frequency) / (last - frequency)) / kPi<double>,
          2 / kPi<double> * tail_integral(last / frequency)};
}

double KramersKronig::interpolation_error(double frequency) const {
  const double phase = band_phase(extended_, frequency);
  return std::abs(phase - band_phase(even_, frequency)) + std::abs(phase - band_phase(odd_, frequency));
}

KramersKronig::Interval KramersKronig::possible_phase(double frequency) const {
  double inside = band_phase(band_, frequency), error = interpolation_error(frequency);
  Outside reach = outside(frequency);
  if (assumption_.known) {
    const KnownIndex& known = *assumption_.known;
    const double w = 1 / known.wavelength_nm, share = frequency / w, phase = phase_of_index(known.n, known.k);
    error += share * interpolation_error(w);
    if (std::abs(share - 1) < 1e-12) return {std::max(0.0, phase - error), std::min(kPi<double>, phase + error)};
    inside += share * (phase - band_phase(band_, w));
    const Outside there = outside(w);
    reach = {reach.low - share * there.low, reach.high - share * there.high, reach.fall - share * there.fall};
  }
  const double at_first = band_.log_amplitude.front(), at_last = band_.log_amplitude.back();
  const double least_first = std::min(at_first, 0.5 * std::log(assumption_.least_longer));
  const double least_last = std::min(at_last, 0.5 * std::log(assumption_.least_shorter));
  const auto times = [](double a, double b) { return a == 0 ? 0 : a * b; };
  const auto [low_lo, low_hi] = std::minmax({times(least_first - at_first, reach.low), times(-at_first, reach.low)});
  const auto [high_lo, high_hi] =
      std::minmax({times(at_last, reach.high), times(at_last - least_last, reach.high) + reach.fall});
  const auto allowed = [](double phase) { return std::clamp(phase, 0.0, kPi<double>); };
  return {allowed(inside + low_lo + high_lo - error), allowed(inside + low_hi + high_hi + error)};
}

}  // namespace gonio
