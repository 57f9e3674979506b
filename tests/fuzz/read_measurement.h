#pragma once
// What every target of a measurement's reader does: any bytes are a Measurement that can be fitted, or an InputError, nothing else.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "base/error.h"
#include "fit/scan.h"

namespace gonio::fuzz {

/// Ends the process, a finding, where `holds` does not.
inline void require(bool holds) {
  if (!holds) std::abort();
}

/// Points there are, every number finite, zenith angles below 90, each point of an incidence that is listed.
inline void check(const Measurement& scan) {
  require(!scan.points.empty());
  for (const ScanPoint& p : scan.points) {
    require(std::isfinite(p.f_per_sr) && std::isfinite(p.phi_i_deg) && std::isfinite(p.phi_o_deg));
    require(p.theta_i_deg >= 0 && p.theta_i_deg < 90 && p.theta_o_deg >= 0 && p.theta_o_deg < 90);
    require(p.incidence < scan.incidences_deg.size());
  }
}

/// read(bytes), checked, and that it says how it was read.
template <class Read>
int foreign_file(const std::uint8_t* data, std::size_t size, Read&& read) {
  try {
    const Measurement scan = read(std::string_view(reinterpret_cast<const char*>(data), size), "FILE");
    check(scan);
    require(!scan.conventions.empty());
  } catch (const InputError&) {
  }
  return 0;
}

}  // namespace gonio::fuzz
