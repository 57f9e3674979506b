#include "energy/cos_nodes.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace gonio {
namespace {

/// Chebyshev's points of the first kind over -1..1, decreasing.
double point(std::size_t i) {
  return std::cos((static_cast<double>(i) + 0.5) * kPi<double> / static_cast<double>(kCosNodes));
}
double cosine_at(double x) { return square(0.5 * (x + 1)); }

/// Chebyshev's polynomials at a point.
NodeValues polynomials(double x) {
  NodeValues t{1, x};
  for (std::size_t j = 2; j < kCosNodes; ++j) t[j] = 2 * x * t[j - 1] - t[j - 2];
  return t;
}

/// T_j at the nodes, the transformation from moments to weights and from values to coefficients.
const std::array<NodeValues, kCosNodes>& at_points() {
  static const auto all = [] {
    std::array<NodeValues, kCosNodes> t;
    for (std::size_t i = 0; i < kCosNodes; ++i) t[i] = polynomials(point(i));
    return t;
  }();
  return all;
}

/// Σ_j' T_j(x_i)·m_j·2/K, the first halved (the points' discrete orthogonality).
double transformed(const NodeValues& t, const NodeValues& m) {
  double sum = 0.5 * m[0];
  for (std::size_t j = 1; j < kCosNodes; ++j) sum += t[j] * m[j];
  return 2.0 / static_cast<double>(kCosNodes) * sum;
}

}  // namespace

const NodeValues& cos_nodes() {
  static const NodeValues all = [] {
    NodeValues u{};
    for (std::size_t i = 0; i < kCosNodes; ++i) u[i] = cosine_at(point(i));
    return u;
  }();
  return all;
}

NodeValues node_weights(const LobeMeasure& measure) {
  NodeValues moments{};
  for (std::size_t p = 0; p < measure.cos_d.size(); ++p) {
    const NodeValues t = polynomials(2 * std::sqrt(measure.cos_d[p]) - 1);
    for (std::size_t j = 0; j < kCosNodes; ++j) moments[j] += measure.weight[p] * t[j];
  }
  NodeValues weights{};
  for (std::size_t i = 0; i < kCosNodes; ++i) weights[i] = transformed(at_points()[i], moments);
  return weights;
}

NodeValues reflectance_at_nodes(const Lobe<double>& lobe, const Interface<double>& surface) {
  NodeValues r{};
  for (std::size_t i = 0; i < kCosNodes; ++i) r[i] = facet_reflectance<double>(lobe, cos_nodes()[i], surface);
  return r;
}

double node_error(const Lobe<double>& lobe, const Interface<double>& surface, const NodeValues& at_nodes) {
  constexpr std::size_t kBetween = 4;  // places between neighbours; the first and the last also lie beyond the nodes
  static const auto tests = [] {
    std::vector<std::pair<double, NodeValues>> all;
    for (std::size_t p = 0; p <= kBetween * kCosNodes; ++p) {
      const double x = std::cos(static_cast<double>(p) * kPi<double> / (kBetween * kCosNodes));
      const NodeValues t = polynomials(x);
      NodeValues lagrange{};
      for (std::size_t i = 0; i < kCosNodes; ++i) lagrange[i] = transformed(at_points()[i], t);
      all.emplace_back(cosine_at(x), lagrange);
    }
    return all;
  }();
  double worst = 0;
  for (const auto& [cos_d, lagrange] : tests)
    worst = std::max(worst,
                     std::abs(facet_reflectance<double>(lobe, cos_d, surface) - sum_of_products(lagrange, at_nodes)));
  return worst;
}

}  // namespace gonio
