#pragma once
#include "base/number.h"

namespace gonio {

/// Lambert's diffuse reflector: f = kd/π. It has no lobe; kd (default 1) is its directional reflectance at every angle.
struct Lambert {
  static constexpr bool kFacets = false, kDiffracts = false;
};

}  // namespace gonio
