#include "energy/directional_reflectance.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "brdf/sampling.h"
#include "energy/adaptive.h"
#include "energy/lobe_spectrum.h"

namespace gonio {
namespace {

/// Keeps what lies inside (lo, hi), sorted, with the two ends.
std::vector<double> breakpoints(double lo, double hi, const std::vector<double>& inside) {
  std::vector<double> points{lo, hi};
  for (const double x : inside)
    if (x > lo && x < hi) points.push_back(x);
  std::sort(points.begin(), points.end());
  return points;
}

std::vector<Estimate> estimates(const Integral& integral) {
  std::vector<Estimate> result;
  for (const double value : integral.value) result.push_back({value, integral.error, integral.converged});
  return result;
}

/// Whether a lobe looks at the grain (all of them are the same on both sides of it).
bool anisotropic(const Lobe<double>& lobe) {
  return std::visit(
      []<class L>(const L& one) {
        if constexpr (requires { one.alpha_x; })
          return one.alpha_x != one.alpha_y;
        else if constexpr (requires { one.n_u; })
          return one.n_u != one.n_v;
        else if constexpr (requires { one.c_x; })
          return one.c_x != one.c_y;
        else
          return false;
      },
      lobe);
}

/// The half vector's slope plane in polar coordinates, tan θ_h and azimuth φ from the plane of incidence, which lies at phi_i from the
/// grain. Isotropic lobes are the same on both sides of it.
class SlopePlane {
 public:
  SlopePlane(const LobeSpectrum& spectrum, double theta_i_deg, double phi_i_deg, bool both_sides,
             const SlopeExtent& extent, double tolerance)
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

  /// ∫ over φ at one tan θ_h: R·shape·cos_o·|dω_o/dω_h|·dω_h.
  double inner(double tan_h, Eigen::ArrayXd& out) const {
    const double cos_h = 1 / std::sqrt(1 + tan_h * tan_h), sin_h = tan_h * cos_h, across = sin_i_ * sin_h;
    const auto azimuth_of = [&](double cos_d) {  // where cos_d takes this value; clamped to [0, π]
      if (across < 1e-12) return cos_d <= cos_i_ * cos_h ? kPi<double> : 0.0;
      return std::acos(std::clamp((cos_d - cos_i_ * cos_h) / across, -1.0, 1.0));
    };
    const double horizon = azimuth_of(cos_i_ / (2 * cos_h)), kink_i = azimuth_of(2 * cos_h * cos_i_);
    const double other = 4 * cos_h * cos_h - 1, kink_o = other > 0 ? azimuth_of(2 * cos_h * cos_i_ / other) : 0.0;
    const auto integrand = [&](double phi, Eigen::ArrayXd& value) { facet(tan_h, cos_h, sin_h, across, phi, value); };
    std::vector<double> points = breakpoints(0, horizon, {kink_i, kink_o});
    if (both_sides_) points = with_grain(tan_h, horizon, {kink_i, -kink_i, kink_o, -kink_o, 0.0});
    const Integral integral =
        integrate_adaptively(integrand, points, spectrum_.size(), tolerance_, both_sides_ ? 120 : 40);
    out = integral.value;
    return integral.error;
  }

 private:
  void facet(double tan_h, double cos_h, double sin_h, double across, double phi, Eigen::ArrayXd& value) const {
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

  /// Cuts about the azimuths of the grain, where a ring of slopes wider than the narrow width meets the lobe.
  std::vector<double> with_grain(double tan_h, double horizon, std::vector<double> points) const {
    const double spread = std::asin(std::min(1.0, extent_.narrowest / tan_h));
    for (int quarter = -4; quarter <= 4; ++quarter) {
      const double grain = 0.5 * kPi<double> * quarter - phi_i_;
      for (const double k : {-16.0, -4.0, -1.0, 0.0, 1.0, 4.0, 16.0}) points.push_back(grain + k * spread);
    }
    return breakpoints(-horizon, horizon, points);
  }

  const LobeSpectrum& spectrum_;
  double cos_i_, sin_i_, phi_i_, cos_phi_, sin_phi_;
  bool both_sides_;
  SlopeExtent extent_;
  double tolerance_;
};

/// Projected directions o_xy = -i_xy + ρ(cos ψ, sin ψ): ρ = |(i + o)_xy|. Along ψ the disc ends at ρ_e; ρ = ρ_e(1 - s²)
/// takes the 1/cos_o of a Kirchhoff lobe at that end.
class ProjectedDisc {
 public:
  ProjectedDisc(const LobeSpectrum& spectrum, double theta_i_deg, double width, double tolerance)
      : spectrum_(spectrum),
        cos_i_(cos_deg(theta_i_deg)),
        sin_i_(sin_deg(theta_i_deg)),
        width_(width),
        tolerance_(tolerance) {}

  std::vector<double> outer_points() const {
    const double right = 0.5 * kPi<double>;
    return breakpoints(0, kPi<double>, {right, right - cos_i_, right + cos_i_, right - 4 * cos_i_, right + 4 * cos_i_});
  }

  double inner(double psi, Eigen::ArrayXd& out) const {
    const double along = sin_i_ * std::cos(psi), root = std::hypot(along, cos_i_);
    const double near = root + std::abs(along), far = cos_i_ * cos_i_ / near;
    const double edge = along >= 0 ? near : far, behind = along >= 0 ? far : near;
    const auto integrand = [&](double s, Eigen::ArrayXd& value) {
      const double rho = edge * (1 - s) * (1 + s), cos_o = s * std::sqrt(edge * (behind + rho)), sum = cos_i_ + cos_o;
      const Directions<double> w{cos_i_,
                                 cos_o,
                                 0.5 * std::hypot(rho, sum),
                                 (rho / sum) * (rho / sum),
                                 (sin_i_ / cos_i_) * (sin_i_ / cos_i_),
                                 std::max(0.0, (1 - cos_o) * (1 + cos_o)) / (cos_o * cos_o)};
      spectrum_.evaluate(w, 2 * rho * 2 * edge * s, value);
    };
    const auto s_of = [&](double rho) { return rho < edge ? std::sqrt(1 - rho / edge) : 0.0; };
    const std::vector<double> points =
        breakpoints(0, 1, {s_of(0.3 * width_), s_of(width_), s_of(2 * width_), s_of(4 * width_), s_of(8 * width_)});
    const Integral integral = integrate_adaptively(integrand, points, spectrum_.size(), tolerance_, 60);
    out = integral.value;
    return integral.error;
  }

 private:
  const LobeSpectrum& spectrum_;
  double cos_i_, sin_i_, width_, tolerance_;
};

/// The lobe's extent in direction cosines: slopes foreshortened, or diffraction by the correlation length.
double width_in_cosines(const Lobe<double>& lobe, double theta_i_deg, double wavelength_um) {
  const double foreshortening = 2 * std::max(cos_deg(theta_i_deg), 0.05);
  if (const auto* one = std::get_if<BeckmannKirchhoff<double>>(&lobe))
    return std::max(wavelength_um / (kPi<double> * one->correlation_um),
                    2 * one->sigma_um / one->correlation_um * foreshortening);
  if (const auto* he = std::get_if<HeTorrance<double>>(&lobe))
    return std::max(wavelength_um / (kPi<double> * he->correlation_um), he->alpha() * foreshortening);
  return slope_extent(lobe, wavelength_um).widest * foreshortening;
}

template <class Plane>
std::vector<Estimate> integrate_plane(const Plane& plane, const std::vector<double>& points, Eigen::Index size,
                                      double tolerance) {
  double worst_inner = 0;
  const auto outer = [&](double x, Eigen::ArrayXd& value) {
    worst_inner = std::max(worst_inner, plane.inner(x, value));
  };
  Integral integral = integrate_adaptively(outer, points, size, 0.5 * tolerance);
  integral.error += worst_inner * (points.back() - points.front());
  integral.converged = integral.error <= tolerance;
  return estimates(integral);
}

/// ∫ max(0, a + b·cos ψ) dψ over a turn, a, b >= 0.
double above_horizon(double a, double b) {
  if (b <= a) return 2 * kPi<double> * a;
  const double end = std::acos(-a / b);
  return 2 * (a * end + b * std::sin(end));
}

}  // namespace

std::vector<Estimate> reflectance_over_slopes(const Lobe<double>& lobe, double theta_i_deg,
                                              const SpectralSurface& surface, double tolerance, double phi_i_deg) {
  const LobeSpectrum spectrum(lobe, surface);
  const SlopeExtent extent = slope_extent(lobe, surface.wavelength_um.back());
  const auto plane = [&](double inner_tolerance) {
    return SlopePlane(spectrum, theta_i_deg, phi_i_deg, anisotropic(lobe), extent, inner_tolerance);
  };
  const std::vector<double> points = plane(1).outer_points();
  return integrate_plane(plane(0.25 * tolerance / (points.back() - points.front())), points, spectrum.size(),
                         tolerance);
}

std::vector<Estimate> reflectance_over_direction_cosines(const Lobe<double>& lobe, double theta_i_deg,
                                                         const SpectralSurface& surface, double tolerance) {
  const LobeSpectrum spectrum(lobe, surface);
  const ProjectedDisc disc(spectrum, theta_i_deg, width_in_cosines(lobe, theta_i_deg, surface.wavelength_um.back()),
                           0.1 * tolerance / kPi<double>);
  return integrate_plane(disc, disc.outer_points(), spectrum.size(), tolerance);
}

std::vector<Estimate> reflectance_about_axis(const Lafortune<double>& lobe, double theta_i_deg,
                                             const SpectralSurface& surface, double tolerance, double phi_i_deg) {
  const double phi_i = phi_i_deg * kPi<double> / 180, sin_i = sin_deg(theta_i_deg);
  const UnitVector<double> i{sin_i * std::cos(phi_i), sin_i * std::sin(phi_i), cos_deg(theta_i_deg)},
      v = lobe.sampler().axis(i);
  const double sin_v = std::hypot(v.x, v.y), x = sin_v > 0 ? v.x / sin_v : 1, y = sin_v > 0 ? v.y / sin_v : 0;
  // y = cos^(n+1) of the angle s from the axis makes the lobe's power flat; f is the same all around the axis.
  const auto integrand = [&](double power, Eigen::ArrayXd& value) {
    const double cos_s = std::pow(power, 1 / (lobe.n + 1)), fall = -std::expm1(std::log(power) / (lobe.n + 1));
    const double sin_s = std::sqrt(fall * (2 - fall));
    const double along = sin_v * cos_s - v.z * sin_s;  // towards the zenith from the axis: always above the horizon
    const auto w = reduce(i.x, i.y, i.z, along * x, along * y, v.z * cos_s + sin_v * sin_s);
    value.setConstant(lobe.shape(w) * above_horizon(v.z * cos_s, sin_v * sin_s) * cos_s / (power * (lobe.n + 1)));
  };
  const double kink = std::pow(sin_v, lobe.n + 1);  // the lobe's cone touches the horizon
  return estimates(
      integrate_adaptively(integrand, breakpoints(0, 1, {kink}), static_cast<Eigen::Index>(surface.size()), tolerance));
}

/// f ~ cos_o^-3: ∫ f·cos_o dω_o has no value, and a quadrature would look for it for ever.
void refuse_infinite(const Lobe<double>& lobe) {
  const auto* kirchhoff = std::get_if<BeckmannKirchhoff<double>>(&lobe);
  if (kirchhoff && kirchhoff->form == KirchhoffForm::nieto_vesperinas_1982)
    throw input_error(
        "beckmann-kirchhoff, nieto-vesperinas-1982: its directional reflectance is infinite (f grows as 1/cos_o^3 "
        "next to the horizon); expected another variant");
}

std::vector<Estimate> directional_reflectance(const Lobe<double>& lobe, double theta_i_deg,
                                              const SpectralSurface& surface, double tolerance, double phi_i_deg) {
  if (std::holds_alternative<Lambert>(lobe) || std::holds_alternative<Mirror>(lobe))
    return std::vector<Estimate>(surface.size());
  refuse_infinite(lobe);
  if (const auto* one = std::get_if<Lafortune<double>>(&lobe))
    return reflectance_about_axis(*one, theta_i_deg, surface, tolerance, phi_i_deg);
  if (diffracts(lobe)) return reflectance_over_direction_cosines(lobe, theta_i_deg, surface, tolerance);
  return reflectance_over_slopes(lobe, theta_i_deg, surface, tolerance, phi_i_deg);
}

bool looks_at_the_grain(const Lobe<double>& lobe) { return anisotropic(lobe); }

}  // namespace gonio
