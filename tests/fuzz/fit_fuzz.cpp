// Any bytes as a fit.json: a material that evaluates to finite values at its own wavelengths, or an InputError, nothing else.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "base/error.h"
#include "fit/fitted_material.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const gonio::FittedMaterial material = gonio::parse_fit({reinterpret_cast<const char*>(data), size}, "fit.json");
    if (material.values.size() != material.model.parameters().size()) std::abort();
    if (material.is_spectral() && material.by_wavelength.size() != material.values.size()) std::abort();
    for (const double nm : material.wavelength_nm)
      for (const double value : material.values_at(material.wavelength(nm)))
        if (!std::isfinite(value)) std::abort();
    if (material.brdfs(material.wavelength({})).size() != material.model.lobes().size()) std::abort();
  } catch (const gonio::InputError&) {
  }
  return 0;
}
