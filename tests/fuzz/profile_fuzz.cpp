// Any bytes as height profiles: profiles of finite heights at equal steps, or an InputError, nothing else.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "base/error.h"
#include "fit/profile.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    for (const gonio::HeightProfile& profile :
         gonio::parse_profiles({reinterpret_cast<const char*>(data), size}, "profile.csv")) {
      if (!(profile.step_um > 0)) std::abort();
      for (const double z : profile.z_um)
        if (!std::isfinite(z)) std::abort();
    }
  } catch (const gonio::InputError&) {
  }
  return 0;
}
