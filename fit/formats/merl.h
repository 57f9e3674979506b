#pragma once
// The cells of a MERL file (fit/formats/merl.cpp describes it).
#include <array>
#include <cstddef>

#include "fit/formats/readers.h"

namespace gonio {

/// f_r in sr⁻¹ for a stored value of 1: red, green, blue.
inline constexpr std::array<double, 3> kMerlScale{1.0 / 1500, 1.15 / 1500, 1.66 / 1500};

struct MerlAngles {
  double theta_h_deg, theta_d_deg, phi_d_deg;
};

/// The middle of a cell, by its place in a channel.
MerlAngles merl_angles_deg(std::size_t index, const MerlGrid& grid = {});

}  // namespace gonio
