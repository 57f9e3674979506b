#pragma once
#include <vector>

#include "image/spectral_image.h"
#include "scene/scene.h"

namespace gonio {

/// m of the rooms' material, pseudo-realistic with F = 1: E is nearly the same at every incidence there, so that all of a wall or sphere
/// is inside its limit, or beyond.
inline constexpr double kRoomSlope = 0.3;

/// A closed room whose walls shine 1 and reflect ks = factor·ks_max, nothing in it: mean radiance at the eye against the reflections of a path.
struct RoomMean {
  double factor = 0;
  int max_depth = 0;
  double mean = 0, error = 0;  ///< standard error of the mean over pixels
  double least = 0, most = 0;  ///< Σ (ks·E)^n to n = max_depth with the least and the largest E over the incidence
};
inline constexpr int kRoomDepths[]{2, 8, 32, 128};
inline constexpr double kRoomFactors[]{0.6, 1, 1.2, 1.5};
RoomMean room_mean(double factor, int max_depth);
std::vector<RoomMean> room_means();

/// kRoomFactors, from left to right: spheres of that material in a white room (Lambert 0.9) under one lamp.
SpectralImage spheres_in_white_room();
/// Walls and spheres of that material under the lamp: a row for each of kPictureFactors, a column for each of kPictureDepths.
inline constexpr double kPictureFactors[]{0.6, 1, 1.2};
inline constexpr int kPictureDepths[]{4, 16, 64};
SpectralImage rooms_of_the_material();
/// Rough F = 1, silver and copper, torrance-sparrow, in uniform light; above as single scattering leaves them, below with what it loses given back.
SpectralImage compensated_spheres();
inline constexpr double kCompensatedSlope = 0.7;

}  // namespace gonio
