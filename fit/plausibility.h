#pragma once
#include <optional>
#include <string>
#include <vector>

#include "fit/fit.h"

namespace gonio {

/// Fitted values against what their model is made for, a sentence each, only where they are beyond it.
///   Beckmann-Kirchhoff, He: the tangent plane. T > λ, and 4π·r_c·cos θ_i ≫ λ (Beckmann after Brekhovskikh; Maillot
///   1996 §I.2.2)
///     with r_c = T²/(2√3·σ), the rms curvature's radius of a Gaussian autocorrelation. ≫ is read as ten times: at the
///     normal that is T² > 2.76·σ·λ, and T > λ is k·T > 6, of Ulaby, Moore & Fung 1982, vol. II, ch. 12 (2.76 =
///     2√3·√(2/π), which makes an rms curvature a mean one; 4π/(2√3) = 10/2.76).
///   Beckmann-Kirchhoff, Stogryn: no shadowing, where Smith's G1 would take more than a tenth.
///   Facets: slopes above alpha = 1 (m = 0.7), where light reflected twice is a part that single scattering leaves out.
std::vector<std::string> implausible_lobes(const FitResult& result);

/// A fitted n (k = 0) against that of a named material, and against dielectrics (1.2 to 2.6).
std::vector<std::string> implausible_index(const FitResult& result, const std::optional<std::string>& material);

}  // namespace gonio
