#include "brdf/model_lists.h"

namespace gonio {

std::vector<ModelInfo> classical_models() {
  const std::vector<std::string_view> exact{"exact"}, scales{"published", "normalised"}, published{"published"};
  const ParameterInfo power{"n", "1", "exponent of the cosine", 1, 1e6, 2, 1e4, std::nullopt};
  const ParameterInfo decay{"c_per_rad", "1/rad", "decay of the Gaussian in the facets' angle", 0.1, 1e4, 0.5, 200, std::nullopt};
  const ParameterInfo spheroid{"e", "1", "excentricity of the spheroid (alpha of GGX)", 1e-4, 1, 7e-3, 1, std::nullopt};
  const ParameterInfo sigma0{"sigma0_um", "um", "height rms", 1e-4, 1e3, 0.02, 5, std::nullopt};
  const ParameterInfo correlation{"correlation_um", "um", "correlation length T (1/e of the autocorrelation)", 1e-2, 1e5, 0.5, 100, std::nullopt};
  const ParameterInfo alpha_2{"alpha_2", "1", "roughness of the second width", 1e-4, 10, 7e-3, 1.4, std::nullopt};
  const ParameterInfo weight_2{"weight_2", "1", "share of the second width", 0, 1, 1e-2, 1, std::nullopt};
  const std::string_view blinn = "Blinn 1977, doi:10.1145/563858.563893", blinn_formula = "f = kd/pi + ks D G F(cos_d)/(cos_i cos_o)";
  return {
      {ModelId::mirror, "mirror", "ideal mirror (a delta) over a diffuse part", "f = kd/pi + ks R(cos_i) delta(mirror)",
       "Maillot 1996, I.2", {kKd, kKs}, {}, exact, true, true, true, false},
      {ModelId::trowbridge_reitz, "trowbridge-reitz", "Spheroids (cuvettes) as the thesis prints them, no shadowing",
       "f = kd/pi + ks e^2 D_GGX(e) F(cos_d)/(4 cos_i cos_o)", "Trowbridge & Reitz 1975; Maillot 1996, I.2.2", {spheroid, kKd, kKs}, {},
       published, true, false, false, false},
      {ModelId::torrance_sparrow_1967, "torrance-sparrow-1967", "Torrance & Sparrow as published, ks = facet area times number",
       "f = kd/pi + ks exp(-(c zeta)^2) G F(cos_d)/(4 cos_i cos_o)", "Torrance & Sparrow 1967; Maillot 1996, eq. (6)", {decay, kKd, kKs},
       {}, published, true, false, true, false},
      {ModelId::blinn_1977_cosine, "blinn-1977-cosine", "Blinn's facets, cosine power", blinn_formula, blinn, {power, kKd, kKs}, {}, scales,
       true, false, true, false},
      {ModelId::blinn_1977_gaussian, "blinn-1977-gaussian", "Blinn's facets, Gaussian of the angle", blinn_formula, blinn,
       {decay, kKd, kKs}, {}, scales, true, false, true, false},
      {ModelId::blinn_1977_spheroid, "blinn-1977-spheroid", "Blinn's facets, Trowbridge-Reitz spheroids", blinn_formula, blinn,
       {spheroid, kKd, kKs}, {}, scales, true, false, true, false},
      {ModelId::cook_torrance_1981, "cook-torrance-1981", "Cook & Torrance as published (corrected: torrance-sparrow)",
       "f = kd/pi + ks F D G/(pi cos_i cos_o)", "Cook & Torrance 1981, doi:10.1145/357290.357293", {kAlpha, kKd, kKs}, {},
       {"beckmann", "gaussian-angle"}, true, false, true, false},
      {ModelId::cook_torrance_1981_two_widths, "cook-torrance-1981-two-widths", "Cook & Torrance as published with Cook's D3: two Beckmann widths",
       "f = kd/pi + ks F [(1 - weight_2) D(alpha) + weight_2 D(alpha_2)] G/(pi cos_i cos_o)",
       "Cook & Torrance 1981, doi:10.1145/357290.357293; Maillot 1996, II.1.2",
       {kAlpha, alpha_2, weight_2, kKd, kKs}, {}, published, true, false, true, false},
      {ModelId::phong_1975, "phong-1975", "Phong's highlight, an intensity", "f = kd/pi + ks cos^n(s)/cos_i",
       "Phong 1975, doi:10.1145/360825.360839", {power, kKd, kKs}, {}, published, false, false, false, false},
      {ModelId::whitted_1980, "whitted-1980", "Whitted's highlight about the half vector, an intensity", "f = kd/pi + ks cos^n(zeta_h)/cos_i",
       "Whitted 1980, doi:10.1145/358876.358882", {power, kKd, kKs}, {}, published, false, false, false, false},
      {ModelId::he_1991, "he-1991", "He, Torrance, Sillion & Greenberg: diffraction with shadowing and effective roughness",
       "f = kd/pi + ks R(cos_d) S(i) S(o) [beckmann-kirchhoff at the effective sigma]", "He et al. 1991, doi:10.1145/122718.122738",
       {sigma0, correlation, kKd, kKs}, {}, {"corrected", "lambda-without-exponential", "sigma0-in-phase"}, true, false, true, true},
  };
}

}  // namespace gonio
