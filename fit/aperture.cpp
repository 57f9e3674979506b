#include "fit/aperture.h"

#include <cmath>

#include "base/error.h"

namespace gonio {
namespace {

constexpr double kWidest = 40;  // degrees: tangents of offsets are small angles

struct DiscNode {
  double x, y, weight;
};

/// Rings of seven on a disc of radius 1: the squared radius by Gauss-Legendre on [0, 1].
std::vector<DiscNode> disc(int rings, double radius) {
  const double root = std::sqrt(0.6);
  const std::vector<double> square =
                                rings == 3 ? std::vector{0.5 - 0.5 * root, 0.5, 0.5 + 0.5 * root} : std::vector{0.5},
                            weight = rings == 3 ? std::vector{5.0 / 18, 8.0 / 18, 5.0 / 18} : std::vector{1.0};
  constexpr int kAround = 7;
  std::vector<DiscNode> nodes;
  for (int ring = 0; ring < rings; ++ring)
    for (int turn = 0; turn < kAround; ++turn) {
      const double r = radius * std::sqrt(square[static_cast<std::size_t>(ring)]),
                   angle = 2 * kPi<double> * (turn + ring / 3.0) / kAround;
      nodes.push_back({r * std::cos(angle), r * std::sin(angle), weight[static_cast<std::size_t>(ring)] / kAround});
    }
  return nodes;
}

double radius_of(double full_angle_deg, std::string_view what) {
  if (!(full_angle_deg >= 0 && full_angle_deg <= kWidest))
    throw input_error("{} {}: no aperture; expected a full angle of 0 to {} degrees", what, full_angle_deg, kWidest);
  return std::tan(0.5 * full_angle_deg * kPi<double> / 180);
}

/// v moved by tangents: a in the plane of the zenith (away from it), b across.
std::array<double, 3> moved(double x, double y, double z, const std::array<double, 2>& by) {
  const double sine = std::hypot(x, y), c = sine > 0 ? x / sine : 1, s = sine > 0 ? y / sine : 0;
  const double mx = x + by[0] * z * c - by[1] * s, my = y + by[0] * z * s + by[1] * c, mz = z - by[0] * sine;
  const double length = std::sqrt(mx * mx + my * my + mz * mz);
  return {mx / length, my / length, mz / length};
}

}  // namespace

Directions<double> through(const ApertureNode& node, const Directions<double>& w, double& weight) {
  const auto i = moved(w.ix, w.iy, w.cos_i, node.source), o = moved(w.ox, w.oy, w.cos_o, node.detector);
  weight = 0;
  if (!(i[2] > 0) || !(o[2] > 0)) return w;
  weight = node.weight * (i[2] / w.cos_i) * (o[2] / w.cos_o);
  return reduce(i[0], i[1], i[2], o[0], o[1], o[2]);
}

std::vector<ApertureNode> aperture_nodes(const Aperture& aperture) {
  const double detector = radius_of(aperture.detector_deg, "aperture"),
               source = radius_of(aperture.source_deg, "source");
  std::vector<ApertureNode> nodes;
  if (detector == 0 && source == 0) return nodes;
  const bool both = detector > 0 && source > 0, wide_detector = detector >= source;
  const std::vector<DiscNode> centre{{0, 0, 1}};
  const auto at = [&](double radius, bool wider) {
    return radius == 0 ? centre : disc(both && !wider ? 1 : 3, radius);
  };
  for (const DiscNode& d : at(detector, wide_detector))
    for (const DiscNode& s : at(source, !wide_detector)) nodes.push_back({d.weight * s.weight, {s.x, s.y}, {d.x, d.y}});
  return nodes;
}

}  // namespace gonio
