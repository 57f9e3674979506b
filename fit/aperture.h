#pragma once
#include <vector>

#include "fit/problem.h"

namespace gonio {

/// Round apertures as the sample sees them: full angles in degrees, 0 where a point will do.
struct Aperture {
  double detector_deg = 0, source_deg = 0;
};

/// Nodes of the mean over both discs, each of three rings of seven (Gauss in the squared radius, turned against one another: exact for
/// polynomials up to the fifth degree across the disc); weights add up to 1. None where both angles are 0. InputError outside 0 to 40 degrees.
///
/// Away from grazing only the difference between the two offsets moves the half vector, so that the mean over both together is a mean over
/// one disc folded with another: 21 × 7 nodes where both are open.
std::vector<ApertureNode> aperture_nodes(const Aperture& aperture);

}  // namespace gonio
