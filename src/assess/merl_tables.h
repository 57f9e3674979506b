#pragma once
// The published fits of the MERL materials (fit/published_parameters.h), evaluated with our models and set side by
// side.
#include <array>
#include <string>
#include <vector>

#include "fit/published_parameters.h"

namespace gonio {

/// Where the tables are compared: light at 45°, eye in the plane of incidence, the half vector 0 to 20° from the normal
/// on the near side (0 is the mirror direction).
inline constexpr double kMerlThetaI = 45;
inline constexpr std::array kMerlHalfDeg{0., 1., 2., 5., 10., 20.};
/// Where energies are.
inline constexpr std::array kMerlEnergyDeg{10., 75.};

/// One material under one table. f in 1/sr of the green channel; energies (directional reflectance with the diffuse
/// part and the coherent one) are the largest of the three channels.
struct MerlFit {
  std::string material;
  std::size_t table;  ///< in published_tables()
  double kd;
  std::array<double, kMerlHalfDeg.size()> f;
  std::array<double, kMerlEnergyDeg.size()> energy;
  bool no_lobe;  ///< the printed index is 1: F and the lobe are 0
};

/// f in the plane of incidence, θ_o positive on the mirror side. Tables that ask for a wavelength have it as their
/// unit of length (1 µm).
double merl_value(const PublishedFit& fit, double theta_o_deg, double theta_i_deg = kMerlThetaI);

/// Every material under every table that has it, by material, then in the tables' order.
std::vector<MerlFit> merl_fits();

/// log10 f of a fit less the median of all tables with a lobe for the same material, at position `half` of
/// kMerlHalfDeg.
struct MerlDeviation {
  std::string material;
  std::size_t table;
  std::array<double, kMerlHalfDeg.size()> decades;
};
std::vector<MerlDeviation> merl_deviations(const std::vector<MerlFit>& fits);

}  // namespace gonio
