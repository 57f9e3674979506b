#pragma once
#include <optional>

#include "brdf/sampling.h"

namespace gonio {

/// Half vectors as the eye sees them: the normals of Beckmann's surface that are visible from o when facets shadow each
/// other as in V-cavities (Heitz & d'Eon 2014, EGSR, sec. 4.2): draw a normal, and take it or its opposite facet in
/// proportion to their areas as seen. The pdf of the mirrored direction, per steradian, is
///   D(h)·G1/(4·cos_o), G1 = min(1, 2·cos_h·cos_o/cos_d),
/// so that f·cos_i/pdf = R·G/G1 has no D and no cosine left: grazing views cost no more than others.
/// u0, u1, u2 in (0, 1). Empty when the mirrored direction is below the horizon.
std::optional<DirectionSample> sample_visible_normal(double alpha, const LocalDirection& o, double u0, double u1,
                                                     double u2);
double visible_normal_pdf(double alpha, const LocalDirection& i, const LocalDirection& o);

}  // namespace gonio
