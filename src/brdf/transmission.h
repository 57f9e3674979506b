#pragma once
// Light that a model lets through to the other side of the surface.
#include "brdf/brdf.h"
#include "brdf/polarised.h"

namespace gonio {

/// Whether the model has a transmitted part.
template <class T>
bool transmits(const Brdf<T>& brdf) {
  return std::holds_alternative<RoughDielectric<T>>(brdf.lobe) && !brdf.retro;
}

/// From degrees: zenith angle 0 to 180 (above 90: below the surface), azimuth phi.
template <class T>
UnitVector<T> direction_from_deg(const T& theta_deg, const Azimuth<T>& phi) {
  const bool below = theta_deg > T(90);
  const T from_axis = below ? T(T(180) - theta_deg) : theta_deg, sine = sin_deg(from_axis), cosine = cos_deg(from_axis);
  return {sine * phi.cos_phi(), sine * phi.sin_phi, below ? T(-cosine) : cosine};
}

/// f_t in sr⁻¹, for radiance, from i (z > 0) to o (z < 0): ks·lobe, nothing of the diffuse part. The interface is taken as
/// transparent, its n that of the far over the near side.
template <class T>
T evaluate_transmission(const Brdf<T>& brdf, const UnitVector<T>& i, const UnitVector<T>& o,
                        const Interface<T>& surface) {
  const auto* dielectric = std::get_if<RoughDielectric<T>>(&brdf.lobe);
  return dielectric && !surface.perfect ? brdf.ks * dielectric->transmission(i, o, surface.n) : T(0);
}

/// The same as a Mueller matrix, between the frames of the mean plane (brdf/polarised.h).
template <class T>
Mueller<T> transmission_mueller(const Brdf<T>& brdf, const UnitVector<T>& i, const UnitVector<T>& o,
                                const Azimuth<T>& azimuth, const Interface<T>& surface) {
  return evaluate_transmission(brdf, i, o, surface) * normalised_mueller(refraction_jones(i, o, azimuth));
}

/// f_t of linearly polarised light, received in any polarisation.
template <class T>
T transmission_linear(const Brdf<T>& brdf, const UnitVector<T>& i, const UnitVector<T>& o, const Azimuth<T>& azimuth,
                      const Interface<T>& surface, const LinearLight<T>& light) {
  const Jones<T> jones = refraction_jones(i, o, azimuth);
  return evaluate_transmission(brdf, i, o, surface) * (intensity_of(jones, light) / unpolarised_intensity_of(jones));
}

}  // namespace gonio
