#pragma once
// What other renderers evaluate for their rough metals, as their sources and manuals state it: the judge of what is exported.
//   f = D(m)·G(i, o)·F(i·m)/(4·cos_i·cos_o), D as in Walter et al. 2007 with widths along x and y (alpha = √2·slope rms for Beckmann),
//   F exact, of n + ik.
// Mitsuba 3 `roughconductor`: G = G1(i)·G1(o); GGX's G1 exact, Beckmann's the rational fit of Walter et al. (within 0.35 %).
// pbrt-v4 `conductor`: GGX, G = 1/(1 + Λ(i) + Λ(o)); no other density.
#include "base/unit_vector.h"
#include "optics/interface.h"

namespace gonio {

enum class RendererLobe { mitsuba_ggx, mitsuba_beckmann, pbrt_ggx };

/// f_r in sr⁻¹ of unit vectors above the horizon.
double renderer_lobe(RendererLobe lobe, const UnitVector<double>& i, const UnitVector<double>& o, double alpha_x,
                     double alpha_y, const Interface<double>& surface);

}  // namespace gonio
