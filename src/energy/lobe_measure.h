#pragma once
#include <vector>

#include "brdf/brdf.h"

namespace gonio {

/// How a faceted lobe spreads the light over cos_d, the reflectance of its facets left out: E(θ) = ∫ R(cos_d)·w(cos_d | θ) d cos_d, a sum over
/// these points. w knows nothing of the material.
struct LobeMeasure {
  std::vector<double> cos_d, weight;
  double error = 0;  ///< of the total: where Gauss's and Kronrod's rules still differ

  double total() const;  ///< E on facets that reflect everything
};

/// Whether a lobe's reflectance is one of cos_d alone, times a shape that does not look at the wavelength.
bool plain_facets(const Lobe<double>& lobe);

/// Of an isotropic lobe about the half vector, theta_i_deg 0 to 89.9999, to an absolute `tolerance` of the total: rings of slopes by
/// Gauss and Kronrod's rules, halved until they agree; in a ring Gauss's 16 points between the kinks. InputError for lobes whose R is not a function of cos_d alone.
LobeMeasure lobe_measure(const Lobe<double>& lobe, double theta_i_deg, double tolerance = 1e-7);

}  // namespace gonio
