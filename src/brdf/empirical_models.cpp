#include "brdf/model_lists.h"

namespace gonio {

std::vector<ModelInfo> empirical_models() {
  const auto shift = [](std::string_view name, std::string_view meaning) {
    return ParameterInfo{name, "1", meaning, 1e-12, 1, 0.1, 1, std::nullopt};
  };
  const ParameterInfo exponent{"n", "1", "exponent", 1e-3, 1e6, 1, 1e5, std::nullopt};
  const ParameterInfo scale{"a", "1/sr", "A, scale of the lobe", 0, 1e4, 1e-2, 5e3, std::nullopt, true};
  const ParameterInfo correlation{"b", "1", "B, squared correlation length in wavelengths", 1e-3, 1e8, 1, 1e7, std::nullopt};
  const ParameterInfo decay{"c", "1", "C, decay of the tail", 1e-3, 10, 0.05, 3, std::nullopt};
  return {
      {ModelId::lafortune_1997, "lafortune-1997", "generalised cosine lobe of Lafortune et al., Cx = -c_x, Cy = -c_y",
       "f = kd/pi + ks max(0, c_z i_z o_z - c_x i_x o_x - c_y i_y o_y)^n; normalised: times (n+2)/(2 pi max(c)^n)",
       "Lafortune et al. 1997, doi:10.1145/258734.258801",
       {shift("c_x", "minus Cx"), shift("c_y", "minus Cy"), shift("c_z", "Cz"), {"n", "1", "exponent", 1e-3, 1e5, 1, 1e4, std::nullopt},
        kKd, kKs},
       {}, {"exact", "normalised"}, true, false, true, false},
      {ModelId::ashikhmin_shirley_2000, "ashikhmin-shirley-2000", "anisotropic Phong of Ashikhmin & Shirley with its coupled diffuse term",
       "f = kd/pi + ks (sqrt((nu+1)(nv+1))/(8 pi) cos_h^((nu hx^2 + nv hy^2)/(1 - hz^2)) F(cos_d)/(cos_d max(cos_i, cos_o)) + 28 "
       "rd/(23 pi) (1-f0) (1-(1-cos_i/2)^5) (1-(1-cos_o/2)^5)), F Schlick's",
       "Ashikhmin & Shirley 2000, doi:10.1080/10867651.2000.10487522",
       {{"nu", "1", "exponent along the grain", 1e-3, 1e6, 1, 1e5, std::nullopt},
        {"nv", "1", "exponent across the grain", 1e-3, 1e6, 1, 1e5, std::nullopt},
        {"f0", "1", "specular reflectance at normal incidence", 0, 0.9999, 1e-3, 0.99, std::nullopt},
        {"rd", "1", "diffuse reflectance below the specular layer", 0, 1, 1e-3, 1, 0.0},
        kKd, kKs},
       {}, {"exact", "fresnel"}, true, false, true, false},
      {ModelId::blinn_phong_normalised, "blinn-phong-normalised", "Blinn's cosine lobe about the half vector, normalised",
       "f = kd/pi + ks (n+2)/(2 pi) cos_h^n; energy: (n+2)(n+4)/(8 pi (2^(-n/2) + n)) cos_h^n",
       "Blinn 1977; normalised as in Ngan, Durand & Matusik 2005, doi:10.5555/2383654.2383671",
       {exponent, kKd, kKs}, {}, {"exact", "energy"}, true, false, true, false},
      {ModelId::low_smooth_2012, "low-smooth-2012", "ABC law of Low et al. in the projected deviation from the mirror direction",
       "f = kd/pi + ks F(cos_d) A/(1 + B |i_xy + o_xy|^2)^C", "Low et al. 2012, doi:10.1145/2077341.2077350",
       {scale, correlation, decay, kKd, kKs}, {}, {"exact"}, true, false, true, false},
      {ModelId::low_microfacet_2012, "low-microfacet-2012", "ABC law of Low et al. as a density of facets",
       "f = kd/pi + ks F(cos_d) G A/(1 + B (1 - cos_h))^C/(pi cos_i cos_o), V-cavity G; paper: without the pi",
       "Low et al. 2012, doi:10.1145/2077341.2077350", {scale, correlation, decay, kKd, kKs}, {}, {"exact", "paper"}, true, false, true,
       false},
      {ModelId::sgd_2012, "sgd-2012", "shifted gamma distribution of Bagher et al.",
       "f = kd/pi + ks F D G1(i) G1(o)/(pi cos_i cos_o), D = K exp(-tau)/(tau^p pi cos_h^4), tau = alpha + tan_h^2/alpha, "
       "F = u^5 + cos_d f_normal + f0 (u - u^5), u = 1 - cos_d, G1 = 1 + lambda (1 - exp(((theta - theta0)/theta_c)^k))",
       "Bagher, Soler & Holzschuch 2012, doi:10.1111/j.1467-8659.2012.03147.x",
       {{"alpha", "1", "roughness", 1e-5, 10, 1e-4, 1, std::nullopt},
        {"p", "1", "decay of the tail", 0, 2, 1e-3, 1.8, std::nullopt},
        {"k_norm", "1", "K, normalisation 1/(alpha Gamma(1-p, alpha))", 1e-3, 1e6, 3, 1e5, std::nullopt},
        {"f0", "1", "F0 of the modified Schlick law", 0, 10, 1e-3, 1, std::nullopt},
        {"f_normal", "1", "F0 - F1, reflectance at normal incidence", -0.1, 1.1, 1e-3, 1, std::nullopt},
        {"lambda", "1", "Lambda of the fitted shadowing (0: none)", 0, 1e8, 1e-2, 10, 0.0},
        {"theta_c_rad", "rad", "c^(-1/k) of the fitted shadowing", 0.1, 20, 0.3, 2, 1.0},
        {"k", "1", "k of the fitted shadowing", 1, 1000, 5, 50, 10.0},
        {"theta0_rad", "rad", "where the fitted shadowing starts", -1, 1.5, 0.01, 1, 0.0},
        kKd, kKs},
       {}, {"exact"}, true, false, false, false},
      {ModelId::rough_dielectric, "rough-dielectric", "rough interface of Walter et al., GGX: reflection, and transmission for theta_o > 90",
       "f = kd/pi + ks D G F/(4 cos_i cos_o); f_t = ks |i.h||o.h|/(cos_i cos_o) n^2 (1-F) G D/(i.h + n o.h)^2; beckmann: that D",
       "Walter et al. 2007, doi:10.2312/EGWR/EGSR07/195-206", {kAlpha, kKd, kKs}, {}, {"exact", "beckmann"}, true, true, true, false},
  };
}

}  // namespace gonio
