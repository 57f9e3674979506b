#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "brdf/sampling.h"
#include "energy/adaptive.h"

namespace gonio {

/// The half vector's slope plane in polar coordinates, tan θ_h and azimuth φ from the plane of incidence, which lies at phi_i from the
/// grain. Isotropic lobes are the same on both sides of it.
template <class Spectrum>
class SlopePlane {
 public:
  SlopePlane(const Spectrum& spectrum, double theta_i_deg, double phi_i_deg, bool both_sides, const SlopeExtent& extent,
             double tolerance)
      : spectrum_(spectrum),
        cos_i_(cos_deg(theta_i_deg)),
        sin_i_(sin_deg(theta_i_deg)),
        phi_i_(phi_i_deg * kPi<double> / 180),
        cos_phi_(std::cos(phi_i_)),
        sin_phi_(std::sin(phi_i_)),
        both_sides_(both_sides),
        extent_(extent),
        tolerance_(tolerance) {}

  /// Tangents of θ_h at which, in the plane of incidence, o meets the horizon and G of the V-cavity has its kinks; at 45°
  /// and 60° these meet each other.
  std::vector<double> outer_points() const {
    const double theta_i = std::atan2(sin_i_, cos_i_), right = 0.5 * kPi<double>;
    const double end = std::tan(std::min(0.5 * (right + theta_i), right - 1e-9));
    const double most = extent_.gaussian ? std::min(end, 9 * extent_.widest) : end;  // exp(-81) of a Gaussian is left
    std::vector<double> points{std::tan(0.5 * (right - theta_i)),
                               std::tan(right - theta_i),
                               std::tan((right - theta_i) / 3),
                               std::tan((right + theta_i) / 3),
                               1.0,
                               std::sqrt(3.0),
                               4.0,
                               20.0,
                               100.0};
    for (const double width : {extent_.narrowest, extent_.widest})
      for (const double k : {0.5, 1.5, 3.0, 5.0, 20.0, 100.0, 1000.0}) points.push_back(k * width);
    return breakpoints(0, most, points);
  }

  /// Azimuths at one tan θ_h between which the integrand is smooth: the horizon of o and the kinks of G.
  std::vector<double> inner_points(double tan_h) const {
    const double cos_h = 1 / std::sqrt(1 + tan_h * tan_h), sin_h = tan_h * cos_h, across = sin_i_ * sin_h;
    const auto azimuth_of = [&](double cos_d) {  // where cos_d takes this value; clamped to [0, π]
      if (across < 1e-12) return cos_d <= cos_i_ * cos_h ? kPi<double> : 0.0;
      return std::acos(std::clamp((cos_d - cos_i_ * cos_h) / across, -1.0, 1.0));
    };
    const double horizon = azimuth_of(cos_i_ / (2 * cos_h)), kink_i = azimuth_of(2 * cos_h * cos_i_);
    const double other = 4 * cos_h * cos_h - 1, kink_o = other > 0 ? azimuth_of(2 * cos_h * cos_i_ / other) : 0.0;
    const double even = azimuth_of(cos_i_ / cos_h);  // masking and shadowing are the same there
    if (both_sides_) return with_grain(tan_h, horizon, {kink_i, -kink_i, kink_o, -kink_o, even, -even, 0.0});
    return breakpoints(0, horizon, {kink_i, kink_o, even});
  }

  /// ∫ over φ at one tan θ_h: R·shape·cos_o·|dω_o/dω_h|·dω_h.
  double inner(double tan_h, Eigen::ArrayXd& out) const {
    const auto integrand = [&](double phi, Eigen::ArrayXd& value) { facet(tan_h, phi, value); };
    const Integral integral =
        integrate_adaptively(integrand, inner_points(tan_h), spectrum_.size(), tolerance_, both_sides_ ? 120 : 40);
    out = integral.value;
    return integral.error;
  }

  /// The integrand at one slope.
  template <class Value>
  void facet(double tan_h, double phi, Value& value) const {
    const double cos_h = 1 / std::sqrt(1 + tan_h * tan_h), sin_h = tan_h * cos_h, across = sin_i_ * sin_h;
    const double half_sine = std::sin(0.5 * phi);
    const double cos_d = cos_i_ * cos_h + across * (1 - 2 * half_sine * half_sine);
    const double cos_o = 2 * cos_d * cos_h - cos_i_;
    if (cos_o <= 0 || cos_d <= 0) {
      value.setZero();
      return;
    }
    const double h_in = 2 * cos_d * sin_h * std::cos(phi), h_across = 2 * cos_d * sin_h * std::sin(phi);
    const double ix = sin_i_ * cos_phi_, iy = sin_i_ * sin_phi_;
    const double hx = h_in * cos_phi_ - h_across * sin_phi_, hy = h_in * sin_phi_ + h_across * cos_phi_;
    const Directions<double> w{cos_i_,
                               cos_o,
                               cos_d,
                               tan_h * tan_h,
                               (sin_i_ / cos_i_) * (sin_i_ / cos_i_),
                               std::max(0.0, (1 - cos_o) * (1 + cos_o)) / (cos_o * cos_o),
                               ix,
                               iy,
                               hx - ix,
                               hy - iy,
                               hx,
                               hy};
    const double sides = both_sides_ ? 1 : 2;
    spectrum_.evaluate(w, sides * tan_h * cos_h * cos_h * cos_h * 4 * cos_d * cos_o, value);
  }

 private:
  /// Cuts about the azimuths of the grain, where a ring of slopes wider than the narrow width meets the lobe.
  std::vector<double> with_grain(double tan_h, double horizon, std::vector<double> points) const {
    const double spread = std::asin(std::min(1.0, extent_.narrowest / tan_h));
    for (int quarter = -4; quarter <= 4; ++quarter) {
      const double grain = 0.5 * kPi<double> * quarter - phi_i_;
      for (const double k : {-16.0, -4.0, -1.0, 0.0, 1.0, 4.0, 16.0}) points.push_back(grain + k * spread);
    }
    return breakpoints(-horizon, horizon, points);
  }

  const Spectrum& spectrum_;
  double cos_i_, sin_i_, phi_i_, cos_phi_, sin_phi_;
  bool both_sides_;
  SlopeExtent extent_;
  double tolerance_;
};

}  // namespace gonio
