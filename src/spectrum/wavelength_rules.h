#pragma once
#include "spectrum/weight_fit.h"

namespace gonio {

/// Quadratures that know the observer but not the scene, as renderers use them. The weight of a node is the
/// quadrature's own times the colour-matching functions there.
enum class WavelengthRule {
  uniform,         ///< midpoints of equal stretches of the scene's range
  gauss_legendre,  ///< Gauss-Legendre over the range
  observer,        ///< midpoints of equal shares of ∫(x̄ + ȳ + z̄): sampling in proportion to the observer
};

/// The rule's nodes and weights. worst_e2000 is judged by a white from the same quadrature, which flatters it: with the
/// white of the 1 nm sum, as for fitted weights, it is up to several times as large.
NodeWeights rule_weights(const SceneProducts& products, const Observer& observer, WavelengthRule rule, int count);

}  // namespace gonio
