#include "energy/material_energy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gonio {
namespace {

/// ks·(E + delta + compensation) of one lobe at one incidence and wavelength, the largest over azimuths.
double lobe_total(const MaterialEnergy& energy, std::size_t lobe, const Brdf<double>& brdf,
                  const SpectralSurface& surface, std::size_t w, double cosine) {
  const AzimuthalCurve& curve = energy.lobes[lobe].at(w);
  const double delta = coherent_energy(brdf, cosine, surface.interfaces[w], surface.wavelength_um[w]);
  double largest = 0;
  constexpr int kAzimuths = 13;
  for (int a = 0; a < (curve.has_grain() ? kAzimuths : 1); ++a) {
    const double cos_2phi = std::cos(a * kPi<double> / (kAzimuths - 1));
    double e = brdf.ks * curve(cosine, cos_2phi);
    if (!energy.compensations.empty()) e += brdf.ks * energy.compensations[lobe].reflectance(w, cosine, cos_2phi);
    largest = std::max(largest, e);
  }
  return largest + delta;
}

std::vector<double> cosines() {
  std::vector<double> all;
  const EnergyGrid grid;
  for (std::size_t c = 0; c < grid.columns; ++c) {
    const double here = grid.cos_theta(c);
    all.push_back(here);
    if (c + 1 < grid.columns) all.push_back(0.5 * (here + grid.cos_theta(c + 1)));
  }
  return all;
}

}  // namespace

MaterialEnergy::MaterialEnergy(const std::vector<Brdf<double>>& material, const SpectralSurface& surface,
                               CompensationKind kind) {
  for (const Brdf<double>& brdf : material) {
    lobes.emplace_back(brdf.lobe, surface);
    const bool shapeless = std::holds_alternative<Lambert>(brdf.lobe) || std::holds_alternative<Mirror>(brdf.lobe);
    if (kind == CompensationKind::kulla_conty_2017 && !shapeless) compensations.emplace_back(brdf.lobe, surface);
  }
  if (compensations.size() != lobes.size()) compensations.clear();  // a lambert or a mirror loses nothing
}

ReflectanceCurve::Largest lobes_reflectance(const MaterialEnergy& energy, const std::vector<Brdf<double>>& lobes,
                                            const SpectralSurface& surface, std::size_t wavelength,
                                            double theta_max_deg) {
  static const std::vector<double> incidences = cosines();
  ReflectanceCurve::Largest found;
  for (const double cosine : incidences) {
    if (cosine < cos_deg(theta_max_deg)) continue;
    double sum = 0;
    for (std::size_t j = 0; j < lobes.size(); ++j)
      if (lobes[j].ks > 0) sum += lobe_total(energy, j, lobes[j], surface, wavelength, cosine);
    if (sum > found.value) found = {sum, cosine};
  }
  return found;
}

EnergyBalance energy_balance(const MaterialEnergy& energy, const SampledLobes& materials,
                             const SurfaceSamples& samples) {
  EnergyBalance balance;
  balance.diffuse_least = std::numeric_limits<double>::infinity();
  const auto unbounded = [](const Brdf<double>& one) { return one.ks > 0 && unbounded_at_grazing(one.lobe); };
  for (const auto& lobes : materials)
    balance.bounded = balance.bounded && std::none_of(lobes.begin(), lobes.end(), unbounded);
  for (std::size_t w = 0; w < samples.surface.size(); ++w) {
    const std::vector<Brdf<double>>& lobes = materials[materials.size() > 1 ? w : 0];
    const double rho_d = lobes[0].diffuse_times_r0() ? samples.surface.interfaces[w].r0() : 1,
                 diffuse = lobes[0].kd * rho_d;
    double error = 0;
    for (std::size_t j = 0; j < lobes.size(); ++j) error += lobes[j].ks * energy.lobes[j].error();
    const auto largest =
        lobes_reflectance(energy, lobes, samples.surface, w, balance.bounded ? 90 : LobeEnergy::kUnboundedTo_deg);
    balance.error = std::max(balance.error, error + 1e-12);
    balance.diffuse_least = std::min(balance.diffuse_least, diffuse);
    balance.lobes_most = std::max(balance.lobes_most, largest.value);
    if (diffuse + largest.value > balance.total)
      balance.total = diffuse + largest.value, balance.theta_deg = std::acos(largest.cos_theta) * 180 / kPi<double>,
      balance.wavelength_nm = samples.wavelength_nm[w];
  }
  return balance;
}

std::string EnergyBalance::described() const {
  if (!bounded && total <= 1 + error)
    return fmt::format("its lobe grows without bound next to grazing (kd rho_d + ks E is {:.4f} at {:.4g} degrees)",
                       total, theta_deg);
  return fmt::format("kd rho_d + ks E is {:.4f} at {:.4g} degrees{}: (43) is broken by {:.4g}{}", total, theta_deg,
                     wavelength_nm > 0 ? fmt::format(" and {:g} nm", wavelength_nm) : "", total - 1,
                     bounded ? "" : ", and it grows without bound next to grazing");
}

}  // namespace gonio
