#pragma once
#include <string>
#include <vector>

#include "assess/merl_tables.h"

namespace gonio {

/// PNG: one panel a material (at most 25), every table's curve in the plane of incidence, light at 45°.
std::string merl_sheet(const std::vector<std::string>& materials, const std::vector<std::vector<PublishedFit>>& tables);

}  // namespace gonio
