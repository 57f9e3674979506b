#pragma once
#include <nlohmann/json.hpp>

#include "fit/fit.h"

namespace gonio {

/// fit.json: unrounded, units in the keys or beside the value, no date, duration or path.
nlohmann::ordered_json to_json(const FitResult& result);

}  // namespace gonio
