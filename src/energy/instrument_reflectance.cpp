#include "energy/instrument_reflectance.h"

#include <cmath>
#include <string_view>

#include "base/error.h"
#include "energy/lobe_peak.h"
#include "energy/rings.h"

namespace gonio {
namespace {

using Vector = UnitVector<double>;

/// An opening in the surface's frame.
struct Side {
  bool is_direction, is_hemisphere;
  Frame frame;
  double radius;
  Region region;
  Estimate projected_sr{1, 0, true};  ///< of a direction 1: it is no integral

  Side(const Opening& opening, double phi_deg, std::string_view name);

  double solid_angle_sr() const { return 2 * kPi<double> * (1 - std::cos(radius)); }
};

Frame frame_of(const Cone& cone, double phi_deg) {
  const double degree = kPi<double> / 180;
  return Frame::at(cone.theta_deg * degree, (phi_deg + cone.phi_deg) * degree);
}
Cap cap_of(const Cone& cone, double phi_deg) {
  return {frame_of(cone, phi_deg).p, cone.half_angle_deg * kPi<double> / 180};
}

Side::Side(const Opening& opening, double phi_deg, std::string_view name)
    : is_direction(opening.is_direction()),
      is_hemisphere(opening.is_hemisphere()),
      frame(frame_of(opening.cone, phi_deg)),
      radius(opening.cone.half_angle_deg * kPi<double> / 180),
      region{{cap_of(opening.cone, phi_deg)}, {}} {
  if (is_direction) {
    if (!(opening.cone.theta_deg <= 89.99))
      throw input_error("{} direction: theta is {}; expected 0 to 89.99", name, opening.cone.theta_deg);
    return;
  }
  if (opening.stop) region.without.push_back(cap_of(*opening.stop, phi_deg));
  const auto one = [](const Vector&) { return 1.0; };
  const Rings rings(one, frame, region, {});
  projected_sr = to_relative_tolerance([&](double tolerance) { return rings.within(tolerance); }, 1e-3, 1e-10);
  if (!(projected_sr.value > 0)) throw input_error("{}: nothing of it is above the horizon and outside its stop", name);
}

/// Where a lobe's delta, or a narrow lobe, lit from v points; its own inverse.
Vector image_of(const Brdf<double>& brdf, const Vector& v) { return brdf.retro ? v : Vector{-v.x, -v.y, v.z}; }
Cap image_of(const Brdf<double>& brdf, const Cap& cap) { return {image_of(brdf, cap.axis), cap.radius}; }

/// One lobe between two openings. Fluxes are ∫∫ f·cos_o dω_o cos_i dω_i, without the integral over a direction.
class LobeBetween {
 public:
  LobeBetween(const Brdf<double>& brdf, const Interface<double>& surface, double wavelength_um, const Side& source,
              const Side& collector)
      : brdf_(brdf), surface_(surface), wavelength_um_(wavelength_um), source_(source), collector_(collector) {}

  Estimate flux(double tolerance) const {
    if (source_.is_direction && collector_.is_direction) return {f(source_.frame.p, collector_.frame.p), 0, true};
    if (source_.is_direction) return over(collector_, source_.frame.p, tolerance, {});
    if (collector_.is_direction) return over(source_, collector_.frame.p, tolerance, {});
    return nested(tolerance);
  }

  Estimate coherent_flux(double relative_tolerance) const {
    if (!has_delta(brdf_.lobe)) return {};
    const Vector &i = source_.frame.p, &o = collector_.frame.p;
    if (source_.is_direction && collector_.is_direction) return between_directions(i, o);
    if (source_.is_direction) return {collector_.region.has(image_of(brdf_, i)) ? energy(i) : 0.0, 0, true};
    if (collector_.is_direction) return {source_.region.has(image_of(brdf_, o)) ? energy(o) : 0.0, 0, true};
    Region both = source_.region;
    for (const Cap& cap : collector_.region.within) both.within.push_back(image_of(brdf_, cap));
    for (const Cap& cap : collector_.region.without) both.without.push_back(image_of(brdf_, cap));
    const auto of = [&](const Vector& v) { return energy(v); };
    const Rings rings(of, source_.frame, both, {});
    const double unit = source_.projected_sr.value;
    return to_relative_tolerance([&](double tolerance) { return rings.within(tolerance); }, 1e-3 * unit,
                                 relative_tolerance, 1e-12 * unit);
  }

 private:
  double f(const Vector& i, const Vector& o) const {
    return evaluate_lobe(brdf_, reduce(i.x, i.y, i.z, o.x, o.y, o.z), surface_, wavelength_um_);
  }
  double energy(const Vector& v) const { return coherent_energy(brdf_, v.z, surface_, wavelength_um_); }

  Estimate between_directions(const Vector& i, const Vector& o) const {
    const Vector to = image_of(brdf_, i);
    if (energy(i) > 0 && std::hypot(to.x - o.x, to.y - o.y, to.z - o.z) < 1e-9)
      throw input_error("reflectance factor of a mirror between two directions is infinite; expected an aperture");
    return {};
  }

  /// Over one side for a direction of the other.
  Estimate over(const Side& side, const Vector& fixed, double tolerance, RingCuts cuts) const {
    const auto at = [&](const Vector& v) { return &side == &collector_ ? f(fixed, v) : f(v, fixed); };
    std::vector<double> widths = widths_of(brdf_, fixed.z, wavelength_um_);
    // One cut for widths that are much the same: every ring counts here.
    if (widths[1] > 0.8 * widths[0]) widths.erase(widths.begin() + 1);
    if (widths.back() > 0.4 * widths.front() && widths.size() == 2) widths.pop_back();
    // A cone within the lobe is smooth about its own axis.
    if (side.radius < std::min(widths.back(), 0.35)) return Rings(at, side.frame, side.region, cuts).within(tolerance);
    cuts.widths = widths;
    return Rings(at, Frame::at(peak_of(brdf_, fixed)), side.region, cuts).within(tolerance);
  }

  /// Over the hemisphere for light from i.
  Estimate collected_by_all(const Vector& i, double tolerance) const {
    const double degree = kPi<double> / 180;
    Estimate e =
        directional_reflectance(brdf_.lobe, std::atan2(std::hypot(i.x, i.y), i.z) / degree,
                                {{surface_}, {wavelength_um_}}, tolerance / brdf_.ks, std::atan2(i.y, i.x) / degree)[0];
    e.value *= brdf_.ks, e.error *= brdf_.ks;
    return e;
  }

  /// Over the smaller side, of the integral over the larger.
  Estimate nested(double tolerance) const {
    const bool outer_is_source = source_.projected_sr.value <= collector_.projected_sr.value;
    const Side &outer = outer_is_source ? source_ : collector_, &inner = outer_is_source ? collector_ : source_;
    const double inner_tolerance = 0.25 * tolerance / outer.solid_angle_sr();
    double worst = 0;
    const auto of = [&](const Vector& v) {
      const double each = inner_tolerance / std::max(v.z, 0.01);
      const Estimate one =
          inner.is_hemisphere && outer_is_source
              ? collected_by_all(v, each)
              : over(inner, v, each, {.at_widths = {0.5, 1.5, 4, 20, 200}, .most_rings = 120, .most_arcs = 60});
      worst = std::max(worst, one.error * v.z);
      return one.value;
    };
    RingCuts cuts{.steep_edges = steep_edges(inner), .most_rings = 60, .most_arcs = 40};
    Frame pole = outer.frame;
    cuts.symmetry = symmetry(pole);
    Estimate found = Rings(of, pole, outer.region, cuts).within(0.5 * tolerance);
    found.error += worst * outer.solid_angle_sr();
    return found;
  }

  /// Where a lobe narrower than an opening runs over its edges.
  std::vector<Cap> steep_edges(const Side& inner) const {
    std::vector<Cap> edges;
    const double width = 2 * slope_extent(brdf_.lobe, wavelength_um_).narrowest;
    for (const auto* caps : {&inner.region.within, &inner.region.without})
      for (const Cap& cap : *caps)
        for (const double k : {-2.0, 0.0, 2.0})
          if (cap.radius < 0.5 * kPi<double> && width < 0.25 * cap.radius)
            edges.push_back({image_of(brdf_, cap.axis), cap.radius + k * width});
    return edges;
  }

  /// Of everything about the plane of all axes, to which an upright pole's e1 is turned.
  RingSymmetry symmetry(Frame& pole) const {
    constexpr double kSame = 1e-12;
    Vector plane{0, 0, 0};
    std::vector<Vector> axes;
    for (const Side* side : {&source_, &collector_})
      for (const auto* caps : {&side->region.within, &side->region.without})
        for (const Cap& cap : *caps) axes.push_back(cap.axis);
    for (const Vector& a : axes)
      if (std::hypot(a.x, a.y) > std::hypot(plane.x, plane.y)) plane = a;
    const bool grain = looks_at_the_grain(brdf_.lobe), upright = std::hypot(plane.x, plane.y) < kSame;
    if (upright) pole = Frame::at(0, 0);
    if (upright) return grain ? RingSymmetry::four_sides : RingSymmetry::all_around;
    if (grain && std::abs(plane.x * plane.y) > kSame) return RingSymmetry::none;
    for (const Vector& a : axes)
      if (std::abs(a.x * plane.y - a.y * plane.x) > kSame) return RingSymmetry::none;
    if (std::hypot(pole.p.x, pole.p.y) < kSame) pole = Frame::at(0, std::atan2(plane.y, plane.x));
    return RingSymmetry::two_sides;
  }

  const Brdf<double>& brdf_;
  const Interface<double>& surface_;
  double wavelength_um_;
  const Side &source_, &collector_;
};

Estimate scaled(const Estimate& e, double factor) { return {e.value * factor, e.error * factor, e.converged}; }

bool reaches_horizon(const Cone& cone) { return cone.theta_deg + cone.half_angle_deg >= 90; }

}  // namespace

InstrumentReflectance instrument_reflectance(std::span<const Brdf<double>> lobes, const InstrumentGeometry& geometry,
                                             const Interface<double>& surface, double wavelength_um,
                                             double relative_tolerance) {
  if (reaches_horizon(geometry.collector.cone))
    for (const Brdf<double>& brdf : lobes) refuse_infinite(brdf.lobe);
  const Side source(geometry.source, 0, "source"),
      collector(geometry.collector, geometry.source.cone.phi_deg, "collector");
  const double openings = source.projected_sr.value * collector.projected_sr.value, to_factor = kPi<double> / openings;
  InstrumentReflectance found;
  found.factor.value = kPi<double> * evaluate_diffuse(lobes[0], surface);
  for (const Brdf<double>& brdf : lobes) {
    const LobeBetween lobe(brdf, surface, wavelength_um, source, collector);
    const Estimate delta = scaled(lobe.coherent_flux(relative_tolerance), to_factor);
    found.coherent_factor += delta.value;
    add(delta, found.factor);
  }
  for (const Brdf<double>& brdf : lobes) {
    if (!has_shape(brdf)) continue;
    const LobeBetween lobe(brdf, surface, wavelength_um, source, collector);
    const auto factor = [&](double tolerance) { return scaled(lobe.flux(tolerance / to_factor), to_factor); };
    const double negligible = std::max(1e-12, 0.3 * relative_tolerance * found.factor.value);
    add(to_relative_tolerance(factor, 1e-2, relative_tolerance, negligible), found.factor);
  }
  for (const Side* side : {&source, &collector})
    found.factor.error += found.factor.value * side->projected_sr.error / side->projected_sr.value;
  if (!source.is_direction) found.source_sr = source.projected_sr.value;
  if (collector.is_direction) return found;
  found.collector_sr = collector.projected_sr.value;
  found.reflectance = scaled(found.factor, found.collector_sr / kPi<double>);
  return found;
}

}  // namespace gonio
