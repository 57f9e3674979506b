#pragma once
#include <string>
#include <vector>

#include "optics/interface.h"

namespace gonio {

/// A material at one wavelength.
struct NamedSurface {
  std::string id;
  double wavelength_nm;
  Interface<double> interface;
};

/// Every solid and liquid of the database with n and k, every step_nm between 280 and 1100 nm, as far as its data reach. Gases (n below 1.01, transparent) are left out:
/// nobody has a rough surface of one.
std::vector<NamedSurface> database_surfaces(double step_nm = 20);

}  // namespace gonio
