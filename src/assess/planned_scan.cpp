#include "assess/planned_scan.h"

#include <cmath>
#include <map>
#include <random>

#include "brdf/brdf.h"
#include "materials/database.h"

namespace gonio {
namespace {

ScanPoint pair_of(double theta_i_deg, double theta_o_deg, double phi_deg, double wavelength_nm, std::size_t incidence) {
  ScanPoint point;
  point.theta_i_deg = theta_i_deg, point.theta_o_deg = theta_o_deg, point.phi_o_deg = phi_deg;
  point.wavelength_nm = wavelength_nm, point.f_per_sr = 1, point.incidence = incidence;
  return point;
}

}  // namespace

Measurement planned_scan(const ScanPlan& plan) {
  Measurement scan;
  scan.id = "synthetic", scan.name = "synthetic scan", scan.wavelength_nm = 550;
  scan.incidences_deg = plan.incidences_deg;
  const double end = plan.largest_theta_o_deg + 1e-9;
  for (std::size_t i = 0; i < plan.incidences_deg.size(); ++i) {
    const double theta_i = plan.incidences_deg[i];
    for (double angle = -plan.largest_theta_o_deg + plan.offset_deg; angle <= end; angle += plan.step_deg)
      scan.points.push_back(pair_of(theta_i, std::abs(angle), angle < 0 ? 0 : 180, 550, i));
    if (!plan.across) continue;
    for (double angle = plan.step_deg - plan.offset_deg; angle <= end; angle += plan.step_deg)
      scan.points.push_back(pair_of(theta_i, angle, 90, 550, i));
  }
  return scan;
}

Measurement hemisphere_scan(std::size_t directions, std::span<const double> wavelengths_nm) {
  Measurement scan;
  scan.id = "synthetic", scan.name = "synthetic scan";
  scan.incidences_deg = {0, 15, 30, 45, 60};
  // The additive sequence of the plastic number (Roberts 2018): fills a square evenly at every length.
  constexpr double kFirst = 0.7548776662466927, kSecond = 0.5698402909980532;
  for (const double nm : wavelengths_nm)
    for (std::size_t d = 0; d < directions; ++d) {
      const std::size_t incidence = d % scan.incidences_deg.size();
      const double u = std::fmod(0.5 + kFirst * double(d), 1.0), v = std::fmod(0.5 + kSecond * double(d), 1.0);
      scan.points.push_back(pair_of(scan.incidences_deg[incidence], 80 * u, 360 * v, nm, incidence));
    }
  return scan;
}

Measurement filled(Measurement scan, const ModelSpec& spec, std::span<const double> values, const std::string& material,
                   double noise, std::uint64_t seed) {
  const SurfaceMaterial surface = material == "perfect" ? SurfaceMaterial::perfect() : SurfaceMaterial(material);
  const Brdf<double> brdf = make_brdf<double>(spec, values);
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::map<double, Interface<double>> at;
  for (ScanPoint& p : scan.points) {
    if (!at.contains(p.wavelength_nm)) at[p.wavelength_nm] = surface.at(p.wavelength_nm);
    p.f_per_sr = evaluate(brdf, directions_from_deg(p.theta_i_deg, p.theta_o_deg, p.phi_deg()), at[p.wavelength_nm],
                          p.wavelength_nm * 1e-3);
    if (noise > 0) p.f_per_sr *= std::exp(noise * normal(random));
  }
  return scan;
}

}  // namespace gonio
