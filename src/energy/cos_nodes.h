#pragma once
#include <array>

#include "energy/lobe_measure.h"

namespace gonio {

/// Fixed cosines u_i that stand for all of R(cos_d): with R known there, E = ∫ R·w d cos_d = Σ W_i·R(u_i), where W_i = ∫ w·ℓ_i and ℓ_i is
/// Lagrange's polynomial of node i. u = s², s at Chebyshev's points of the first kind over 0..1: R turns fastest next to grazing.
///
/// W is linear in w and knows no material, so that tables of it may be interpolated, and a table for one material is a table of numbers.
/// What it loses is R less its polynomial of degree 19 in √cos_d: node_error().
inline constexpr std::size_t kCosNodes = 20;
using NodeValues = std::array<double, kCosNodes>;

/// The cosines, from the normal (i = 0) to grazing.
const NodeValues& cos_nodes();

/// W of a lobe at one incidence, by Chebyshev's moments.
NodeValues node_weights(const LobeMeasure& measure);

/// What multiplies the lobe's shape, at the nodes.
NodeValues reflectance_at_nodes(const Lobe<double>& lobe, const Interface<double>& surface);

/// Largest difference of R from its polynomial, at cosines between the nodes. Below kMostNodeError for every solid and liquid of the database but alkali metals next to their plasma edges;
/// large where n is nearly 1 or several hundred (reflectances of 0.00 and 0.99 taken as a dielectric's).
/// Up to kMostNodeError tables are used; beyond it E is integrated.
inline constexpr double kMostNodeError = 2e-5;
double node_error(const Lobe<double>& lobe, const Interface<double>& surface, const NodeValues& at_nodes);

inline double sum_of_products(const NodeValues& a, const NodeValues& b) {
  double sum = 0;
  for (std::size_t i = 0; i < kCosNodes; ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace gonio
