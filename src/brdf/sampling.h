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
double sampling_alpha(const Lobe<double>& lobe, double wavelength_um);

/// Beckmann half vectors mirrored: pdf = D(h)·cos_h/(4·cos_d) per steradian of the returned direction; u1, u2 in [0, 1).
/// Empty when the mirrored direction is below the horizon (the density integrates to 1 minus that share).
std::optional<DirectionSample> sample_half_vector(double alpha, const LocalDirection& o, double u1, double u2);
double half_vector_pdf(double alpha, const LocalDirection& i, const LocalDirection& o);

/// The cosine lobe: pdf = cos θ/π.
DirectionSample sample_cosine(double u1, double u2);
double cosine_pdf(const LocalDirection& i);

}  // namespace gonio
