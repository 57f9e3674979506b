#include "energy/cone_reflectance.h"

#include <algorithm>
#include <cmath>

#include "base/unit_vector.h"
#include "brdf/lobe_sum.h"
#include "brdf/sampling.h"
#include "energy/adaptive.h"

namespace gonio {
namespace {

using Vector = UnitVector<double>;

const double kTurn = 2 * kPi<double>;

double haversine(double angle) { return square(std::sin(0.5 * angle)); }

/// A direction and the two across it, e1 away from the zenith.
struct Frame {
  Vector p, e1, e2;

  static Frame at(double theta, double phi) {
    const double c = std::cos(theta), s = std::sin(theta), cp = std::cos(phi), sp = std::sin(phi);
    return {{s * cp, s * sp, c}, {c * cp, c * sp, -s}, {-sp, cp, 0}};
  }
  static Frame at(const Vector& p) { return at(std::atan2(std::hypot(p.x, p.y), p.z), std::atan2(p.y, p.x)); }

  Vector direction(double s, double psi) const {
    const double along = std::cos(s), a = std::sin(s) * std::cos(psi), b = std::sin(s) * std::sin(psi);
    return {along * p.x + a * e1.x + b * e2.x, along * p.y + a * e1.y + b * e2.y, along * p.z + a * e1.z + b * e2.z};
  }
};

/// Directions within `radius` of an axis, in the surface's own frame.
struct Cap {
  Vector axis;
  double radius;

  bool has(const Vector& o) const {  // by the chord, which keeps small angles
    const double chord2 = square(o.x - axis.x) + square(o.y - axis.y) + square(o.z - axis.z);
    return chord2 <= 4 * haversine(radius) * (1 + 1e-12);
  }
};

/// A cap as rings about a pole meet it.
struct CapFromPole {
  double distance, azimuth, radius;

  CapFromPole(const Cap& cap, const Frame& pole) : radius(cap.radius) {
    const double a = dot(cap.axis, pole.e1), b = dot(cap.axis, pole.e2);
    distance = std::atan2(std::hypot(a, b), dot(cap.axis, pole.p)), azimuth = std::atan2(b, a);
  }
  /// Where a ring begins or ceases to meet the edge.
  void add_radii(std::vector<double>& cuts) const {
    for (const double s : {std::abs(distance - radius), distance + radius, kTurn - distance - radius})
      cuts.push_back(s);
  }
  /// The azimuths, in [0, 2π), at which the ring s crosses the edge: hav r = hav(s - d) + sin s·sin d·hav ψ.
  void add_azimuths(double s, std::vector<double>& cuts) const {
    const double across = std::sin(s) * std::sin(distance), rest = haversine(radius) - haversine(s - distance);
    if (!(rest > 0 && rest < across)) return;
    const double psi = 2 * std::asin(std::sqrt(rest / across));
    for (const double at : {azimuth - psi, azimuth + psi}) cuts.push_back(at - kTurn * std::floor(at / kTurn));
  }
};

std::vector<double> sorted_within(double lo, double hi, const std::vector<double>& cuts) {
  std::vector<double> points{lo, hi};
  for (const double x : cuts)
    if (x > lo && x < hi) points.push_back(x);
  std::sort(points.begin(), points.end());
  return points;
}

/// What is collected: the cone, above the horizon, less the stop.
struct Aperture {
  Cap cone;
  std::optional<Cap> stop;

  bool has(const Vector& o) const { return o.z > 0 && cone.has(o) && !(stop && stop->has(o)); }
};

/// ∫ f·cos_o dω_o of one part of f, in rings about `pole`, where it is `width` wide.
template <class F>
class Rings {
 public:
  Rings(const F& f, const Frame& pole, std::vector<double> widths, const Aperture& aperture)
      : f_(f), pole_(pole), widths_(std::move(widths)), aperture_(aperture) {
    edges_ = {CapFromPole(aperture.cone, pole), CapFromPole({{0, 0, 1}, 0.5 * kPi<double>}, pole)};
    if (aperture.stop) edges_.emplace_back(*aperture.stop, pole);
  }

  /// Passes of a finer tolerance until the error is small beside the value that the last one found.
  Estimate integrate(double relative_tolerance) const {
    constexpr int kPasses = 5;
    double tolerance = 1e-3;
    Estimate found;
    for (int pass = 0; pass < kPasses; ++pass) {
      found = within(tolerance);
      found.converged = found.error <= relative_tolerance * std::abs(found.value);
      if (found.converged) break;
      tolerance = std::min(0.01 * tolerance, 0.5 * relative_tolerance * std::abs(found.value));
      if (!(tolerance > 1e-16)) tolerance = 1e-16;
    }
    return found;
  }

 private:
  Estimate within(double tolerance) const {
    const CapFromPole& cone = edges_.front();
    std::vector<double> cuts;
    for (const CapFromPole& edge : edges_) edge.add_radii(cuts);
    for (const double width : widths_)
      for (const double k : {0.25, 0.5, 1.0, 1.5, 2.0, 3.0, 5.0, 8.0, 20.0, 100.0, 1000.0}) cuts.push_back(k * width);
    const std::vector<double> radii = sorted_within(std::max(0.0, cone.distance - cone.radius),
                                                    std::min(kPi<double>, cone.distance + cone.radius), cuts);
    const double range = radii.back() - radii.front();
    double worst_inner = 0;
    const auto ring = [&](double s, Eigen::ArrayXd& value) {
      const Integral one = around(s, 0.25 * tolerance / range);
      value[0] = one.value[0];
      worst_inner = std::max(worst_inner, one.error);
    };
    const Integral whole = integrate_adaptively(ring, radii, 1, 0.5 * tolerance, 400);
    return {whole.value[0], whole.error + range * worst_inner, false};
  }

  Integral around(double s, double tolerance) const {
    const double right = 0.5 * kPi<double>;
    std::vector<double> cuts{right, 2 * right, 3 * right};  // the plane of incidence and across it
    for (const CapFromPole& edge : edges_) edge.add_azimuths(s, cuts);
    const auto integrand = [&](double psi, Eigen::ArrayXd& value) {
      const Vector o = pole_.direction(s, psi);
      value[0] = aperture_.has(o) ? f_(o) * o.z * std::sin(s) : 0.0;
    };
    return integrate_adaptively(integrand, sorted_within(0, kTurn, cuts), 1, tolerance, 100);
  }

  const F& f_;
  const Frame& pole_;
  std::vector<double> widths_;
  const Aperture& aperture_;
  std::vector<CapFromPole> edges_;
};

/// Where a lobe lit from i is highest.
Vector peak_of(const Brdf<double>& brdf, const Vector& i) {
  const Vector given = brdf.retro ? Vector{-i.x, -i.y, i.z} : i;
  if (const auto* one = std::get_if<Lafortune<double>>(&brdf.lobe)) return one->sampler().axis(given);
  return {-given.x, -given.y, given.z};
}

/// Of the lobe in directions: twice its slopes, the narrower foreshortened, and the width of diffraction.
std::vector<double> widths_of(const Brdf<double>& brdf, double cos_i, double wavelength_um) {
  const SlopeExtent slopes = slope_extent(brdf.lobe, wavelength_um);
  return {2 * slopes.widest, 2 * slopes.narrowest, 2 * slopes.narrowest * cos_i};
}

void add(const Estimate& part, Estimate& sum) {
  sum.value += part.value, sum.error += part.error;
  sum.converged = sum.converged && part.converged;
}

}  // namespace

ConeReflectance cone_reflectance(std::span<const Brdf<double>> lobes, double theta_i_deg,
                                 const Interface<double>& surface, double wavelength_um, const Cone& cone,
                                 const std::optional<Cone>& stop, double relative_tolerance, double phi_i_deg) {
  const double degree = kPi<double> / 180, phi_i = phi_i_deg * degree;
  const auto frame = [&](const Cone& c) { return Frame::at(c.theta_deg * degree, phi_i + c.phi_deg * degree); };
  const auto cap = [&](const Cone& c) { return Cap{frame(c).p, c.half_angle_deg * degree}; };
  const double cos_i = cos_deg(theta_i_deg), sin_i = sin_deg(theta_i_deg);
  const Vector i{sin_i * std::cos(phi_i), sin_i * std::sin(phi_i), cos_i};
  const Aperture aperture{cap(cone), stop ? std::optional(cap(*stop)) : std::nullopt};
  ConeReflectance found;
  if (const double diffuse = evaluate_diffuse(lobes[0], surface); diffuse > 0) {
    const auto f = [&](const Vector&) { return diffuse; };
    const Frame axis = frame(cone);
    add(Rings(f, axis, {}, aperture).integrate(relative_tolerance), found.total);
  }
  for (const Brdf<double>& brdf : lobes) {
    const bool shapeless = std::holds_alternative<Lambert>(brdf.lobe) || std::holds_alternative<Mirror>(brdf.lobe);
    const Vector peak = peak_of(brdf, i);
    if (!shapeless && brdf.ks > 0) {
      const auto f = [&](const Vector& o) {
        return evaluate_lobe(brdf, reduce(i.x, i.y, i.z, o.x, o.y, o.z), surface, wavelength_um);
      };
      const Frame pole = Frame::at(peak);
      add(Rings(f, pole, widths_of(brdf, cos_i, wavelength_um), aperture).integrate(relative_tolerance), found.total);
    }
    if (aperture.has(peak)) found.coherent += coherent_energy(brdf, cos_i, surface, wavelength_um);
  }
  found.total.value += found.coherent;
  return found;
}

}  // namespace gonio
