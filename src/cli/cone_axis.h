#pragma once
#include <string>

#include "energy/cone_reflectance.h"

namespace gonio::cli {

/// --axis mirror (of a source at theta_i_deg), normal, or THETA,PHI; InputError for anything else.
Cone cone_about(const std::string& axis, double theta_i_deg, double half_angle_deg);

}  // namespace gonio::cli
