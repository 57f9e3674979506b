#include "energy/lobe_measure.h"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "energy/slope_plane.h"

namespace gonio {
namespace {

/// A slope's cos_d and its share of the light.
struct FacetShare {
  double cos_d = 0, weight = 0;
  void setZero() { *this = {}; }
};

/// A lobe as a slope plane sees it, R left out.
struct BareLobe {
  const Lobe<double>& lobe;
  void evaluate(const Directions<double>& w, double weight, FacetShare& out) const {
    out = {w.cos_d, weight * lobe_shape(lobe, w, 0.55)};
  }
};

constexpr int kMostHalvings = 14;

/// The points of a ring of slopes (one tan θ_h), times `outer`: the total.
template <class Plane>
double add_ring(const Plane& plane, double tan_h, double outer, LobeMeasure& to) {
  using Gauss = boost::math::quadrature::gauss<double, 16>;  // between kinks the integrand is smooth
  const std::vector<double> points = plane.inner_points(tan_h);
  double total = 0;
  for (std::size_t p = 0; p + 1 < points.size(); ++p) {
    const double middle = 0.5 * (points[p] + points[p + 1]), half = 0.5 * (points[p + 1] - points[p]);
    for (std::size_t i = 0; i < Gauss::abscissa().size() && half > 0; ++i)
      for (const double side : {-1.0, 1.0}) {
        FacetShare facet;
        plane.facet(tan_h, middle + side * half * Gauss::abscissa()[i], facet);
        if (!(facet.weight > 0)) continue;
        const double weight = outer * half * Gauss::weights()[i] * facet.weight;
        to.cos_d.push_back(facet.cos_d), to.weight.push_back(weight), total += weight;
      }
  }
  return total;
}

/// The points between two tangents, halved until Gauss's 7 points and Kronrod's 15 agree.
template <class Plane>
void add_between(const Plane& plane, double a, double b, double tolerance, int halvings, LobeMeasure& to) {
  using Kronrod = boost::math::quadrature::gauss_kronrod<double, 15>;
  using Gauss = boost::math::quadrature::gauss<double, 7>;
  const double middle = 0.5 * (a + b), half = 0.5 * (b - a);
  const std::size_t before = to.cos_d.size();
  double difference = 0;
  for (std::size_t node = 0; node < Kronrod::abscissa().size(); ++node)
    for (const double side : {-1.0, 1.0}) {
      if (node == 0 && side > 0) break;
      const double weight = Kronrod::weights()[node];
      const double ring = add_ring(plane, middle + side * half * Kronrod::abscissa()[node], half * weight, to);
      difference += ring * (1 - (node % 2 == 0 ? Gauss::weights()[node / 2] / weight : 0.0));
    }
  if (std::abs(difference) <= tolerance || halvings == 0) {
    to.error += std::abs(difference);
    return;
  }
  to.cos_d.resize(before), to.weight.resize(before);
  add_between(plane, a, middle, 0.5 * tolerance, halvings - 1, to);
  add_between(plane, middle, b, 0.5 * tolerance, halvings - 1, to);
}

}  // namespace

bool plain_facets(const Lobe<double>& lobe) {
  return std::visit(
      []<class L>(const L&) {
        return L::kFacets && !L::kDiffracts && !requires { &L::facet_reflectance; };
      },
      lobe);
}

double LobeMeasure::total() const { return std::accumulate(weight.begin(), weight.end(), 0.0); }

LobeMeasure lobe_measure(const Lobe<double>& lobe, double theta_i_deg, double tolerance) {
  if (!plain_facets(lobe))
    throw input_error("this lobe's reflectance is no function of cos_d alone; expected a faceted one");
  const BareLobe bare{lobe};
  const SlopePlane plane(bare, theta_i_deg, 0, false, slope_extent(lobe, 0.55), 0);
  const std::vector<double> points = plane.outer_points();
  LobeMeasure measure;
  for (std::size_t p = 0; p + 1 < points.size(); ++p)
    if (points[p + 1] > points[p])
      add_between(plane, points[p], points[p + 1], tolerance / double(points.size()), kMostHalvings, measure);
  return measure;
}

}  // namespace gonio
