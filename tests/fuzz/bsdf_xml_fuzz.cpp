// Any bytes as a Radiance/LBNL BSDF file: a Measurement or an InputError, nothing else.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "base/error.h"
#include "fit/formats/bsdf_xml.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const gonio::Measurement scan = gonio::read_bsdf_xml(std::string_view(reinterpret_cast<const char*>(data), size), "FILE");
    if (scan.points.empty() || scan.conventions.empty()) std::abort();
    for (const gonio::ScanPoint& point : scan.points)
      if (!std::isfinite(point.f_per_sr) || !(point.theta_i_deg >= 0 && point.theta_i_deg < 90) ||
          !(point.theta_o_deg >= 0 && point.theta_o_deg < 90) || point.incidence >= scan.incidences_deg.size())
        std::abort();
  } catch (const gonio::InputError&) {
  }
  return 0;
}
