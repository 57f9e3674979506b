#pragma once
#include <nlohmann/json.hpp>

#include "energy/limits.h"

namespace gonio {

/// The contract's keys of `table limits` (ks_max, kd_max, E, coherent_energy, range_nm) and what goes with them; unrounded.
/// ks_max is null without a lobe, wavelengths are null where none matters.
nlohmann::ordered_json to_json(const Limits& limits);

}  // namespace gonio
