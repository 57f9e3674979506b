#pragma once
#include <optional>
#include <vector>

#include "brdf/lobe_sum.h"
#include "energy/compensation.h"
#include "energy/limits.h"

namespace gonio {

/// What a renderer knows of a material's energy: E of each lobe over the incidence, compensations, made once with the scene.
struct MaterialEnergy {
  std::vector<LobeEnergy> lobes;            ///< ks = 1
  std::vector<Compensation> compensations;  ///< none, or one a lobe

  /// From the tables where they stand for a lobe, else by quadrature. InputError where a lobe cannot be compensated, or has no E at all.
  MaterialEnergy(const std::vector<Brdf<double>>& material, const SpectralSurface& surface, CompensationKind kind);
};

/// (43) of a material, kd·ρd + Σ ks·(E + delta + compensation) <= 1 at every incidence and wavelength, from its curves.
struct EnergyBalance {
  double total = 0, theta_deg = 0, wavelength_nm = 0;  ///< where it is largest
  double error = 0;                                    ///< of total
  bool bounded =
      true;  ///< false: some lobe grows without bound beyond LobeEnergy::kUnboundedTo_deg, where total was not looked for
  double diffuse_least = 0, lobes_most = 0;  ///< min kd·ρd over wavelengths, max Σ ks·E: Maillot 1996 §III.8

  bool holds() const { return bounded && total <= 1 + error; }
  /// "diffuse" where kd·min ρd > ks·max E, else "specular" (Maillot 1996, §III.8).
  const char* behaviour() const { return diffuse_least > lobes_most ? "diffuse" : "specular"; }
  /// "kd rho_d + ks E is 1.149 at 89 degrees and 550 nm": what is wrong, where it does not hold.
  std::string described() const;
};

/// The largest of Σ ks·(E + delta + compensation) at one wavelength, over incidences to `theta_max_deg` and azimuths.
ReflectanceCurve::Largest lobes_reflectance(const MaterialEnergy& energy, const std::vector<Brdf<double>>& lobes,
                                            const SpectralSurface& surface, std::size_t wavelength,
                                            double theta_max_deg = 90);

/// `materials`: the lobes at each wavelength (kd and ks may differ), or one list for all.
EnergyBalance energy_balance(const MaterialEnergy& energy, const SampledLobes& materials,
                             const SurfaceSamples& samples);

}  // namespace gonio
