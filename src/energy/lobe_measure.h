#pragma once
#include <array>
#include <vector>

#include "brdf/brdf.h"

namespace gonio {

/// How a faceted lobe spreads the light over cos_d, the reflectance of its facets left out: E(θ) = ∫ R(cos_d)·w(cos_d | θ) d cos_d, a sum over
/// these points. w knows nothing of the material.
struct LobeMeasure {
  std::vector<double> cos_d, weight;

  double total() const;  ///< E on facets that reflect everything
};

/// Of an isotropic lobe about the half vector, theta_i_deg 0 to 89.9999, to an absolute `tolerance` of the total: rings of slopes by
/// Gauss and Kronrod's rules, halved until they agree; in a ring Gauss's 16 points between the kinks. InputError for lobes whose R is not a function of cos_d alone.
LobeMeasure lobe_measure(const Lobe<double>& lobe, double theta_i_deg, double tolerance = 1e-7);

/// Gauss's rule of a measure: it integrates polynomials in cos_d of degree 15 exactly, R of any surface nearly so.
struct CosNodes {
  static constexpr std::size_t kCount = 8;
  std::array<double, kCount> cos_d{}, weight{};

  /// ∫ R·w.
  double reflectance(const Interface<double>& surface) const;
};

/// By Stieltjes' recurrence on the points and the eigenvalues of its tridiagonal matrix (Golub & Welsch 1969; Gautschi 2004, §2.2.3).
CosNodes gauss_nodes(const LobeMeasure& measure);

}  // namespace gonio
