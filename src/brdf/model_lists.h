#pragma once
#include "brdf/models.h"

namespace gonio {

// Parameters that many models share.
inline constexpr ParameterInfo kKd{"kd", "1", "diffuse factor", 0, 10, 1e-4, 2, 0.0, true};
inline constexpr ParameterInfo kKs{"ks", "1", "lobe factor", 0, 100, 1e-4, 10, 1.0, true};
inline constexpr ParameterInfo kSlope{
    "m", "1", "slope rms, one-dimensional (alpha = sqrt(2) m may be given instead)", 1e-4, 10, 5e-3, 1, std::nullopt};
inline constexpr ParameterInfo kAlpha{"alpha", "1", "roughness, tan of the 1/e angle", 1e-4, 10, 7e-3, 1.4, std::nullopt};
inline constexpr ParameterInfo kAlphaX{"alpha_x", "1", "roughness along the grain (alpha sets both)", 1e-4, 10, 7e-3, 1.4, std::nullopt};
inline constexpr ParameterInfo kAlphaY{"alpha_y", "1", "roughness across the grain (alpha sets both)", 1e-4, 10, 7e-3, 1.4, std::nullopt};

// The list, by family; models() is all of them.
std::vector<ModelInfo> faceted_models();
std::vector<ModelInfo> empirical_models();
std::vector<ModelInfo> classical_models();

}  // namespace gonio
