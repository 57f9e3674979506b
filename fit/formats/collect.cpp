#include "fit/formats/collect.h"

#include <cmath>

#include "base/error.h"
#include "base/number.h"

namespace gonio {
namespace {

const double kToRadians = kPi<double> / 180, kToDegrees = 180 / kPi<double>;
constexpr double kHorizon = 1e-12;  // a cosine below is rounding of 90°

double dot(const Direction& a, const Direction& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

Direction cross(const Direction& a, const Direction& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

Direction sum(double a, const Direction& u, double b, const Direction& v, double c, const Direction& w) {
  return {a * u.x + b * v.x + c * w.x, a * u.y + b * v.y + c * w.y, a * u.z + b * v.z + c * w.z};
}

double azimuth_deg(const Direction& d) {
  if (std::hypot(d.x, d.y) < kHorizon) return 0;
  const double phi = std::atan2(d.y, d.x) * kToDegrees;
  return phi < 0 ? phi + 360 : phi;
}

long long rounded(double x) { return std::llround(x * 1e9); }

}  // namespace

Direction direction_from_deg(double theta_deg, double phi_deg) {
  const double theta = theta_deg * kToRadians, phi = phi_deg * kToRadians;
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

DirectionPair from_half_difference_deg(double theta_h_deg, double phi_h_deg, double theta_d_deg, double phi_d_deg) {
  const Direction h = direction_from_deg(theta_h_deg, phi_h_deg);
  const Direction away = direction_from_deg(theta_h_deg + 90, phi_h_deg);  // in the plane of h and the normal
  const Direction across = direction_from_deg(90, phi_h_deg + 90);
  const Direction d = direction_from_deg(theta_d_deg, phi_d_deg);
  const Direction i = sum(d.x, away, d.y, across, d.z, h);
  const double twice = 2 * dot(i, h);
  return {i, {twice * h.x - i.x, twice * h.y - i.y, twice * h.z - i.z}};
}

DirectionPair from_mirror_deg(double theta_i_deg, double phi_i_deg, double radial_deg, double around_deg) {
  const Direction mirror = direction_from_deg(theta_i_deg, phi_i_deg + 180);
  const Direction to_normal = direction_from_deg(90 - theta_i_deg, phi_i_deg);
  const Direction around = direction_from_deg(radial_deg, around_deg);
  return {direction_from_deg(theta_i_deg, phi_i_deg),
          sum(around.x, to_normal, around.y, cross(mirror, to_normal), around.z, mirror)};
}

ScanPoint point_of(const DirectionPair& pair, bool& below) {
  const auto zenith = [](const Direction& d) { return std::atan2(std::hypot(d.x, d.y), d.z) * kToDegrees; };
  ScanPoint point;
  point.theta_i_deg = zenith(pair.i), point.theta_o_deg = zenith(pair.o);
  point.phi_i_deg = azimuth_deg(pair.i), point.phi_o_deg = azimuth_deg(pair.o);
  below = pair.i.z < kHorizon || pair.o.z < kHorizon;
  return point;
}

void PointCollector::add(ScanPoint point, double value, int line) {
  if (!point.has_wavelength() && scan_.wavelength_nm) point.wavelength_nm = *scan_.wavelength_nm;
  if (point.theta_i_deg >= 90 || point.theta_o_deg >= 90) return leave_out("zenith angle of 90 degrees");
  const double scale = to_brdf(scan_.quantity, point.theta_o_deg);
  point.f_per_sr = value * scale;
  point.f_std_per_sr *= scale;
  if (!std::isfinite(point.f_per_sr))
    throw input_error("{}:{}: the value is {}; expected one that stays finite as a BRDF", file_, line, value);
  scan_.points.push_back(std::move(point));
}

void PointCollector::add_of_grid(const DirectionPair& pair, double wavelength_nm, double value, int line) {
  bool below = false;
  ScanPoint point = point_of(pair, below);
  if (below) return leave_out("at or below the horizon");
  const bool stated = wavelength_nm == wavelength_nm;
  if (!seen_
           .insert({rounded(pair.i.x), rounded(pair.i.y), rounded(pair.o.x), rounded(pair.o.y),
                    stated ? rounded(wavelength_nm / 1e3) : -1})
           .second)
    return leave_out("repeats a direction of the grid");
  point.wavelength_nm = wavelength_nm;
  add(std::move(point), value, line);
}

Measurement PointCollector::finish(int line) {
  if (scan_.points.empty())
    throw input_error("{}:{}: no usable point; expected at least one with zenith angles below 90", file_, line);
  group_by_incidence(scan_);
  return std::move(scan_);
}

}  // namespace gonio
