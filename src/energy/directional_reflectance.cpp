#include "energy/directional_reflectance.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "brdf/sampling.h"
#include "energy/adaptive.h"
#include "energy/lobe_spectrum.h"
#include "energy/slope_plane.h"

namespace gonio {
namespace {

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

// ∫ f·cos_o dω_o has no value, and a quadrature would look for it for ever.
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
