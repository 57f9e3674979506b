#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "base/number.h"
#include "base/unit_vector.h"

namespace gonio {

inline double haversine(double angle) { return square(std::sin(0.5 * angle)); }

/// A direction and the two across it, e1 away from the zenith.
struct Frame {
  UnitVector<double> p, e1, e2;

  static Frame at(double theta, double phi) {
    const double c = std::cos(theta), s = std::sin(theta), cp = std::cos(phi), sp = std::sin(phi);
    return {{s * cp, s * sp, c}, {c * cp, c * sp, -s}, {-sp, cp, 0}};
  }
  static Frame at(const UnitVector<double>& p) {
    return at(std::atan2(std::hypot(p.x, p.y), p.z), std::atan2(p.y, p.x));
  }

  /// The one at the angle s from p, at the azimuth psi from e1.
  UnitVector<double> direction(double s, double psi) const {
    const double along = std::cos(s), a = std::sin(s) * std::cos(psi), b = std::sin(s) * std::sin(psi);
    return {along * p.x + a * e1.x + b * e2.x, along * p.y + a * e1.y + b * e2.y, along * p.z + a * e1.z + b * e2.z};
  }
};

/// Directions within `radius` of an axis, in the surface's own frame.
struct Cap {
  UnitVector<double> axis;
  double radius;

  bool has(const UnitVector<double>& o) const {  // by the chord, which keeps small angles
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
    for (const double s : {std::abs(distance - radius), distance + radius, 2 * kPi<double> - distance - radius})
      cuts.push_back(s);
  }
  /// The azimuths, in [0, 2π), at which the ring s crosses the edge: hav r = hav(s - d) + sin s·sin d·hav ψ.
  void add_azimuths(double s, std::vector<double>& cuts) const {
    const double across = std::sin(s) * std::sin(distance), rest = haversine(radius) - haversine(s - distance);
    if (!(rest > 0 && rest < across)) return;
    const double turn = 2 * kPi<double>, psi = 2 * std::asin(std::sqrt(rest / across));
    for (const double at : {azimuth - psi, azimuth + psi}) cuts.push_back(at - turn * std::floor(at / turn));
  }
};

/// What lies above the horizon in all of some caps and in none of others.
struct Region {
  std::vector<Cap> within, without;

  bool has(const UnitVector<double>& o) const {
    const auto holds = [&](const Cap& cap) { return cap.has(o); };
    return o.z > 0 && std::ranges::all_of(within, holds) && std::ranges::none_of(without, holds);
  }
};

}  // namespace gonio
