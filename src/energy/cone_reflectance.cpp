#include "energy/cone_reflectance.h"

#include <cmath>

#include "energy/lobe_peak.h"
#include "energy/rings.h"

namespace gonio {
namespace {

using Vector = UnitVector<double>;

}  // namespace

ConeReflectance cone_reflectance(std::span<const Brdf<double>> lobes, double theta_i_deg,
                                 const Interface<double>& surface, double wavelength_um, const Cone& cone,
                                 const std::optional<Cone>& stop, double relative_tolerance, double phi_i_deg) {
  ConeReflectance found;
  const double degree = kPi<double> / 180, phi_i = phi_i_deg * degree;
  const auto frame = [&](const Cone& c) { return Frame::at(c.theta_deg * degree, phi_i + c.phi_deg * degree); };
  const auto cap = [&](const Cone& c) { return Cap{frame(c).p, c.half_angle_deg * degree}; };
  const double cos_i = cos_deg(theta_i_deg), sin_i = sin_deg(theta_i_deg);
  const Vector i{sin_i * std::cos(phi_i), sin_i * std::sin(phi_i), cos_i};
  Region aperture{{cap(cone)}, {}};
  if (stop) aperture.without.push_back(cap(*stop));
  const auto integrate = [&](const auto& f, const Frame& pole, std::vector<double> widths) {
    const Rings rings(f, pole, aperture, {.widths = std::move(widths)});
    add(to_relative_tolerance([&](double tolerance) { return rings.within(tolerance); }, 1e-3, relative_tolerance),
        found.total);
  };
  if (const double diffuse = evaluate_diffuse(lobes[0], surface); diffuse > 0) {
    const auto f = [&](const Vector&) { return diffuse; };
    integrate(f, frame(cone), {});
  }
  for (const Brdf<double>& brdf : lobes) {
    const Vector peak = peak_of(brdf, i);
    if (has_shape(brdf)) {
      const auto f = [&](const Vector& o) {
        return evaluate_lobe(brdf, reduce(i.x, i.y, i.z, o.x, o.y, o.z), surface, wavelength_um);
      };
      integrate(f, Frame::at(peak), widths_of(brdf, cos_i, wavelength_um));
    }
    if (aperture.has(peak)) found.coherent += coherent_energy(brdf, cos_i, surface, wavelength_um);
  }
  found.total.value += found.coherent;
  return found;
}

}  // namespace gonio
