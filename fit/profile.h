#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "surface/roughness.h"

namespace gonio {

/// Height profiles of a CSV: a column x_um (or x_nm, x_mm), a column z_um (or z_nm, z_mm), optionally `profile` (a
/// name; the rows of one profile follow each other). x rises by equal steps (to 1 %), the same in every profile.
/// InputError for anything else, with file and line.
std::vector<HeightProfile> parse_profiles(std::string_view text, const std::string& file);

}  // namespace gonio
