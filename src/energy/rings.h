#pragma once
#include <utility>

#include "energy/adaptive.h"
#include "energy/directional_reflectance.h"
#include "energy/spherical_cap.h"

namespace gonio {

/// What is the same all around the pole, on both sides of the plane of its e1, or of that across it too.
enum class RingSymmetry { none, two_sides, four_sides, all_around };

/// How rings about a pole are cut and how finely: `widths` of f about the pole and where they are cut, in widths; caps at
/// whose edges f turns steep; the most pieces of one integral.
struct RingCuts {
  std::vector<double> widths{};
  std::vector<double> at_widths{0.25, 0.5, 1.0, 1.5, 2.0, 3.0, 5.0, 8.0, 20.0, 100.0, 1000.0};
  std::vector<Cap> steep_edges{};
  RingSymmetry symmetry = RingSymmetry::none;
  std::size_t most_rings = 400, most_arcs = 100;
};

/// ∫_region f(o)·cos_o dω_o by nested adaptive quadrature in rings about a pole, cut where a ring meets an edge of the
/// region or the horizon: the edges are exact.
template <class F>
class Rings {
 public:
  Rings(const F& f, const Frame& pole, const Region& region, RingCuts cuts)
      : f_(f), pole_(pole), region_(region), cuts_(std::move(cuts)) {
    for (const Cap& cap : region.within) edges_.emplace_back(cap, pole);
    within_ = edges_.size();
    for (const Cap& cap : region.without) edges_.emplace_back(cap, pole);
    edges_.emplace_back(Cap{{0, 0, 1}, 0.5 * kPi<double>}, pole);
    for (const Cap& cap : cuts_.steep_edges) edges_.emplace_back(cap, pole);
  }

  /// To an absolute tolerance; `converged` says whether it was reached.
  Estimate within(double tolerance) const {
    const std::vector<double> radii = ring_radii();
    if (radii.size() < 2) return {};
    const double range = radii.back() - radii.front();
    double worst_inner = 0;
    const auto ring = [&](double s, Eigen::ArrayXd& value) {
      const Estimate one = around(s, 0.25 * tolerance / range);
      value[0] = one.value;
      worst_inner = std::max(worst_inner, one.error);
    };
    const Integral whole = integrate_adaptively(ring, radii, 1, 0.5 * tolerance, cuts_.most_rings);
    const double error = whole.error + range * worst_inner;
    return {whole.value[0], error, error <= tolerance};
  }

 private:
  std::vector<double> ring_radii() const {
    double lo = 0, hi = kPi<double>;
    for (std::size_t e = 0; e < within_; ++e)
      lo = std::max(lo, edges_[e].distance - edges_[e].radius),
      hi = std::min(hi, edges_[e].distance + edges_[e].radius);
    if (!(hi > lo)) return {};
    std::vector<double> cuts;
    for (const CapFromPole& edge : edges_) edge.add_radii(cuts);
    for (const double width : cuts_.widths)
      for (const double k : cuts_.at_widths) cuts.push_back(k * width);
    return breakpoints(lo, hi, cuts);
  }

  double value(double s, double psi) const {
    const UnitVector<double> o = pole_.direction(s, psi);
    return f_(o) * o.z * std::sin(s);
  }

  /// Arcs between edges lie wholly in the region or wholly out of it: their middles say which.
  Estimate around(double s, double tolerance) const {
    const double turn = 2 * kPi<double>, right = 0.5 * kPi<double>;
    if (cuts_.symmetry == RingSymmetry::all_around)
      return {region_.has(pole_.direction(s, 0)) ? turn * value(s, 0) : 0.0, 0, true};
    const double copies = cuts_.symmetry == RingSymmetry::none ? 1 : cuts_.symmetry == RingSymmetry::two_sides ? 2 : 4;
    std::vector<double> cuts;
    if (!cuts_.widths.empty()) cuts = {right, 2 * right, 3 * right};  // the plane of incidence and across it
    for (const CapFromPole& edge : edges_) edge.add_azimuths(s, cuts);
    const std::vector<double> points = breakpoints(0, turn / copies, cuts);
    const auto integrand = [&](double psi, Eigen::ArrayXd& out) { out[0] = value(s, psi); };
    Estimate found;
    for (std::size_t first = 0, last; first + 1 < points.size(); first = last + 1) {
      for (last = first; last + 1 < points.size() && is_in(s, points[last], points[last + 1]);) ++last;
      if (last == first) continue;
      const std::span<const double> run(points.data() + first, last + 1 - first);
      const Integral one = integrate_adaptively(integrand, run, 1, 0.5 * tolerance / copies, cuts_.most_arcs);
      found.value += copies * one.value[0], found.error += copies * one.error;
    }
    return found;
  }
  bool is_in(double s, double psi_0, double psi_1) const {
    return psi_1 > psi_0 && region_.has(pole_.direction(s, 0.5 * (psi_0 + psi_1)));
  }

  const F& f_;
  Frame pole_;
  const Region& region_;
  RingCuts cuts_;
  std::vector<CapFromPole> edges_;
  std::size_t within_ = 0;
};

inline void add(const Estimate& part, Estimate& sum) {
  sum.value += part.value, sum.error += part.error;
  sum.converged = sum.converged && part.converged;
}

/// Passes of a finer tolerance, from the first, until the error is small beside the value that the last one found, or
/// below `negligible`.
template <class Within>
Estimate to_relative_tolerance(const Within& within, double first_tolerance, double relative_tolerance,
                               double negligible = 0) {
  constexpr int kPasses = 5;
  double tolerance = first_tolerance;
  Estimate found;
  for (int pass = 0; pass < kPasses; ++pass) {
    found = within(tolerance);
    const double wanted = std::max(relative_tolerance * std::abs(found.value), negligible);
    found.converged = found.error <= wanted;
    if (found.converged) break;
    tolerance = std::max(1e-16, std::min(0.01 * tolerance, 0.5 * wanted));
  }
  return found;
}

}  // namespace gonio
