#include "cli/scan_quality.h"

#include <fmt/format.h>

#include <cmath>
#include <iostream>

namespace gonio::cli {
namespace {

void print_pairs(const char* title, const PairStatistics& pairs) {
  if (pairs.pairs == 0) return;
  const auto percent = [](double log10_ratio) { return 100 * (std::pow(10, log10_ratio) - 1); };
  std::cout << fmt::format("  {:<12} {} pairs differ by {:.2g} % (rms {:.2g} %)\n", title, pairs.pairs,
                           percent(pairs.spread_log10), percent(pairs.rms_log10));
}

}  // namespace

void print_quality(const ScanQuality& quality, const std::optional<NoiseEstimate>& noise) {
  constexpr std::size_t kMostShown = 12;
  print_pairs("repeats", quality.repeats);
  print_pairs("reciprocal", quality.reciprocal);
  if (noise)
    std::cout << fmt::format("  {:<12} {:.2g} % of a value (one standard deviation, from {})\n", "noise",
                             100 * noise->relative_sd, noise->from == "repeats" ? "repeats" : "reciprocal pairs");
  for (std::size_t k = 0; k < std::min(quality.energies.size(), kMostShown); ++k) {
    const ScanEnergy& e = quality.energies[k];
    const bool stated = e.wavelength_nm == e.wavelength_nm;
    std::cout << fmt::format("  {:<12} {:.4f} +- {:.1g} of the light from {:g} degrees{}\n", "reflectance",
                             e.reflectance, e.error, e.theta_i_deg,
                             stated ? fmt::format(", {:g} nm", e.wavelength_nm) : "");
  }
  if (quality.energies.size() > kMostShown)
    std::cout << fmt::format("  {:<12} and {} more (--json)\n", "", quality.energies.size() - kMostShown);
  for (const std::string& warning : quality.warnings) std::cout << "  warning      " << warning << '\n';
}

}  // namespace gonio::cli
