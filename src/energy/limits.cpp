#include "energy/limits.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "energy/lobe_energy.h"

namespace gonio {
namespace {

/// Everything (43) asks of one incidence, over all wavelengths.
struct AtAngle {
  LimitRow row;              ///< the wavelength of the largest E + coherent
  LimitRow worst_total;      ///< the wavelength of the largest total
  double largest_e = 0;      ///< max of E + coherent + error
  double smallest_kd = 1e9;  ///< min of (1 - ks(E + coherent + error))/ρd
  double diffuse_least = 1e9, lobes_most = 0;
};

/// A material over the samples' wavelengths.
struct Sampled {
  const SampledLobes& lobes;
  const SurfaceSamples& samples;

  const std::vector<Brdf<double>>& at(std::size_t wavelength) const { return lobes[lobes.size() > 1 ? wavelength : 0]; }
  const std::vector<Brdf<double>>& any() const { return lobes.front(); }  // alike but for kd and ks
  /// What E holds of a lobe's ks, and what is left to multiply E by.
  double within(const Brdf<double>& lobe) const { return any().size() > 1 ? lobe.ks : 1; }
  double beside(const Brdf<double>& lobe) const { return any().size() > 1 ? 1 : lobe.ks; }

  double coherent(std::size_t wavelength, double cos_i) const {
    double sum = 0;
    for (Brdf<double> lobe : at(wavelength)) {
      lobe.ks = within(lobe);
      sum += coherent_energy(lobe, cos_i, samples.surface.interfaces[wavelength],
                             samples.surface.wavelength_um[wavelength]);
    }
    return sum;
  }
};

/// E of the lobes together, one value a wavelength.
std::vector<Estimate> reflected(const Sampled& material, double theta_deg, double phi_deg, double tolerance) {
  const SpectralSurface& surface = material.samples.surface;
  std::vector<Estimate> sum(surface.size());
  for (std::size_t j = 0; j < material.any().size(); ++j) {
    const auto e = directional_reflectance(material.any()[j].lobe, theta_deg, surface, tolerance, phi_deg);
    for (std::size_t i = 0; i < surface.size(); ++i) {
      const double share = material.within(material.at(i)[j]);
      sum[i].value += share * e[i].value;
      sum[i].error += share * e[i].error;
      sum[i].converged = sum[i].converged && e[i].converged;
    }
  }
  return sum;
}

AtAngle look_along(const Sampled& material, double theta_deg, double phi_deg, double tolerance) {
  const SpectralSurface& surface = material.samples.surface;
  const std::vector<Estimate> e = reflected(material, theta_deg, phi_deg, tolerance);
  AtAngle result;
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const Brdf<double>& first = material.at(i).front();
    const double rho_d = first.diffuse_times_r0() ? surface.interfaces[i].r0() : 1, ks = material.beside(first);
    const double coherent = material.coherent(i, cos_deg(theta_deg));
    const double whole = e[i].value + coherent, bound = whole + e[i].error;
    const LimitRow row{theta_deg, material.samples.wavelength_nm[i], e[i],
                       coherent,  first.kd * rho_d + ks * whole,     phi_deg};
    if (i == 0 || bound > result.largest_e) result.row = row;
    if (i == 0 || row.total > result.worst_total.total) result.worst_total = row;
    result.largest_e = std::max(result.largest_e, bound);
    result.diffuse_least = std::min(result.diffuse_least, first.kd * rho_d);
    result.lobes_most = std::max(result.lobes_most, ks * whole);
    if (rho_d > 0) result.smallest_kd = std::min(result.smallest_kd, (1 - ks * bound) / rho_d);
  }
  return result;
}

/// The worst of the light's azimuths where a lobe looks at the grain, 15° apart over the quarter that holds them all.
AtAngle look_at(const Sampled& material, double theta_deg, double tolerance) {
  AtAngle worst = look_along(material, theta_deg, 0, tolerance);
  const auto& lobes = material.any();
  if (std::none_of(lobes.begin(), lobes.end(), [](const auto& one) { return looks_at_the_grain(one.lobe); }))
    return worst;
  for (int phi_deg = 15; phi_deg <= 90; phi_deg += 15) {
    const AtAngle one = look_along(material, theta_deg, phi_deg, tolerance);
    if (one.largest_e > worst.largest_e) worst.row = one.row;
    if (one.worst_total.total > worst.worst_total.total) worst.worst_total = one.worst_total;
    worst.largest_e = std::max(worst.largest_e, one.largest_e);
    worst.lobes_most = std::max(worst.lobes_most, one.lobes_most);
    worst.smallest_kd = std::min(worst.smallest_kd, one.smallest_kd);
  }
  return worst;
}

void take(Limits& limits, const AtAngle& at, double& largest_e, double& smallest_kd) {
  largest_e = std::max(largest_e, at.largest_e);
  smallest_kd = std::min(smallest_kd, at.smallest_kd);
  limits.diffuse_least = at.diffuse_least;  // the same at every incidence
  limits.lobes_most = std::max(limits.lobes_most, at.lobes_most);
  limits.worst_error = std::max(limits.worst_error, at.row.e.error);
  if (at.worst_total.total > limits.worst_total) {
    limits.worst_total = at.worst_total.total;
    limits.worst_theta_deg = at.worst_total.theta_deg;
    limits.worst_wavelength_nm = at.worst_total.wavelength_nm;
  }
}

}  // namespace

std::vector<double> limit_angles_deg() {
  std::vector<double> angles;
  for (int theta = 0; theta <= 85; theta += 5) angles.push_back(theta);
  for (const double theta : {87.0, 88.0, 89.0, 89.5, 89.9, 89.99}) angles.push_back(theta);
  return angles;
}

Limits conservation_limits(const SampledLobes& lobes, const SurfaceSamples& samples, std::vector<double> angles_deg,
                           double theta_max_deg_if_unbounded, double tolerance) {
  const Sampled material{lobes, samples};
  Limits limits;
  limits.bounded = std::none_of(material.any().begin(), material.any().end(),
                                [](const Brdf<double>& one) { return unbounded_at_grazing(one.lobe); });
  limits.theta_max_deg = limits.bounded ? 90 : theta_max_deg_if_unbounded;
  limits.range_lo_nm = samples.wavelength_nm.front();
  limits.range_hi_nm = samples.wavelength_nm.back();
  std::erase_if(angles_deg, [&](double theta) { return theta > limits.theta_max_deg; });
  constexpr double kGrazing_deg = 89.9999;  // E of bounded lobes is level from there on
  angles_deg.push_back(limits.bounded ? kGrazing_deg : limits.theta_max_deg);
  std::sort(angles_deg.begin(), angles_deg.end());
  angles_deg.erase(std::unique(angles_deg.begin(), angles_deg.end()), angles_deg.end());

  std::vector<AtAngle> at(angles_deg.size());
  tbb::parallel_for(std::size_t(0), at.size(),
                    [&](std::size_t i) { at[i] = look_at(material, angles_deg[i], tolerance); });
  double largest_e = 0, smallest_kd = 1e9;
  std::size_t peak = 0;
  for (std::size_t i = 0; i < at.size(); ++i) {
    take(limits, at[i], largest_e, smallest_kd);
    limits.rows.push_back(at[i].row);
    if (at[i].largest_e > at[peak].largest_e) peak = i;
  }
  // Between the peak's neighbours: nine angles, twice.
  double lo = angles_deg[peak > 0 ? peak - 1 : 0], hi = angles_deg[std::min(peak + 1, angles_deg.size() - 1)];
  for (int pass = 0; pass < 2 && hi > lo; ++pass) {
    std::vector<AtAngle> between(9);
    const auto angle = [&](std::size_t i) { return lo + (hi - lo) * static_cast<double>(i + 1) / 10; };
    tbb::parallel_for(std::size_t(0), between.size(),
                      [&](std::size_t i) { between[i] = look_at(material, angle(i), tolerance); });
    std::size_t best = 0;
    for (std::size_t i = 0; i < between.size(); ++i) {
      take(limits, between[i], largest_e, smallest_kd);
      if (between[i].largest_e > between[best].largest_e) best = i;
    }
    const double middle = angle(best), step = (hi - lo) / 10;
    lo = middle - step;
    hi = middle + step;
  }
  for (std::size_t i = 0; i < samples.surface.size(); ++i)
    limits.coherent_energy = std::max(limits.coherent_energy, material.coherent(i, 1.0));
  limits.ks_max = largest_e > 0 ? 1 / largest_e : std::numeric_limits<double>::infinity();
  limits.kd_max = std::max(0.0, smallest_kd);
  return limits;
}

}  // namespace gonio
