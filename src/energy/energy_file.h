#pragma once
#include <filesystem>

#include "energy/energy_table.h"

namespace gonio {

/// An OpenEXR file: channels weight_00 … weight_19, E (white facets) and error; rows alpha, columns the incidence; grids, cosines, units, family, version and a
/// checksum in attributes. A CSV of E beside it.
void write_energy_table(const EnergyTable& table, const std::filesystem::path& exr);

/// InputError naming the file where it is no such table, of another version or grid, or its checksum differs from its numbers.
EnergyTable read_energy_table(const std::filesystem::path& exr);

/// Makes a few cells anew: InputError naming the cell where the table holds something else (made by another version of the lobes).
void check_is_current(const EnergyTable& table);

}  // namespace gonio
