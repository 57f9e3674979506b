#pragma once
#include <optional>
#include <string_view>
#include <vector>

#include "energy/lobe_energy.h"

namespace gonio {

/// Whether what a lobe's single scattering loses is given back, and how.
enum class CompensationKind { none, kulla_conty_2017 };
/// `none`, `kulla-conty-2017`; InputError for another name.
CompensationKind compensation_from(std::string_view name);

/// The energy that single scattering loses to other facets, given back by a reciprocal, nearly diffuse term (Kulla & Conty 2017, "Revisiting physically based
/// shading at Imageworks", SIGGRAPH course; after Kelemen & Szirmay-Kalos 2001):
///
///     f_c(i, o) = C·(1 - E(i))(1 - E(o))/(π(1 - Ē)),   C = R̄²Ē/(1 - R̄(1 - Ē))
///
/// E of the lobe on facets that reflect everything, Ē its hemispherical mean, R̄ that of R(cos θ). ∫ f_c cos_o dω_o = C·(1 - E(i)): with R = 1 the lobe and
/// f_c together reflect 1 at every incidence. Each is of one wavelength where the lobe diffracts.
class Compensation {
 public:
  /// InputError for a lobe whose E exceeds 1 (by more than its error), grows without bound, or is not the same from both sides.
  Compensation(const Lobe<double>& lobe, const SpectralSurface& surface);

  std::size_t wavelengths() const { return white_.size(); }
  /// f_c/C at one wavelength, per sr; both cosines above 0. cos_2phi: see AzimuthalCurve.
  double shape(std::size_t wavelength, double cos_i, double cos_2phi_i, double cos_o, double cos_2phi_o) const {
    const White& white = white_[wavelength];
    return white.missing(cos_i, cos_2phi_i) * white.missing(cos_o, cos_2phi_o) * white.factor;
  }
  /// C at each wavelength of the surface.
  const std::vector<double>& colour() const { return colour_; }
  /// ∫ f_c cos_o dω_o.
  double reflectance(std::size_t wavelength, double cos_theta, double cos_2phi = 1) const {
    return colour_[wavelength] * white_[white_.size() > 1 ? wavelength : 0].missing(cos_theta, cos_2phi);
  }
  /// 1 - E at the first wavelength, over all azimuths: for the shares of samples.
  double lost(double cos_theta) const { return 1 - white_.front().e.around()(cos_theta); }

 private:
  struct White {
    AzimuthalCurve e;
    double factor = 0;  ///< 1/(π(1 - Ē)); 0 where nothing is missing

    double missing(double cos_theta, double cos_2phi) const { return std::max(0.0, 1 - e(cos_theta, cos_2phi)); }
  };
  std::vector<White> white_;  ///< one, or one a wavelength
  std::vector<double> colour_;
};

}  // namespace gonio
