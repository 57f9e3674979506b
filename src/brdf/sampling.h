#pragma once
#include <optional>

#include "brdf/brdf.h"

namespace gonio {

/// A unit vector in the surface's frame, z = mean normal.
struct LocalDirection {
  double x = 0, y = 0, z = 1;
};

struct DirectionSample {
  LocalDirection direction;
  double pdf_per_sr;
};

/// The width with which a lobe is sampled: alpha of the Beckmann density of half vectors that covers it. For
/// beckmann-kirchhoff at wavelength_um the wider of 2σ/T and the diffraction width λ/(πT).
/// Whether the lobe falls as fast as the Beckmann density it is sampled with.
bool tails_fit_the_sampler(const Lobe<double>& lobe);
double sampling_alpha(const Lobe<double>& lobe, double wavelength_um);

/// Half vectors as the eye sees them: the normals of Beckmann's surface that are visible from o when facets shadow each
/// other as in V-cavities (Heitz & d'Eon 2014, EGSR, sec. 4.2): draw a normal, and take it or its opposite facet in
/// proportion to their areas as seen. The pdf of the mirrored direction, per steradian, is
///   D(h)·G1/(4·cos_o), G1 = min(1, 2·cos_h·cos_o/cos_d),
/// so that f·cos_i/pdf = R·G/G1 has no D and no cosine left: grazing views cost no more than others.
/// u0, u1, u2 in (0, 1). Empty when the mirrored direction is below the horizon.
std::optional<DirectionSample> sample_visible_normal(double alpha, const LocalDirection& o, double u0, double u1,
                                                     double u2);
double visible_normal_pdf(double alpha, const LocalDirection& i, const LocalDirection& o);

/// The cosine lobe: pdf = cos θ/π.
DirectionSample sample_cosine(double u1, double u2);
double cosine_pdf(const LocalDirection& i);

}  // namespace gonio
